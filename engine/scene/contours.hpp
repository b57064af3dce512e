#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/scene/shape.hpp"

namespace taut {

/// Cross product of the ways from o to a and to b, m²: positive where b lies to the left.
double turn(const Point& o, const Point& a, const Point& b);

/// A grid of places, m, `pitch` apart.
struct PlaceGrid {
  Point low{};
  double pitch = 0;
  long columns = 0, rows = 0;

  Point at(long column, long row) const {
    return {low[0] + static_cast<double>(column) * pitch, low[1] + static_cast<double>(row) * pitch, 0};
  }
};

/// The faces of what holds the places of a grid for which `inside(column, row)`: closed chains with the solid
/// to their left, through `face(from, to)` between two neighbours of which the first alone is inside.
/// Marching squares; what meets at a corner only is apart. Beyond the grid nothing is inside.
std::vector<Chain> contours(const PlaceGrid& grid, const std::function<bool(long, long)>& inside,
                            const std::function<Point(const Point&, const Point&)>& face);

/// The same of a function of the place, whose face is found by halving to 1e-9 of the pitch.
std::vector<Chain> contours(const PlaceGrid& grid, const std::function<bool(const Point&)>& inside);

/// What is left of a closed chain of which no point may be left out that is more than `tolerance`, m, beside
/// the way between those that stay [Douglas, Peucker 1973].
Chain simplified(const Chain& chain, double tolerance);

/// The same face by points about dp apart that lie on it; the corners are points. Turns of less than 40°
/// within a tenth of dp are no corners: curves are laid finely.
Chain evenly_spaced(const Chain& chain, double dp);
std::vector<Chain> evenly_spaced(const std::vector<Chain>& chains, double dp);

/// Evenly spaced faces of the places in a box for which `inside` is true; steps below a quarter of dp are not seen.
std::vector<Chain> evenly_spaced_contours(const Bounds& box, const std::function<bool(const Point&)>& inside,
                                          double dp);

enum class Combination : std::uint8_t {
  together,    // what is in any of them
  common,      // in all of them
  difference,  // in the first and in no other
};
/// The faces of a combination of solids, each given by its faces; a point is as good as 1e-5 dp. What is
/// thinner than a tenth of dp is left out.
std::vector<Chain> combined(Combination how, const std::vector<std::vector<Chain>>& solids, double dp);

}  // namespace taut
