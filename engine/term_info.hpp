#pragma once

#include <string_view>

namespace taut {

/// A term of a method: what it says, where it comes from, which function computes it, which test covers it.
/// It stands below its function.
struct TermInfo {
  std::string_view what;      // "stress rate"
  std::string_view formula;   // in Unicode
  std::string_view source;    // "[Khayyer2024] Eq. 6"
  std::string_view function;  // "terms/stress_rate.hpp:jaumann_rate", below engine/
  std::string_view test;      // the name of its test case
};

/// Where a paper has, in its own words, what the term of that name takes from another one.
struct Citation {
  std::string_view what;    // TermInfo::what
  std::string_view source;  // in the place of TermInfo::source
  std::string_view test;    // in the place of TermInfo::test; empty: the same
};

}  // namespace taut
