#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "engine/core/point.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// f(X_B) = Σ_a w_a f_a, [Lee2016] Eq. 23.
struct BoundaryPoint {
  std::vector<std::pair<int, double>> w;  // index a in `v`; w_a = V_a W̃_a(X_B)
  unsigned axes = 0;                      // bit k: prescribed component
  Point velocity{};                       // m/s
};

/// Changes v least, weighted by mass, so that interpolated velocities are the prescribed ones, [Lee2016] Appendix B
/// (THEORY.md). Conserves both momenta. Set boundary particles to their prescribed velocities first.
class BoundaryProjection {
 public:
  /// `m` in kg. Throws SceneError if the conditions at the points are linearly dependent.
  BoundaryProjection(std::vector<BoundaryPoint> points, std::vector<double> m);
  ~BoundaryProjection();
  BoundaryProjection(BoundaryProjection&&) noexcept;

  /// `v` in m/s, positions `Z` in m.
  void operator()(std::vector<Point>& v, std::vector<Point> Z) const;
  /// Callers may change only the velocities.
  std::vector<BoundaryPoint>& points() { return points_; }
  Point interpolated(const BoundaryPoint& point, const std::vector<Point>& f) const;

 private:
  struct Factor;

  std::vector<BoundaryPoint> points_;
  std::vector<double> m_;
  std::vector<Factor> factors_;
};

inline constexpr TermInfo boundary_projection_info{
    "boundary",
    "nearest velocities with v(X_B) = v_B and unchanged Σ m v, Σ m Z × v; with boundary_projection = 1",
    "[Lee2016] Appendix B", "methods/tl_mixed/boundary_projection.hpp:BoundaryProjection",
    "boundary projection: boundary points get prescribed velocities, and momenta are conserved"};

}  // namespace taut
