#pragma once

#include <span>
#include <string_view>

#include "engine/materials/elastic_law.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// A number of a law beside K and G: a key of [material], which need not be given.
struct LawParameter {
  std::string_view key;
  double value;      // default
  double low, high;  // both allowed
  std::string_view help;
};

/// What the tables know of a law of elasticity.
struct LawRow {
  Law law;
  std::string_view choice;        // as users choose it: "neo-hookean"; empty: it cannot be chosen
  std::string_view material_law;  // the reference to compare with, as in run.json
  TermInfo term;
  std::span<const LawParameter> parameters = {};  // its struct has them behind K and G
};

}  // namespace taut
