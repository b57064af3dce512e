#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cli/drawing/origins.hpp"
#include "engine/layout/face_nodes.hpp"
#include "engine/scene/scene.hpp"

namespace taut::cli {

/// Points are particles, then nodes.
struct SurfaceShape {
  std::vector<double> x{}, value{};       // x: dim coordinates per point, m
  std::vector<std::uint32_t> triangle{};  // 3 points each; 3D: anticlockwise from outside
  std::vector<double> outline{};          // 2D: four coordinates per segment, m
  std::vector<std::uint32_t> loose{};     // particles without an unbroken simplex
};

/// Delaunay triangles (in 3D tetrahedra) of the reference positions of particles and of nodes on faces, without long or
/// torn edges.
class Surface {
 public:
  /// Particle k is `shown[k]` of the scene, ascending. `is_cut` hides nodes.
  Surface(const Scene& scene, const Origins& origins, std::span<const std::size_t> shown,
          const Expression& is_cut);

  /// `x`: n × dim, m. A node's value is interpolated or, if `uniform`, that of its nearest particle.
  SurfaceShape at(std::span<const double> x, std::span<const double> value, bool uniform) const;
  /// 2D: four coordinates per segment, m.
  std::vector<double> undeformed() const;

 private:
  using Simplex = std::array<std::uint32_t, 4>;  // in 2D, the last is unused
  struct Face {
    std::array<std::uint32_t, 3> point{};  // ascending
    std::array<int, 2> of{-1, -1};         // simplices; the second is −1 at the surface
  };

  Point initial(std::uint32_t point) const;
  void add_nodes(const Scene& scene, const std::vector<Point>& places, const NodeWeights& weights,
                 const Expression& is_cut);
  void triangulate(const Scene& scene, int body, std::span<const int> first, std::size_t first_node);
  bool fits(const Scene& scene, int body, const Simplex& simplex) const;
  void find_faces();
  bool drop_flat();
  std::vector<double> points_at(std::span<const double> x) const;
  bool is_whole(const Simplex& simplex, std::span<const double> x) const;
  std::vector<std::array<std::uint32_t, 3>> boundary(const std::vector<bool>& kept,
                                                     std::span<const double> x) const;
  std::vector<double> segments(const std::vector<std::array<std::uint32_t, 3>>& faces,
                               std::span<const double> x) const;

  std::size_t dim_, particles_ = 0;
  double dp_;               // m
  std::vector<double> x0_;  // m
  FaceNodes nodes_;         // shares refer to particles of the surface
  std::vector<Simplex> simplices_;
  std::vector<Face> faces_;
};

}  // namespace taut::cli
