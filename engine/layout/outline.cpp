#include "engine/layout/outline.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/index.hpp"
#include "engine/scene/shapes/box.hpp"
#include "engine/scene/shapes/combined.hpp"
#include "engine/scene/shapes/round_shapes.hpp"

namespace taut {
namespace {

bool any_holds(const std::vector<Shape>& shapes, const Point& x, double tolerance) {
  return std::ranges::any_of(shapes, [&](const Shape& shape) { return shape->holds(x, 2, tolerance); });
}

/// The first of coincident faces is kept.
bool covered(const std::vector<Shape>& shapes, std::size_t own, const Point& x, const Point& middle,
             double dp) {
  const double thin = 1e-6 * dp;
  for (std::size_t k = 0; k < shapes.size(); ++k)
    if (k != own && (shapes[k]->holds(x, 2, -thin) || (k < own && shapes[k]->holds(middle, 2, thin))))
      return true;
  return false;
}

/// Point at `depth` behind the middle of a face, m.
Point behind(const Point& a, const Point& b, double depth) {
  const double off = depth / distance_between(a, b, 2);
  return {0.5 * (a[0] + b[0]) - off * (b[1] - a[1]), 0.5 * (a[1] + b[1]) + off * (b[0] - a[0]), 0};
}

bool is_face(const Body& body, bool cut, std::size_t own, const Point& a, const Point& b, double dp) {
  const double off = 1e-3 * dp;
  const Point middle = behind(a, b, 0), inside = behind(a, b, off);
  if (cut) return any_holds(body.shapes, inside, 0) && !covered(body.without, own, inside, middle, dp);
  return !any_holds(body.without, inside, 0) && !covered(body.shapes, own, behind(a, b, -off), middle, dp);
}

/// Whether the body is one particle thick behind a face.
bool is_thin(const Body& body, const Point& a, const Point& b, double dp) {
  constexpr double thickness = 1.25;  // in spacings
  const Point x = behind(a, b, thickness * dp);
  return !body.on_boundary && (!any_holds(body.shapes, x, 0) || any_holds(body.without, x, 0));
}

/// Whether faces, given by their middles, are more than those of a tip.
bool form_part(const std::vector<Point>& faces, double dp) {
  constexpr long most = 12;     // both sides of a tip of 11°, or of a row of 5 particles
  constexpr double around = 7;  // in spacings
  return std::ranges::any_of(faces, [&](const Point& x) {
    return std::ranges::count_if(
               faces, [&](const Point& other) { return distance_between(x, other, 2) < around * dp; }) > most;
  });
}

bool needs_clipping(const Body& body) {
  const auto is_other = [](const Shape& shape) {
    return !shape.as<Box>() && !shape.as<Disc>() && !shape.as<Ring>();
  };
  return std::ranges::any_of(body.shapes, is_other) || std::ranges::any_of(body.without, is_other);
}

std::vector<Chain> whole_outline(const Body& body, int dim, double dp) {
  const auto one = [](const std::vector<Shape>& shapes) {
    return shapes.size() == 1 ? shapes.front() : Shape(Combined{Combination::together, shapes});
  };
  Shape whole = one(body.shapes);
  if (!body.without.empty()) whole = Combined{Combination::difference, {whole, one(body.without)}};
  return whole->outline(dim, dp);
}

class OutlineMaker {
 public:
  OutlineMaker(const Scene& scene, const InitialParticles& initial) : scene_(scene), initial_(initial) {}

  Outline make() {
    for (std::size_t b = 0; b < scene_.bodies.size(); ++b) add(static_cast<int>(b));
    return std::move(out_);
  }

 private:
  void add(int b) {
    const int first = out_.size();
    thin_.clear();
    add_faces(b);
    out_.closed.push_back(out_.size() > first && !form_part(thin_, scene_.spacing));
  }

