#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/scene/shape.hpp"

namespace taut {

/// (a − o) × (b − o), m²; positive if b is left of a.
double turn(const Point& o, const Point& a, const Point& b);

/// Grid points, `pitch` apart, m.
struct PlaceGrid {
  Point low{};
  double pitch = 0;
  long columns = 0, rows = 0;

  Point at(long column, long row) const {
    return {low[0] + static_cast<double>(column) * pitch, low[1] + static_cast<double>(row) * pitch, 0};
  }
};

/// Faces of the grid points for which `inside(column, row)`, by marching squares: closed chains, solid on the left,
/// through face(in, out) between neighbours. Parts that touch at a corner are separate. Beyond the grid all is
/// outside.
std::vector<Chain> contours(const PlaceGrid& grid, const std::function<bool(long, long)>& inside,
                            const std::function<Point(const Point&, const Point&)>& face);

/// Faces of `inside`, bisected to 1e-9 of the pitch.
std::vector<Chain> contours(const PlaceGrid& grid, const std::function<bool(const Point&)>& inside);

/// Drops points of a closed chain that deviate at most `tolerance`, m [Douglas, Peucker 1973].
Chain simplified(const Chain& chain, double tolerance);

/// Points about dp apart on the chain, and at corners: turns above 40° of the chain simplified to 0.1 dp.
Chain evenly_spaced(const Chain& chain, double dp);
std::vector<Chain> evenly_spaced(const std::vector<Chain>& chains, double dp);

/// Evenly spaced faces of `inside` in a box; misses steps below a quarter of dp.
std::vector<Chain> evenly_spaced_contours(const Bounds& box, const std::function<bool(const Point&)>& inside,
                                          double dp);

enum class Combination : std::uint8_t {
  together,    // union
  common,      // intersection
  difference,  // the first without the others
};
/// Faces of combined solids, accurate to 1e-5 dp; drops parts thinner than 0.1 dp.
std::vector<Chain> combined(Combination how, const std::vector<std::vector<Chain>>& solids, double dp);

}  // namespace taut
