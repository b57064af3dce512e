#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/scene/shape.hpp"

namespace taut {

/// (a − o) × (b − o), m²; positive for a left turn.
double turn(const Point& o, const Point& a, const Point& b);

struct PlaceGrid {
  Point low{};
  double pitch = 0;
  long columns = 0, rows = 0;

  Point at(long column, long row) const {
    return {low[0] + static_cast<double>(column) * pitch, low[1] + static_cast<double>(row) * pitch, 0};
  }
};

/// Marching squares over inside(column, row), with the solid on the left. Between the neighbours `in` and `out`,
/// contours pass through face(in, out). Parts that touch at a corner are separate.
std::vector<Chain> contours(const PlaceGrid& grid, const std::function<bool(long, long)>& inside,
                            const std::function<Point(const Point&, const Point&)>& face);

/// Bisected to 1e-9 of the pitch.
std::vector<Chain> contours(const PlaceGrid& grid, const std::function<bool(const Point&)>& inside);

/// Omits points that deviate by at most `tolerance` [Douglas, Peucker 1973].
Chain simplified(const Chain& chain, double tolerance);

/// Points about dp apart, including all corners (turns by more than 40°).
Chain evenly_spaced(const Chain& chain, double dp);
std::vector<Chain> evenly_spaced(const std::vector<Chain>& chains, double dp);

/// Misses details smaller than dp/4.
std::vector<Chain> evenly_spaced_contours(const Bounds& box, const std::function<bool(const Point&)>& inside,
                                          double dp);

enum class Combination : std::uint8_t {
  together,    // union
  common,      // intersection
  difference,  // first without the others
};
/// Rounds coordinates to 2⁻¹⁶ dp; drops slivers.
std::vector<Chain> combined(Combination how, const std::vector<std::vector<Chain>>& solids, double dp);

}  // namespace taut
