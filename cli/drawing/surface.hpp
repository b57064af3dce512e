#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cli/drawing/origins.hpp"
#include "engine/layout/face_nodes.hpp"
#include "engine/scene/scene.hpp"

namespace taut::cli {

/// A surface at one time. Its points are the particles, then the nodes on faces.
struct SurfaceShape {
  std::vector<double> x{}, value{};       // of points; x has dim coordinates each, m
  std::vector<std::uint32_t> triangle{};  // 3 points each; in 3D the outside, anticlockwise from outside
  std::vector<double> outline{};          // 2D: segments, four coordinates each, m
  std::vector<std::uint32_t> loose{};     // particles of no triangle
};

/// Continuous bodies: the Delaunay triangles (in 3D tetrahedra) of the initial positions of particles and of nodes on
/// the faces that contact uses. A node moves with the particles around it. Triangles have edges of at most two spacings
/// and are dropped where an edge is stretched more than three times: neighbours are then beyond the range of the usual
/// kernel (2.6 spacings).
class Surface {
 public:
  /// Particle k of the surface is `shown[k]` of the scene, ascending. `is_cut` hides nodes. Bodies without faces end at
  /// their outermost particles.
  Surface(const Scene& scene, const Origins& origins, std::span<const std::size_t> shown,
          const Expression& is_cut);

  /// Positions `x` (n × dim, m) and values of the particles. Nodes have interpolated values, or, if `uniform`, the
  /// value of the nearest particle.
  SurfaceShape at(std::span<const double> x, std::span<const double> value, bool uniform) const;
  /// 2D: the initial outline, four coordinates per segment, m.
  std::vector<double> undeformed() const;

 private:
  using Simplex = std::array<std::uint32_t, 4>;  // in 2D, the last one is unused
  struct Face {
    std::array<std::uint32_t, 3> point{};  // ascending; in 2D, the last one is unused
    std::array<int, 2> of{-1, -1};         // simplices; the second may be missing
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
  std::vector<double> x0_;  // of points, m
  FaceNodes nodes_;         // shares count the particles of the surface
  std::vector<Simplex> simplices_;
  std::vector<Face> faces_;
};

}  // namespace taut::cli
