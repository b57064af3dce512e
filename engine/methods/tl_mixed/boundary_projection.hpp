#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "engine/core/point.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// A particle with prescribed velocity components and its interpolation by the corrected kernel, f(X_B) = Σ_a V_a
/// W̃_a(X_B) f_a, which is exact for linear f. [Lee2016] Eq. 23, Appendix B
struct BoundaryPoint {
  std::vector<std::pair<int, double>> w;  // index a in the projection; V_a W̃_a(X_B)
  unsigned axes = 0;                      // bit k: component k is prescribed
  Point velocity{};                       // m/s
};

/// Changes velocities least, in the mass-weighted mean square, such that the interpolated velocity has the prescribed
/// value at each point and both momenta are unchanged:
///   v̂_a = v_a + Σ_B V_a/m_a W̃_a(X_B) β_B + β_lin + β_ang × Z_a,
///   (i) v̂(X_B) = v_B,   (ii) Σ m_a v̂_a = Σ m_a v_a,   (iii) Σ m_a Z_a × v̂_a = Σ m_a Z_a × v_a.
/// [Lee2016] Appendix B, with the missing B.6; its V_B β_B is β_B/ρ0 here. Boundary particles must receive their own
/// prescribed velocities first, because the projection conserves momentum.
///
/// The matrices of (i), one per component, are sparse, depend on the reference configuration only and are factored
/// once. A Schur complement gives the 6 unknowns of (ii), (iii) in each call.
class BoundaryProjection {
 public:
  /// Takes particles of one body with masses m, kg. Throws SceneError if the points are linearly dependent.
  BoundaryProjection(std::vector<BoundaryPoint> points, std::vector<double> m);
  ~BoundaryProjection();
  BoundaryProjection(BoundaryProjection&&) noexcept;

  /// Projects the velocities `v`, m/s, of particles at Z, m.
  void operator()(std::vector<Point>& v, std::vector<Point> Z) const;
  /// Points, with mutable prescribed velocities.
  std::vector<BoundaryPoint>& points() { return points_; }
  /// Σ V_a W̃_a(X_B) f_a.
  Point interpolated(const BoundaryPoint& point, const std::vector<Point>& f) const;

 private:
  struct Factor;  // for one component

  std::vector<BoundaryPoint> points_;
  std::vector<double> m_;
  std::vector<Factor> factors_;
};

inline constexpr TermInfo boundary_projection_info{
    "boundary", "velocities nearest to those with v(X_B) = v_B, Σ V v and Σ V Z × v kept, where asked for",
    "[Lee2016] Appendix B", "methods/tl_mixed/boundary_projection.hpp:BoundaryProjection",
    "boundary projection: prescribed velocities where the kernel looks, both momenta kept"};

}  // namespace taut
