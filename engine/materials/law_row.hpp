#pragma once

#include <span>
#include <string_view>

#include "engine/materials/elastic_law.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// Optional key of [material] besides K and G.
struct LawParameter {
  std::string_view key;
  double value;      // default
  double low, high;  // inclusive
  std::string_view help;
};

struct LawRow {
  Law law;
  std::string_view choice;        // name for users, or empty
  std::string_view material_law;  // name in run.json
  TermInfo term;
  std::span<const LawParameter> parameters = {};  // struct members after K and G
};

}  // namespace taut
