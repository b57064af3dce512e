#pragma once

#include <string>
#include <vector>

#include "engine/diagnostics/fields.hpp"
#include "render/look.hpp"

namespace taut::cli {

inline constexpr int most_frames = 1000000;

/// What is drawn of a run, and how. An open colour map goes by the field: viridis, or diverging for signed
/// fields; an open range or view holds all that is shown.
struct Drawing {
  const Field* field = find_field("von_mises");  // that the particles are coloured by
  render::Look look;
  int frames = 60;  // evenly spaced after the one at t = 0
};

std::vector<std::string> names_of_fields();
std::vector<std::string> names_of_fields(int dim);
/// Throws UsageError, with the nearest name, for a field that does not exist in scenes of `dim` dimensions.
const Field& known_field(const std::string& key, int dim = 3);

}  // namespace taut::cli
