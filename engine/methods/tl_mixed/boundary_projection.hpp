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

/// Changes v least, weighted by mass, so that interpolated velocities are the prescribed ones (THEORY.md). Departures
/// from [Lee2016] Appendix B and step 8 of Algorithm 1: momenta may change, and boundary particles keep velocities of
/// their own; otherwise a boundary at rest does work.
class BoundaryProjection {
 public:
  /// `m` in kg. Throws SceneError if the conditions at the points are linearly dependent.
  BoundaryProjection(std::vector<BoundaryPoint> points, std::vector<double> m);
  ~BoundaryProjection();
  BoundaryProjection(BoundaryProjection&&) noexcept;

  /// `v` in m/s. Returns the impulses of the boundary at each point, N s.
  std::vector<Point> operator()(std::vector<Point>& v) const;
  /// Callers may change only the velocities.
  std::vector<BoundaryPoint>& points() { return points_; }

 private:
  struct Factor;

  std::vector<BoundaryPoint> points_;
  std::vector<double> m_;
  std::vector<Factor> factors_;
};

inline constexpr TermInfo boundary_projection_info{
    "boundary", "nearest velocities with v(X_B) = v_B; with boundary_projection = 1", "[Lee2016] Appendix B",
    "methods/tl_mixed/boundary_projection.hpp:BoundaryProjection",
    "boundary projection: boundary points get prescribed velocities by impulses at them"};

}  // namespace taut
