#include "engine/layout/surface_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <variant>

#include "engine/core/index.hpp"
#include "engine/core/parallel.hpp"
#include "engine/layout/point_grid.hpp"
#include "engine/scene/shapes/box.hpp"

namespace taut {
namespace {

constexpr int dim = 3;
using Cell = std::array<long, dim>;

bool stands_on_boundary(const Body& body) { return body.on_boundary && body.without.empty(); }

/// Lattice before rotation; cell n is centred at anchor + (n + ½) pitch.
struct Cells {
  Shape first;
  Point anchor{}, pitch{};

  Cells(const Body& body, double dp)
      : first(body.shapes.front()), anchor(first->anchor()), pitch{dp, dp, dp} {
    if (!stands_on_boundary(body)) return;
    const Box& box = *first.as<Box>();
    for (std::size_t k = 0; k < dim; ++k) {
      pitch[k] = (box.high[k] - box.low[k]) / static_cast<double>(box.cells(k, dp));
      anchor[k] = box.low[k] - 0.5 * pitch[k];
    }
  }

  Cell of(const Point& x) const {
    const Point at = first->to_lattice(x);
    Cell n{};
    for (std::size_t k = 0; k < dim; ++k) n[k] = std::lround((at[k] - anchor[k]) / pitch[k] - 0.5);
    return n;
  }
  Point corner(const Cell& n, const Point& off = {}) const {
    Point at{};
    for (std::size_t k = 0; k < dim; ++k) at[k] = anchor[k] + (static_cast<double>(n[k]) + off[k]) * pitch[k];
    return first->from_lattice(at);
  }
};

FacePatches own_patches(const Body& body, double dp) {
  return body.shapes.size() == 1 && body.without.empty() && !body.relaxed ? body.shapes.front()->patches(dp)
                                                                          : FacePatches{};
}

/// Faces of a body before its reflection and rotation.
class Faces {
 public:
  Faces(const Body& laid, double dp) : body_(laid), dp_(dp) {}

  /// Point of a face near x, or x if there is none. `outside`: a point further outwards.
  Point nearest(const Point& x, const Point& outside) const {
    const std::optional<Point> at = descend_to_face(x);
    return at && is_face(*at) ? *at : on_the_line(x, outside);
  }

  bool is_face(const Point& x) const {
    bool filled = false, empty = false;
    for (const double a : {-aside, aside})
      for (const double b : {-aside, aside})
        for (const double c : {-aside, aside})
          (is_filled({x[0] + a * dp_, x[1] + b * dp_, x[2] + c * dp_}) ? filled : empty) = true;
    return filled && empty;
  }
  /// First face on the line through x and `outside`: outwards if x is solid, otherwise inwards. Returns x if none is
  /// within 1.5 spacings.
  Point on_the_line(const Point& x, const Point& outside) const {
    const double length = distance_between(outside, x, dim);
    if (!(length > 0)) return x;
    const bool inside = is_filled(x);
    const auto at = [&](double way) {
      Point y = x;
      for (std::size_t k = 0; k < dim; ++k)
        y[k] += (inside ? way : -way) * dp_ / length * (outside[k] - x[k]);
      return y;
    };
    double high = stride;
    while (high < farthest && is_filled(at(high)) == inside) high += stride;
    if (high >= farthest) return x;
    double low = high - stride;
    while (high - low > 1e-5 * fine) {
      const double middle = 0.5 * (low + high);
      (is_filled(at(middle)) == inside ? low : high) = middle;
    }
    return at(inside ? low - fine : low + fine);  // is_filled widens shapes by `fine`
  }

 private:
  // in spacings
  static constexpr double fine = 1e-6, aside = 1e-3, farthest = 1.5, stride = 0.05;
  static constexpr double least_slope = 0.1;  // square of the slope

