#pragma once

#include <string_view>

namespace taut {

/// A term's equation, source, function and test. Defined below its function.
struct TermInfo {
  std::string_view what;      // "stress rate"
  std::string_view formula;   // in Unicode
  std::string_view source;    // "[Khayyer2024] Eq. 6"
  std::string_view function;  // "terms/stress_rate.hpp:jaumann_rate", below engine/
  std::string_view test;      // name of its test case
};

/// Source of a term in a method's own paper, where TermInfo cites another one.
struct Citation {
  std::string_view what;    // TermInfo::what
  std::string_view source;  // replaces TermInfo::source
  std::string_view test;    // replaces TermInfo::test; empty = unchanged
};

}  // namespace taut
