#include "cli/drawing/surface.hpp"

#include <algorithm>
#include <cmath>

#include "cli/drawing/delaunay.hpp"
#include "engine/layout/initial_particles.hpp"
#include "engine/layout/outline.hpp"
#include "engine/layout/surface_mesh.hpp"

namespace taut::cli {
namespace {

constexpr double longest = 2;  // spacings
constexpr double torn = 3;     // stretch

std::vector<std::vector<Point>> face_points(const Scene& scene) {
  const InitialParticles initial = make_initial_particles(scene);
  std::vector<std::vector<Point>> places(scene.bodies.size());
  const auto add = [&](int body, const Point& x) { places[static_cast<std::size_t>(body)].push_back(x); };
  if (scene.dim == 2) {
    const Outline outline = make_outline(scene, initial);
    for (std::size_t k = 0; k < outline.x.size(); ++k) add(outline.body[k], outline.x[k]);
  } else if (can_have_surface_mesh(scene)) {
    const SurfaceMesh mesh = make_surface_mesh(scene, initial);
    std::vector<bool> added(mesh.x.size());
    for (const SurfaceMesh::Facet& facet : mesh.facets)
      for (const int node : facet.node) {
        const auto k = static_cast<std::size_t>(node);
        if (!added[k]) add(facet.body, mesh.x[k]);
        added[k] = true;
      }
  }
  return places;
}

double squared_distance(std::span<const double> x, std::size_t dim, std::size_t i, std::size_t j) {
  double sum = 0;
  for (std::size_t k = 0; k < dim; ++k) sum += std::pow(x[dim * j + k] - x[dim * i + k], 2);
  return sum;
}

/// Twice the area, in 3D six times the volume. Positive if the points (in 3D the first three, seen from the last) are
/// anticlockwise.
double signed_size(std::span<const double> x, std::size_t dim, const std::array<std::uint32_t, 4>& points) {
  std::array<std::array<double, 3>, 3> way{};
  for (std::size_t c = 0; c < dim; ++c)
    for (std::size_t k = 0; k < dim; ++k) way[c][k] = x[dim * points[c + 1] + k] - x[dim * points[0] + k];
  if (dim == 2) way[2] = {0, 0, 1};
  const auto& [a, b, c] = way;
  return (a[1] * b[2] - a[2] * b[1]) * c[0] + (a[2] * b[0] - a[0] * b[2]) * c[1] +
         (a[0] * b[1] - a[1] * b[0]) * c[2];
}

}  // namespace

Surface::Surface(const Scene& scene, const Origins& origins, std::span<const std::size_t> shown,
                 const Expression& is_cut)
    : dim_(static_cast<std::size_t>(scene.dim)), particles_(shown.size()), dp_(scene.spacing) {
  InitialParticles particles;
  particles.dim = scene.dim;
  for (const std::size_t i : shown) {
    Point x{};
    std::copy_n(&origins.x0[dim_ * i], dim_, x.begin());
    particles.x.push_back(x);
    x0_.insert(x0_.end(), x.begin(), x.begin() + scene.dim);
  }
  const auto first_of = [&](std::size_t body) {
    return static_cast<int>(std::ranges::count_if(
        shown, [&](std::size_t i) { return origins.body[i] < static_cast<int>(body); }));
  };
  for (std::size_t body = 0; body <= scene.bodies.size(); ++body) particles.first.push_back(first_of(body));
  const std::vector<std::vector<Point>> places = face_points(scene);
  for (std::size_t body = 0; body < places.size(); ++body) {
    if (particles.first[body] == particles.first[body + 1]) continue;
    const std::size_t first_node = nodes_.x.size();
    add_nodes(scene, places[body], NodeWeights(particles, static_cast<int>(body), dp_), is_cut);
    triangulate(scene, static_cast<int>(body), particles.first, first_node);
  }
  do find_faces();
  while (drop_flat());
}

Point Surface::initial(std::uint32_t point) const {
  Point x{};
  std::copy_n(&x0_[dim_ * point], dim_, x.begin());
  return x;
}

void Surface::add_nodes(const Scene& scene, const std::vector<Point>& places, const NodeWeights& weights,
                        const Expression& is_cut) {
  constexpr double nearest = 0.1, farthest = 1.5;  // spacings
  for (const Point& x : places) {
    if (is_cut && is_cut(x) != 0) continue;
    std::vector<PointWeight> shares = weights.shares_of(x);
    if (shares.empty()) continue;
    const auto distance = [&](const PointWeight& share) {
      return distance_between(initial(static_cast<std::uint32_t>(share.particle)), x, scene.dim);
    };
    // nearest first
    std::ranges::iter_swap(shares.begin(), std::ranges::min_element(shares, {}, distance));
    const double least = distance(shares.front());
    if (least < nearest * dp_ || least > farthest * dp_) continue;
    nodes_.add(x, shares);
    x0_.insert(x0_.end(), x.begin(), x.begin() + scene.dim);
  }
}

void Surface::triangulate(const Scene& scene, int body, std::span<const int> first, std::size_t first_node) {
  const auto begin = static_cast<std::size_t>(first[static_cast<std::size_t>(body)]);
  const auto end = static_cast<std::size_t>(first[static_cast<std::size_t>(body) + 1]);
  std::vector<std::uint32_t> points;
  for (std::size_t i = begin; i < end; ++i) points.push_back(static_cast<std::uint32_t>(i));
  for (std::size_t k = first_node; k < nodes_.x.size(); ++k)
    points.push_back(static_cast<std::uint32_t>(particles_ + k));
  std::vector<double> x;  // spacings, from the first point
  for (const std::uint32_t i : points)
    for (std::size_t k = 0; k < dim_; ++k) x.push_back((x0_[dim_ * i + k] - x0_[dim_ * points[0] + k]) / dp_);
  const std::vector<std::uint32_t> all = delaunay(scene.dim, x);
  for (std::size_t k = 0; k < all.size(); k += dim_ + 1) {
    Simplex simplex{};
    for (std::size_t c = 0; c <= dim_; ++c) simplex[c] = points[all[k + c]];
    std::sort(simplex.begin(), simplex.begin() + scene.dim + 1);
    if (fits(scene, body, simplex)) simplices_.push_back(simplex);
  }
}

/// Rejects long edges of particles, and edges between nodes that bridge a groove. If all points can lie on faces,
/// also rejects simplices outside the body.
bool Surface::fits(const Scene& scene, int body, const Simplex& simplex) const {
  constexpr double chord = 0.15;  // tolerance for chords of concave faces, spacings
  const Body& of = scene.bodies[static_cast<std::size_t>(body)];
  const bool has_elements = scene.element_order > 0;  // whose nodes can be further apart
  Point middle{};
  for (std::size_t a = 0; a <= dim_; ++a) {
    const Point from = initial(simplex[a]);
    for (std::size_t k = 0; k < dim_; ++k) middle[k] += from[k] / static_cast<double>(dim_ + 1);
    for (std::size_t b = 0; b < a; ++b) {
      const Point to = initial(simplex[b]);
      if (!has_elements && distance_between(from, to, scene.dim) > longest * dp_) return false;
      const Point half{0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1]), 0.5 * (from[2] + to[2])};
      if ((has_elements || simplex[b] >= particles_) && !holds(of, half, scene.dim, chord * dp_))
        return false;
    }
  }
  const bool on_faces = has_elements || of.on_boundary || simplex[0] >= particles_;
  return !on_faces || holds(of, middle, scene.dim, 0);
}