  std::optional<Point> descend_to_face(const Point& x) const {
    constexpr int steps = 20;
    Point at = x;
    for (int step = 0; step < steps; ++step) {
      const double off = height(at);
      if (std::abs(off) < fine * dp_) {
        if (distance_between(at, x, dim) < farthest * dp_) return at;
        break;
      }
      Point slope{};
      double square = 0;
      for (std::size_t k = 0; k < dim; ++k) {
        Point more = at, less = at;
        more[k] += aside * dp_, less[k] -= aside * dp_;
        slope[k] = (height(more) - height(less)) / (2 * aside * dp_);
        square += slope[k] * slope[k];
      }
      if (square < least_slope) break;
      for (std::size_t k = 0; k < dim; ++k) at[k] -= off / square * slope[k];
    }
    return std::nullopt;
  }

  /// Distance to a face in m, negative inside; 0 on seams between shapes.
  double height(const Point& x) const {
    if (on_face(x)) return 0;
    double low = -2 * farthest * dp_, high = 2 * farthest * dp_;
    while (high - low > 1e-3 * fine * dp_) {
      const double middle = 0.5 * (low + high);
      (holds(body_, x, dim, middle) ? high : low) = middle;
    }
    return 0.5 * (low + high);
  }
  bool on_face(const Point& x) const {
    return holds(body_, x, dim, fine * dp_) && !holds(body_, x, dim, -fine * dp_);
  }

  /// Widens shapes and cut-outs to close seams.
  bool is_filled(const Point& x) const {
    const auto any_holds = [&](const std::vector<Shape>& shapes) {
      return std::ranges::any_of(shapes,
                                 [&](const Shape& shape) { return shape->holds(x, dim, fine * dp_); });
    };
    return any_holds(body_.shapes) && !any_holds(body_.without);
  }

  const Body& body_;
  double dp_;  // m
};

class BodyMesh {
 public:
  BodyMesh(const Scene& scene, const InitialParticles& initial, int body, SurfaceMesh& out)
      : given_(scene.bodies[as_index(body)]),
        laid_(unplaced_body(given_, dim)),
        dp_(scene.spacing),
        index_(body),
        cells_(laid_, dp_),
        faces_(laid_, dp_),
        initial_(initial),
        particles_(initial, body, dp_),
        turned_inside_out_((given_.mirror[0] != given_.mirror[1]) != given_.mirror[2]),
        out_(out) {
    first_ = initial.first[as_index(body)];
  }

  void add(int threads) {
    if (const FacePatches patches = own_patches(laid_, dp_); !patches.patches.empty()) {
      take(patches);
      add_nodes(static_cast<int>(patches.node.size()), threads,
                [&](int k) { return patches.node[as_index(k)]; });
    } else {
      find_facets();
      add_nodes(static_cast<int>(corner_.size()), threads,
                [&](int k) { return place_of(corner_[as_index(k)]); });
    }
    place_facets(threads);
    out_.closed.push_back(std::ranges::count(node_, -1) == 0);
  }

 private:
  struct Corner {
    Cell cell{};
    Point outwards{};
  };
  struct Node {
    Point x{};
    std::vector<PointWeight> shares;
  };

  void take(const FacePatches& patches) {
    for (const FacePatches::Patch& patch : patches.patches) {
      facets_.push_back({.node = patch.node, .body = index_, .particle = first_ + patch.site});
      if (turned_inside_out_) std::swap(facets_.back().node[1], facets_.back().node[3]);
    }
  }