  void add_faces(int b) {
    const Body body = unplaced_body(scene_.bodies[as_index(b)], scene_.dim);
    const NodeWeights particles(initial_, b, scene_.spacing);
    if (needs_clipping(body)) {
      const auto all_are = [](const Point&, const Point&) { return true; };
      for (const Chain& chain : whole_outline(body, scene_.dim, scene_.spacing))
        add(b, body, chain, particles, all_are);
      return;
    }
    const auto add_all = [&](const std::vector<Shape>& shapes, bool cut) {
      for (std::size_t own = 0; own < shapes.size(); ++own) {
        for (Chain& chain : shapes[own]->outline(scene_.dim, scene_.spacing)) {
          if (cut) std::ranges::reverse(chain);
          add(b, body, chain, particles, [&](const Point& from, const Point& to) {
            return is_face(body, cut, own, from, to, scene_.spacing);
          });
        }
      }
    };
    add_all(body.shapes, false);
    add_all(body.without, true);
  }

  template <class IsFace>
  void add(int b, const Body& body, const Chain& chain, const NodeWeights& particles, const IsFace& is_face) {
    const std::size_t n = chain.size();
    std::vector<int> node(n, Outline::none);
    for (std::size_t k = 0; k < n; ++k) {
      const Point &from = chain[k], &to = chain[(k + 1) % n];
      if (!is_face(from, to)) continue;
      const int first = node_at(node[k], b, from, particles),
                second = node_at(node[(k + 1) % n], b, to, particles);
      const bool omitted = first == Outline::none || second == Outline::none;
      if (omitted || is_thin(body, from, to, scene_.spacing)) thin_.push_back(behind(from, to, 0));
      if (omitted) continue;
      const std::array<bool, 3>& mirror = scene_.bodies[as_index(b)].mirror;
      const double sense = (mirror[0] != mirror[1]) ? -1 : 1;
      out_.beside[as_index(first)][1] = out_.beside[as_index(second)][0] =
          static_cast<int>(out_.segments.size());
      out_.segments.push_back({{first, second}, distance_between(from, to, 2), sense});
    }
  }

  /// Chains share the node where they meet.
  int node_at(int& known, int b, const Point& laid, const NodeWeights& particles) {
    if (known != Outline::none) return known;
    const Point x = placed(scene_.bodies[as_index(b)], laid, scene_.dim);
    std::erase_if(open_, [&](int n) {
      return out_.body[as_index(n)] != b || std::ranges::count(out_.beside[as_index(n)], Outline::none) == 0;
    });
    for (const int n : open_)
      if (distance_between(out_.x[as_index(n)], x, 2) < 1e-6 * scene_.spacing) return known = n;
    const std::vector<PointWeight> shares = particles.shares_of(x);
    if (shares.empty()) return Outline::none;
    known = out_.size();
    open_.push_back(known);
    out_.add(x, shares);
    out_.body.push_back(b);
    out_.beside.push_back({Outline::none, Outline::none});
    return known;
  }

  const Scene& scene_;
  const InitialParticles& initial_;
  Outline out_;
  std::vector<int> open_;
  std::vector<Point> thin_;  // middles of faces of the body where it is one particle thick, m
};

/// Segments on faces of finite elements.
Outline outline_of(const Scene& scene, const InitialParticles& initial) {
  Outline out;
  out.closed.assign(scene.bodies.size(), true);
  std::vector<int> known(initial.x.size(), Outline::none);
  const auto node_of = [&](int particle) {
    int& node = known[as_index(particle)];
    if (node != Outline::none) return node;
    node = out.size();
    out.add(initial.x[as_index(particle)], {{particle, 1}});
    out.body.push_back(initial.body[as_index(particle)]);
    out.beside.push_back({Outline::none, Outline::none});
    return node;
  };
  for (const MeshFacet& facet : boundary_of(initial.mesh)) {
    const int first = node_of(facet.node[0]), second = node_of(facet.node[1]);
    out.beside[as_index(first)][1] = out.beside[as_index(second)][0] = static_cast<int>(out.segments.size());
    out.segments.push_back({{first, second},
                            distance_between(out.x[as_index(first)], out.x[as_index(second)], 2),
                            facet.inverted ? -1.0 : 1.0});
  }
  return out;
}

}  // namespace

Outline make_outline(const Scene& scene, const InitialParticles& initial) {
  if (scene.dim != 2) return {};
  if (initial.mesh.order > 0) return outline_of(scene, initial);
  return OutlineMaker(scene, initial).make();
}

}  // namespace taut