/// Drops flat boundary simplices, whose outward side depends on round-off. Returns whether any was dropped.
bool Surface::drop_flat() {
  const double least = 1e-3 * std::pow(dp_, static_cast<double>(dim_));
  std::vector<bool> drop(simplices_.size());
  for (const Face& face : faces_) {
    const auto simplex = static_cast<std::size_t>(face.of[0]);
    if (face.of[1] < 0) drop[simplex] = std::abs(signed_size(x0_, dim_, simplices_[simplex])) < least;
  }
  std::size_t next = 0;
  return std::erase_if(simplices_, [&](const Simplex&) { return drop[next++]; }) > 0;
}

void Surface::find_faces() {
  faces_.clear();
  std::vector<Face> all;
  for (std::size_t s = 0; s < simplices_.size(); ++s)
    for (std::size_t without = 0; without <= dim_; ++without) {
      Face face{{}, {static_cast<int>(s), -1}};
      for (std::size_t c = 0, k = 0; c <= dim_; ++c)
        if (c != without) face.point[k++] = simplices_[s][c];
      all.push_back(face);
    }
  std::ranges::stable_sort(all, {}, &Face::point);
  for (const Face& face : all) {
    if (!faces_.empty() && faces_.back().point == face.point)
      faces_.back().of[1] = face.of[0];
    else
      faces_.push_back(face);
  }
}