  struct Filled {
    std::vector<Cell> cells;
    std::vector<int> particles;  // one in or near each cell
  };
  Filled filled_cells() const {
    Filled all;
    std::vector<Point> places;  // in spacings
    for (int i = first_; i < initial_.first[as_index(index_) + 1]; ++i) {
      Point x = unplaced_point(given_, initial_.x[as_index(i)], dim);
      if (!given_.relaxed) all.cells.push_back(cells_.of(x)), all.particles.push_back(i);
      for (double& component : x) component /= dp_;
      places.push_back(x);
    }
    if (!given_.relaxed) return all;
    constexpr long farthest = 4;
    const PointGrid grid(std::move(places), dim);
    for (const InitialSite& site : lattice_sites(laid_, dim, dp_)) {
      const int i = grid.nearest({site.x[0] / dp_, site.x[1] / dp_, site.x[2] / dp_}, farthest).index;
      if (i >= 0) all.cells.push_back(cells_.of(site.x)), all.particles.push_back(first_ + i);
    }
    return all;
  }
  void find_facets() {
    const auto [filled, particles] = filled_cells();
    std::vector<Cell> sorted = filled;
    std::ranges::sort(sorted);
    for (std::size_t i = 0; i < filled.size(); ++i) {
      for (std::size_t axis = 0; axis < dim; ++axis) {
        for (const long side : {0L, 1L}) {
          Cell beyond = filled[i];
          beyond[axis] += 2 * side - 1;
          if (!std::ranges::binary_search(sorted, beyond))
            facets_.push_back(
                {.node = corners_of(filled[i], axis, side), .body = index_, .particle = particles[i]});
        }
      }
    }
  }
  std::array<int, 4> corners_of(const Cell& cell, std::size_t axis, long side) {
    const std::size_t u = (axis + 1) % dim, v = (axis + 2) % dim;
    constexpr std::array<std::array<long, 2>, 4> around = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    std::array<int, 4> corners{};
    for (std::size_t k = 0; k < around.size(); ++k) {
      Cell corner = cell;
      corner[axis] += side, corner[u] += around[k][0], corner[v] += around[k][1];
      const auto [found, is_new] = number_.try_emplace(corner, static_cast<int>(corner_.size()));
      if (is_new) corner_.push_back({corner});
      corner_[as_index(found->second)].outwards[axis] += static_cast<double>(2 * side - 1);
      corners[k] = found->second;
    }
    if ((side == 0) != turned_inside_out_) std::swap(corners[1], corners[3]);
    return corners;
  }

  /// Point where several lattice-aligned faces meet; the nearest point of one face may not lie on the others.
  std::optional<Point> on_rim(const Cell& cell, const Point& outwards) const {
    if (std::ranges::count(outwards, 0.0) > dim - 2) return std::nullopt;
    Point off{};  // in pitches
    for (std::size_t a = 0; a < dim; ++a) {
      if (outwards[a] == 0) continue;
      std::array<double, 2> way{};  // to the face, in pitches, from half a cell and a whole cell inside
      for (std::size_t n = 0; n < way.size(); ++n) {
        Point beside{};
        for (std::size_t b = 0; b < dim; ++b)
          if (b != a && outwards[b] != 0)
            beside[b] = std::copysign(0.5 * static_cast<double>(n + 1), -outwards[b]);
        Point outside = beside;
        outside[a] += std::copysign(1, outwards[a]);
        const Point from = cells_.corner(cell, beside), out = cells_.corner(cell, outside);
        const Point face = faces_.on_the_line(from, out);
        double length2 = 0;
        for (std::size_t k = 0; k < dim; ++k) {
          way[n] += (face[k] - from[k]) * (out[k] - from[k]);
          length2 += (out[k] - from[k]) * (out[k] - from[k]);
        }
        way[n] /= length2;
      }
      constexpr double alike = 1e-4, farthest = 0.6;  // in pitches
      if (std::abs(way[0] - way[1]) > alike || std::abs(way[0]) > farthest) return std::nullopt;
      off[a] = way[0] * std::copysign(1, outwards[a]);
    }
    const Point at = cells_.corner(cell, off);
    return faces_.is_face(at) ? std::optional(at) : std::nullopt;
  }

  Point place_of(const Corner& corner) const {
    const auto& [cell, outwards] = corner;
    if (const std::optional<Point> rim = on_rim(cell, outwards)) return *rim;
    return faces_.nearest(cells_.corner(cell), cells_.corner(cell, outwards));
  }

  template <class Place>
  void add_nodes(int number, int threads, const Place& place) {
    const auto make = [&](int k) {
      const Point x = placed(given_, place(k), dim);
      return Node{x, particles_.shares_of(x)};
    };
    node_.assign(as_index(number), -1);
    make_in_order(number, threads, make, [&](int k, const Node& node) {
      if (node.shares.empty()) return;
      node_[as_index(k)] = out_.size();
      out_.add(node.x, node.shares);
    });
  }

