#pragma once

#include <array>

namespace taut {

/// A point or vector of up to three components; those beyond the scene's dimension are 0. SI units.
using Point = std::array<double, 3>;

}  // namespace taut
