#pragma once

#include <string_view>

namespace taut {

struct TermInfo {
  std::string_view what;  // "stress rate"
  std::string_view formula;
  std::string_view source;    // "[Khayyer2024] Eq. 6"
  std::string_view function;  // "terms/stress_rate.hpp:jaumann_rate"
  std::string_view test;
};

struct Citation {
  std::string_view what;  // TermInfo::what
  std::string_view source;
  std::string_view test;  // empty = unchanged
};

}  // namespace taut
