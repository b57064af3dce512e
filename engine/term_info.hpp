#pragma once

#include <string_view>

namespace taut {

/// Equation, source, function and test of a term of a method. Each is defined below its function.
struct TermInfo {
  std::string_view what;      // "stress rate"
  std::string_view formula;   // in Unicode
  std::string_view source;    // "[Khayyer2024] Eq. 6"
  std::string_view function;  // "terms/stress_rate.hpp:jaumann_rate", below engine/
  std::string_view test;      // name of its test case
};

/// Source of a term in the method's own paper, if the TermInfo cites another paper.
struct Citation {
  std::string_view what;    // TermInfo::what
  std::string_view source;  // replaces TermInfo::source
  std::string_view test;    // replaces TermInfo::test; empty = unchanged
};

}  // namespace taut