  void place_facets(int threads) {
    const auto make = [&](int k) {
      SurfaceMesh::Facet facet = facets_[as_index(k)];
      std::array<Point, 4> at{};
      for (std::size_t c = 0; c < at.size(); ++c) {
        facet.node[c] = node_[as_index(facet.node[c])];
        if (facet.node[c] < 0) return SurfaceMesh::Facet{};
        at[c] = out_.x[as_index(facet.node[c])];
      }
      facet.area = distance_between(vector_area(at), {}, dim);
      if (facet.area > 0) facet.bulge = bulge_of(at, facet.area);
      return facet;
    };
    make_in_order(static_cast<int>(facets_.size()), threads, make, [&](int, const SurfaceMesh::Facet& facet) {
      constexpr double least_area = 0.01;  // dp²
      if (facet.area > least_area * dp_ * dp_) out_.facets.push_back(facet);
    });
  }

  double bulge_of(const std::array<Point, 4>& corner, double area) const {
    Point mean{};
    for (std::size_t k = 0; k < dim; ++k)
      mean[k] = 0.25 * ((corner[0][k] + corner[2][k]) + (corner[1][k] + corner[3][k]));
    const Point out = vector_area(corner);
    Point outside = mean;
    for (std::size_t k = 0; k < dim; ++k) outside[k] += dp_ / area * out[k];
    const Point face = placed(
        given_, faces_.nearest(unplaced_point(given_, mean, dim), unplaced_point(given_, outside, dim)), dim);
    double along = 0;
    for (std::size_t k = 0; k < dim; ++k) along += (face[k] - mean[k]) * out[k] / area;
    return along;
  }

  const Body& given_;
  Body laid_;
  double dp_;  // m
  int index_, first_ = 0;
  Cells cells_;
  Faces faces_;
  const InitialParticles& initial_;
  NodeWeights particles_;
  bool turned_inside_out_;
  SurfaceMesh& out_;
  std::vector<SurfaceMesh::Facet> facets_;
  std::vector<Corner> corner_;
  std::map<Cell, int> number_;  // of corners
  std::vector<int> node_;
};

/// Facets on the boundary of finite elements.
SurfaceMesh surface_of(const Scene& scene, const InitialParticles& initial) {
  SurfaceMesh mesh;
  std::vector<int> known(initial.x.size(), -1);
  for (MeshFacet& facet : boundary_of(initial.mesh)) {
    if (facet.inverted) std::swap(facet.node[1], facet.node[3]);
    SurfaceMesh::Facet out{.body = initial.mesh.body[as_index(facet.element)], .particle = facet.node[0]};
    std::array<Point, 4> at{};
    for (std::size_t k = 0; k < at.size(); ++k) {
      const int particle = facet.node[k];
      at[k] = initial.x[as_index(particle)];
      int& node = known[as_index(particle)];
      if (node < 0) node = mesh.size(), mesh.add(at[k], {{particle, 1}});
      out.node[k] = node;
    }
    out.area = distance_between(vector_area(at), {}, dim);
    mesh.facets.push_back(out);
  }
  mesh.closed.assign(scene.bodies.size(), true);
  return mesh;
}

}  // namespace

Point vector_area(const std::array<Point, 4>& corner) {
  Point a{}, b{};
  for (std::size_t k = 0; k < dim; ++k)
    a[k] = corner[2][k] - corner[0][k], b[k] = corner[3][k] - corner[1][k];
  return {0.5 * (a[1] * b[2] - a[2] * b[1]), 0.5 * (a[2] * b[0] - a[0] * b[2]),
          0.5 * (a[0] * b[1] - a[1] * b[0])};
}

SurfaceMesh make_surface_mesh(const Scene& scene, const InitialParticles& initial, int threads) {
  SurfaceMesh mesh;
  if (scene.dim != dim) return mesh;
  if (initial.mesh.order > 0) return surface_of(scene, initial);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    BodyMesh(scene, initial, static_cast<int>(b), mesh).add(threads);
  return mesh;
}

bool can_have_surface_mesh(const Scene& scene) {
  return std::ranges::none_of(scene.bodies, [&](const Body& body) {
    return !body.on_boundary && body.shapes.size() == 1 && body.without.empty() &&
           !body.shapes.front()->sites(dim, scene.spacing).empty() &&
           own_patches(body, scene.spacing).patches.empty();
  });
}

}  // namespace taut
