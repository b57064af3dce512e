#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "engine/core/point.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// A particle with components of the velocity that are prescribed, and what the corrected kernel sees there:
/// f(X_B) = Σ_a V_a W̃_a(X_B) f_a, exact for linear f.                          [Lee2016] Eq. 23, Appendix B
struct BoundaryPoint {
  std::vector<std::pair<int, double>> w;  // a, among the particles of the projection; V_a W̃_a(X_B)
  unsigned axes = 0;                      // bit k: component k is prescribed
  Point velocity{};                       // m/s
};

/// The velocities nearest to given ones, in the mean square over the mass, that are the prescribed ones where
/// the kernel interpolates at the points and have the same linear and angular momentum:
///   v̂_a = v_a + Σ_B V_a/m_a W̃_a(X_B) β_B + β_lin + β_ang × Z_a,
///   (i) v̂(X_B) = v_B,   (ii) Σ m_a v̂_a = Σ m_a v_a,   (iii) Σ m_a Z_a × v̂_a = Σ m_a Z_a × v_a.
/// [Lee2016] Appendix B, B.6 restored; its V_B β_B is β_B/ρ0 here. Both momenta are kept, so that particles
/// on the boundary must have been given their own velocities before, which is what they push with.
///
/// The matrix of (i), one for each component, is of the reference configuration and sparse: factored once.
/// The 6 unknowns of (ii), (iii) follow by a Schur complement each time.
class BoundaryProjection {
 public:
  /// Of particles of one body, of masses m. Throws SceneError where points cannot be told apart.
  BoundaryProjection(std::vector<BoundaryPoint> points, std::vector<double> m);
  ~BoundaryProjection();
  BoundaryProjection(BoundaryProjection&&) noexcept;

  /// `v` of the particles, m/s, moments about Z, m.
  void operator()(std::vector<Point>& v, std::vector<Point> Z) const;
  /// The points, whose prescribed velocities may change.
  std::vector<BoundaryPoint>& points() { return points_; }
  /// Σ V_a W̃_a(X_B) f_a, component by component.
  Point interpolated(const BoundaryPoint& point, const std::vector<Point>& f) const;

 private:
  struct Factor;  // of a component

  std::vector<BoundaryPoint> points_;
  std::vector<double> m_;
  std::vector<Factor> factors_;
};

inline constexpr TermInfo boundary_projection_info{
    "boundary", "velocities nearest to those with v(X_B) = v_B, Σ V v and Σ V Z × v kept, where asked for",
    "[Lee2016] Appendix B", "methods/tl_mixed/boundary_projection.hpp:BoundaryProjection",
    "boundary projection: boundary points get prescribed velocities, both momenta are conserved"};

}  // namespace taut