std::vector<double> Surface::points_at(std::span<const double> x) const {
  std::vector<double> all(x.begin(), x.end());
  all.resize(x0_.size(), 0);
  for (std::size_t n = 0; n < nodes_.x.size(); ++n)
    for (int s = nodes_.begin[n]; s < nodes_.begin[n + 1]; ++s) {
      const auto& [particle, weight] = nodes_.shares[static_cast<std::size_t>(s)];
      for (std::size_t k = 0; k < dim_; ++k)
        all[dim_ * (particles_ + n) + k] += weight * x[dim_ * static_cast<std::size_t>(particle) + k];
    }
  return all;
}

/// False for NaN.
bool Surface::is_whole(const Simplex& simplex, std::span<const double> x) const {
  for (std::size_t a = 0; a <= dim_; ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (!(squared_distance(x, dim_, simplex[a], simplex[b]) <=
            torn * torn * squared_distance(x0_, dim_, simplex[a], simplex[b])))
        return false;
  return true;
}

/// Faces of exactly one kept simplex; in 3D anticlockwise from outside.
std::vector<std::array<std::uint32_t, 3>> Surface::boundary(const std::vector<bool>& kept,
                                                            std::span<const double> x) const {
  std::vector<std::array<std::uint32_t, 3>> found;
  const auto is_kept = [&](int simplex) { return simplex >= 0 && kept[static_cast<std::size_t>(simplex)]; };
  for (const Face& face : faces_) {
    const auto& points = face.point;
    const auto& of = face.of;
    if (is_kept(of[0]) == is_kept(of[1])) continue;
    found.push_back(points);
    if (dim_ == 2) continue;
    const Simplex& simplex = simplices_[static_cast<std::size_t>(is_kept(of[0]) ? of[0] : of[1])];
    const std::uint32_t behind = *std::ranges::find_if(
        simplex, [&](std::uint32_t p) { return std::ranges::find(points, p) == points.end(); });
    const double volume = signed_size(x, dim_, {points[0], points[1], points[2], behind});
    if (volume > 0) std::swap(found.back()[1], found.back()[2]);
  }
  return found;
}

std::vector<double> Surface::segments(const std::vector<std::array<std::uint32_t, 3>>& faces,
                                      std::span<const double> x) const {
  std::vector<double> all;
  for (const auto& face : faces)
    for (const std::uint32_t point : {face[0], face[1]})
      for (std::size_t k = 0; k < 2; ++k) all.push_back(x[2 * point + k]);
  return all;
}

std::vector<double> Surface::undeformed() const {
  return segments(boundary(std::vector<bool>(simplices_.size(), true), x0_), x0_);
}

SurfaceShape Surface::at(std::span<const double> x, std::span<const double> value, bool uniform) const {
  SurfaceShape shape{.x = points_at(x), .value = {value.begin(), value.end()}};
  for (std::size_t n = 0; n < nodes_.x.size(); ++n) {
    double sum = 0, low = 1e300, high = -1e300;
    for (int s = nodes_.begin[n]; s < nodes_.begin[n + 1]; ++s) {
      const auto& [particle, weight] = nodes_.shares[static_cast<std::size_t>(s)];
      const double of = value[static_cast<std::size_t>(particle)];
      sum += weight * of, low = std::min(low, of), high = std::max(high, of);
    }
    const auto& nearest = nodes_.shares[static_cast<std::size_t>(nodes_.begin[n])];
    shape.value.push_back(uniform           ? value[static_cast<std::size_t>(nearest.particle)]
                          : std::isnan(sum) ? sum
                                            : std::clamp(sum, low, high));
  }
  std::vector<bool> kept(simplices_.size()), used(particles_);
  for (std::size_t s = 0; s < simplices_.size(); ++s) {
    kept[s] = is_whole(simplices_[s], shape.x);
    if (!kept[s]) continue;
    for (std::size_t c = 0; c <= dim_; ++c)
      if (simplices_[s][c] < particles_) used[simplices_[s][c]] = true;
    if (dim_ == 2)
      shape.triangle.insert(shape.triangle.end(), simplices_[s].begin(), simplices_[s].begin() + 3);
  }
  const auto faces = boundary(kept, shape.x);
  if (dim_ == 2)
    shape.outline = segments(faces, shape.x);
  else
    for (const auto& face : faces) shape.triangle.insert(shape.triangle.end(), face.begin(), face.end());
  for (std::uint32_t i = 0; i < particles_; ++i)
    if (!used[i]) shape.loose.push_back(i);
  return shape;
}

}  // namespace taut::cli
