#pragma once

#include <string_view>

namespace taut {

/// A constant of a method that a user may set ("--set method.zeta=4") and sweep.
struct MethodConstant {
  std::string_view name;
  double value;  // published default
  double low, high;
  std::string_view help;
};

/// A term of a method: what it says, where it comes from, which function computes it, which test covers it.
struct TermInfo {
  std::string_view what;      // "stress rate"
  std::string_view formula;   // in Unicode
  std::string_view source;    // "[Khayyer2024] Eq. 6"
  std::string_view function;  // "terms/stress_rate.hpp:jaumann_rate", below engine/
  std::string_view test;      // the name of its test case
};

}  // namespace taut
