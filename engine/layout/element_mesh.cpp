#include "engine/layout/element_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <unordered_map>

#include <fmt/core.h>

#include "engine/core/index.hpp"
#include "engine/core/tensor.hpp"
#include "engine/error.hpp"
#include "engine/layout/reference_element.hpp"
#include "engine/scene/shapes/box.hpp"
#include "engine/scene/shapes/ellipse.hpp"
#include "engine/scene/shapes/round_shapes.hpp"
#include "engine/scene/shapes/turned.hpp"

namespace taut {
namespace {

/// Grid of elements, mapped from the unit square or cube.
struct Block {
  std::array<long, 3> cells{1, 1, 1};
  std::function<Point(const Point&)> place;
};
using Blocks = std::vector<Block>;

long number(double length, double size) { return std::max(1L, std::lround(length / size)); }

double squared_length(const Point& a) { return a[0] * a[0] + a[1] * a[1] + a[2] * a[2]; }

/// Unit vector for point u on the surface of a cube with half side `largest`: evenly spaced u are at equal angles.
Point direction(const Point& u, double largest) {
  Point way{};
  for (std::size_t k = 0; k < 3; ++k) way[k] = std::tan(0.25 * std::numbers::pi * u[k] / largest);
  const double length = std::sqrt(squared_length(way));
  for (double& component : way) component /= length;
  return way;
}

/// Maps the cube [−1, 1]^dim to a rounded cube at the centre of the unit ball.
Point core_point(const Point& u) {
  constexpr double half = 0.5, rounding = 0.21;
  const double largest = std::max({std::abs(u[0]), std::abs(u[1]), std::abs(u[2])});
  if (largest == 0) return {};
  const Point way = direction(u, largest);
  Point x{};
  for (std::size_t k = 0; k < 3; ++k)
    x[k] = (half - rounding * largest) * u[k] + rounding * largest * largest * way[k];
  return x;
}

/// Calls f(point) for each side of the cube [−1, 1]^dim; point(a, b), a and b from 0 to 1, is on the side.
template <class F>
void for_each_side(int dim, const F& f) {
  for (std::size_t axis = 0; axis < as_index(dim); ++axis)
    for (const double side : {-1.0, 1.0})
      f([=](double a, double b) {
        Point u{};
        u[axis] = side;
        u[(axis + 1) % as_index(dim)] = 2 * a - 1;
        if (dim == 3) u[(axis + 2) % 3] = 2 * b - 1;
        return u;
      });
}

/// Unit ball or disc: a core and blocks around it.
Blocks ball_blocks(int dim, double radius, double size) {
  // lengths to divide into elements, over the radius
  constexpr double of_core = 1.15, around_core = 0.45;
  const long n = number(of_core * radius, size), layers = number(around_core * radius, size);
  Blocks blocks{{{n, n, dim == 3 ? n : 1}, [=](const Point& u) {
                   return core_point({2 * u[0] - 1, 2 * u[1] - 1, dim == 3 ? 2 * u[2] - 1 : 0.0});
                 }}};
  for_each_side(dim, [&](const auto& side) {
    const auto place = [=](const Point& u) {
      const double outwards = dim == 3 ? u[2] : u[1];
      const Point on_cube = side(u[0], u[1]), out = direction(on_cube, 1);
      Point x = core_point(on_cube);
      for (std::size_t k = 0; k < 3; ++k) x[k] += outwards * (out[k] - x[k]);
      return x;
    };
    blocks.push_back({{n, dim == 3 ? n : layers, dim == 3 ? layers : 1}, place});
  });
  return blocks;
}

/// Ring, or shell with one block for each side of a cube.
Blocks ring_blocks(int dim, double inner, double outer, double size) {
  const double middle = 0.5 * (inner + outer);
  const long layers = number(outer - inner, size);
  if (dim == 2) {
    const long around = std::max(3L, number(2 * std::numbers::pi * middle, size));
    return {{{around, layers, 1}, [=](const Point& u) {
               const double angle = 2 * std::numbers::pi * (u[0] > 0.5 ? u[0] - 1 : u[0]);
               const double r = inner + u[1] * (outer - inner);
               return Point{r * std::cos(angle), r * std::sin(angle), 0};
             }}};
  }
  const long n = number(std::sqrt(4 * std::numbers::pi / 6) * middle, size);
  Blocks blocks;
  for_each_side(dim, [&](const auto& side) {
    blocks.push_back({{n, n, layers}, [=](const Point& u) {
                        Point x = direction(side(u[0], u[1]), 1);
                        for (double& component : x) component *= inner + u[2] * (outer - inner);
                        return x;
                      }});
  });
  return blocks;
}

void move(Blocks& blocks, const std::function<Point(const Point&)>& to) {
  for (Block& block : blocks) block.place = [to, from = block.place](const Point& u) { return to(from(u)); };
}

Blocks shifted(Blocks blocks, const Point& by, const Point& scale = {1, 1, 1}) {
  move(blocks, [=](const Point& x) {
    return Point{by[0] + scale[0] * x[0], by[1] + scale[1] * x[1], by[2] + scale[2] * x[2]};
  });
  return blocks;
}

Blocks cylinder_blocks(const Cylinder& pipe, double size) {
  Blocks blocks = pipe.inner > 0
                      ? ring_blocks(2, pipe.inner, pipe.radius, size)
                      : shifted(ball_blocks(2, pipe.radius, size), {}, {pipe.radius, pipe.radius, 1});
  Point along{}, u{};
  for (std::size_t k = 0; k < 3; ++k) along[k] = (pipe.to[k] - pipe.from[k]) / pipe.length();
  std::size_t across = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (std::abs(along[k]) < std::abs(along[across])) across = k;
  for (std::size_t k = 0; k < 3; ++k) u[k] = (k == across ? 1 : 0) - along[across] * along[k];
  const double length = std::sqrt(squared_length(u));
  for (double& component : u) component /= length;
  const Point v{along[1] * u[2] - along[2] * u[1], along[2] * u[0] - along[0] * u[2],
                along[0] * u[1] - along[1] * u[0]};
  for (Block& block : blocks) {
    block.cells[2] = number(pipe.length(), size);
    block.place = [=, from = block.place](const Point& w) {
      const Point x = from({w[0], w[1], 0});
      Point at{};
      for (std::size_t k = 0; k < 3; ++k)
        at[k] = std::lerp(pipe.from[k], pipe.to[k], w[2]) + x[0] * u[k] + x[1] * v[k];
      return at;
    };
  }
  return blocks;
}

/// Coordinates of box faces, ascending, m.
std::vector<double> lines_along(std::size_t axis, const std::vector<Box>& boxes, double dp) {
  std::vector<double> lines;
  for (const Box& box : boxes) lines.insert(lines.end(), {box.low[axis], box.high[axis]});
  std::ranges::sort(lines);
  const auto same = [&](double a, double b) { return b - a < 1e-6 * dp; };
  lines.erase(std::unique(lines.begin(), lines.end(), same), lines.end());
  return lines;
}

Blocks box_blocks(const Body& body, const std::vector<Box>& boxes, int dim, double size) {
  std::array<std::vector<double>, 3> lines{{{}, {}, {0, 0}}};
  for (std::size_t k = 0; k < as_index(dim); ++k) lines[k] = lines_along(k, boxes, size);
  Blocks blocks;
  for (std::size_t c = 0; c + 1 < lines[2].size(); ++c)
    for (std::size_t b = 0; b + 1 < lines[1].size(); ++b)
      for (std::size_t a = 0; a + 1 < lines[0].size(); ++a) {
        const Point low{lines[0][a], lines[1][b], lines[2][c]},
            high{lines[0][a + 1], lines[1][b + 1], lines[2][c + 1]};
        const auto covers = [&, middle = Bounds{low, high}.middle()](const Shape& shape) {
          return shape->holds(middle, dim, 0);
        };
        if (std::ranges::none_of(body.shapes, covers) || std::ranges::any_of(body.without, covers)) continue;
        Block block;
        for (std::size_t k = 0; k < as_index(dim); ++k) block.cells[k] = number(high[k] - low[k], size);
        block.place = [=](const Point& u) {
          return Point{std::lerp(low[0], high[0], u[0]), std::lerp(low[1], high[1], u[1]),
                       std::lerp(low[2], high[2], u[2])};
        };
        blocks.push_back(block);
      }
  return blocks;
}

/// Empty if the shape has no mesh.
Blocks blocks_of(const Shape& shape, int dim, double size) {
  if (const auto* turned = shape.as<Turned>()) {
    Blocks blocks = blocks_of(turned->shape, dim, size);
    move(blocks, [rotation = turned->rotation](const Point& x) { return rotated(rotation, x); });
    return blocks;
  }
  if (const auto* box = shape.as<Box>()) {
    Body body;
    body.shapes = {*box};
    return box_blocks(body, {*box}, dim, size);
  }
  if (const auto* disc = shape.as<Disc>())
    return shifted(ball_blocks(dim, disc->radius, size), disc->centre,
                   {disc->radius, disc->radius, disc->radius});
  if (const auto* oval = shape.as<Ellipse>()) {
    double radius = 1;
    for (std::size_t k = 0; k < as_index(dim); ++k) radius *= oval->semi_axes[k];
    return shifted(ball_blocks(dim, std::pow(radius, 1.0 / dim), size), oval->centre, oval->semi_axes);
  }
  if (const auto* ring = shape.as<Ring>(); ring && ring->inner > 0)
    return shifted(ring_blocks(dim, ring->inner, ring->outer, size), ring->centre);
  if (const auto* pipe = shape.as<Cylinder>(); pipe && dim == 3) return cylinder_blocks(*pipe, size);
  return {};
}

Blocks blocks_of(const Body& body, int dim, double size) {
  std::vector<Box> boxes;
  for (const std::vector<Shape>* shapes : {&body.shapes, &body.without})
    for (const Shape& shape : *shapes)
      if (const Box* box = shape.as<Box>()) boxes.push_back(*box);
  const bool one = body.shapes.size() == 1 && body.without.empty();
  Blocks blocks;
  if (boxes.size() == body.shapes.size() + body.without.size())
    blocks = box_blocks(body, boxes, dim, size);
  else if (one)
    blocks = blocks_of(body.shapes.front(), dim, size);
  if (blocks.empty())
    throw SceneError(
        "body." + body.name,
        fmt::format(
            "body '{}' has no finite-element mesh; shapes with a mesh: a single {}; or {} with unions and cut-outs; "
            "use a method with particles, such as oenog, for other shapes",
            body.name,
            dim == 2 ? "disc, ellipse, ring or rotated rectangle"
                     : "ball, ellipsoid, shell, cylinder or rotated box",
            dim == 2 ? "rectangles" : "boxes"));
  return blocks;
}

class NodeJoiner {
 public:
  NodeJoiner(std::vector<Point>& x, double dp) : x_(x), side_(0.1 * dp), near_(1e-5 * dp) {}

  int at(const Point& x, bool on_edge) {
    if (!on_edge) return add(x);
    const std::array<long, 3> cell = cell_of(x);
    for (long c = -1; c <= 1; ++c)
      for (long b = -1; b <= 1; ++b)
        for (long a = -1; a <= 1; ++a)
          if (const auto found = known_.find({cell[0] + a, cell[1] + b, cell[2] + c}); found != known_.end())
            for (const int k : found->second)
              if (distance_between(x_[as_index(k)], x, 3) < near_) return k;
    known_[cell].push_back(static_cast<int>(x_.size()));
    return add(x);
  }

 private:
  int add(const Point& x) {
    x_.push_back(x);
    return static_cast<int>(x_.size()) - 1;
  }
  std::array<long, 3> cell_of(const Point& x) const {
    std::array<long, 3> cell{};
    for (std::size_t k = 0; k < 3; ++k) cell[k] = static_cast<long>(std::floor(x[k] / side_));
    return cell;
  }

  std::vector<Point>& x_;
  double side_, near_;  // m
  std::map<std::array<long, 3>, std::vector<int>> known_;
};

void add_elements(ElementMesh& mesh, const Block& block, NodeJoiner& joiner) {
  const int n = mesh.order + 1;
  std::array<long, 3> nodes{1, 1, 1};
  for (std::size_t k = 0; k < as_index(mesh.dim); ++k) nodes[k] = block.cells[k] * mesh.order + 1;
  std::vector<int> of_block;
  for (long c = 0; c < nodes[2]; ++c)
    for (long b = 0; b < nodes[1]; ++b)
      for (long a = 0; a < nodes[0]; ++a) {
        const std::array<long, 3> at{a, b, c};
        Point u{};
        bool on_edge = false;
        for (std::size_t k = 0; k < as_index(mesh.dim); ++k) {
          u[k] = static_cast<double>(at[k]) / static_cast<double>(nodes[k] - 1);
          on_edge = on_edge || at[k] == 0 || at[k] == nodes[k] - 1;
        }
        of_block.push_back(joiner.at(block.place(u), on_edge));
      }
  for (long c = 0; c < (mesh.dim == 3 ? block.cells[2] : 1); ++c)
    for (long b = 0; b < block.cells[1]; ++b)
      for (long a = 0; a < block.cells[0]; ++a)
        for (int k = 0; k < mesh.nodes_of_each(); ++k) {
          const long i = a * mesh.order + index_along(0, k, n), j = b * mesh.order + index_along(1, k, n),
                     l = mesh.dim == 3 ? c * mesh.order + index_along(2, k, n) : 0;
          mesh.node.push_back(of_block[static_cast<std::size_t>((l * nodes[1] + j) * nodes[0] + i)]);
        }
}

/// ∂X/∂ξ at node or Gauss point k.
template <int n, int Dim>
Mat<double, Dim> jacobian(const std::array<Point, power_of(n, Dim)>& X, int k,
                          const typename LineElement<n>::Table& value,
                          const typename LineElement<n>::Table& slope) {
  Mat<double, Dim> G{};
  for (int a = 0; a < power_of(n, Dim); ++a)
    for (int axis = 0; axis < Dim; ++axis) {
      double product = 1;
      for (int b = 0; b < Dim; ++b)
        product *=
            (b == axis ? slope : value)[as_index(index_along(b, k, n))][as_index(index_along(b, a, n))];
      for (int c = 0; c < Dim; ++c) G(c, axis) += X[as_index(a)][as_index(c)] * product;
    }
  return G;
}

/// Adds the middles and the nodal volumes (Gauss–Lobatto weights, scaled to the element volume).
template <int n, int Dim>
void add_volumes(ElementMesh& mesh) {
  using Line = LineElement<n>;
  constexpr int N = power_of(n, Dim);
  constexpr auto unit = Line::table([](std::size_t a, std::size_t b) { return a == b ? 1.0 : 0.0; });
  for (std::size_t first = 0; first < mesh.node.size(); first += N) {
    std::array<Point, N> X;
    std::array<double, N> share;
    double sum = 0, volume = 0;
    for (int k = 0; k < N; ++k) X[as_index(k)] = mesh.x[as_index(mesh.node[first + as_index(k)])];
    for (int k = 0; k < N; ++k) {
      share[as_index(k)] = product_weight<n, Dim>(Line::node_weight, k) *
                           std::abs(determinant(jacobian<n, Dim>(X, k, unit, Line::dN_at_nodes)));
      sum += share[as_index(k)];
      volume += product_weight<n, Dim>(Line::gauss_weight, k) *
                std::abs(determinant(jacobian<n, Dim>(X, k, Line::N, Line::dN)));
    }
    for (const double own : share) mesh.volume.push_back(own / sum * volume);
    Point middle{};
    constexpr int corners = Dim == 2 ? 4 : 8;
    for (int k = 0; k < N; ++k) {
      bool corner = true;
      for (int axis = 0; axis < Dim; ++axis) corner = corner && index_along(axis, k, n) % (n - 1) == 0;
      for (std::size_t c = 0; corner && c < 3; ++c) middle[c] += X[as_index(k)][c] / corners;
    }
    mesh.middle.push_back(middle);
  }
}

template <int n, int Dim>
bool is_inverted(const ElementMesh& mesh, int element) {
  constexpr int N = power_of(n, Dim);
  std::array<Point, N> X;
  for (int k = 0; k < N; ++k) X[as_index(k)] = mesh.x[as_index(mesh.node[as_index(N * element + k)])];
  return determinant(jacobian<n, Dim>(X, 0, LineElement<n>::N, LineElement<n>::dN)) < 0;
}

template <int n, int Dim>
std::vector<MeshFacet> boundary(const ElementMesh& mesh) {
  constexpr int N = power_of(n, Dim), stride[3] = {1, n, n * n};
  std::map<std::array<int, 4>, std::pair<int, MeshFacet>> found;  // [sorted nodes] number of elements
  for (int element = 0; element < mesh.size(); ++element) {
    const bool inverted = is_inverted<n, Dim>(mesh, element);
    for (int side = 0; side < 2 * Dim; ++side) {
      const int axis = side / 2, u = (axis + 1) % Dim, v = Dim == 2 ? u : (axis + 2) % Dim;
      for (int j = 0; j < (Dim == 2 ? 1 : n - 1); ++j)
        for (int i = 0; i < n - 1; ++i) {
          const int at = (side % 2) * (n - 1) * stride[axis] + i * stride[u] + (Dim == 2 ? 0 : j * stride[v]);
          std::array<int, 4> local{at, at + stride[u], at, at};
          if (Dim == 3) local = {at, at + stride[u], at + stride[u] + stride[v], at + stride[v]};
          // (axis, u) is right-handed in 2D only for axis 0
          const bool turned = (side % 2 == 0) != (Dim == 2 && axis == 1);
          if (turned) std::swap(local[Dim == 2 ? 0 : 3], local[1]);
          if (Dim == 2) local[2] = local[3] = local[0];
          MeshFacet facet{.element = element, .side = side, .inverted = inverted};
          for (std::size_t k = 0; k < 4; ++k) facet.node[k] = mesh.node[as_index(N * element + local[k])];
          std::array<int, 4> key = facet.node;
          if (Dim == 2) key[2] = key[3] = std::min(key[0], key[1]);
          std::ranges::sort(key);
          const auto [place, is_new] = found.try_emplace(key, 1, facet);
          if (!is_new) ++place->second.first;
        }
    }
  }
  std::vector<MeshFacet> facets;
  for (const auto& [key, of] : found)
    if (of.first == 1) facets.push_back(of.second);
  std::ranges::stable_sort(facets, {}, &MeshFacet::element);
  return facets;
}

}  // namespace

ElementMesh mesh_of_body(const Body& body, int dim, int order, double dp) {
  const Body laid = unplaced_body(body, dim);
  ElementMesh mesh;
  mesh.dim = dim, mesh.order = order;
  NodeJoiner joiner(mesh.x, dp);
  for (const Block& block : blocks_of(laid, dim, order * dp)) add_elements(mesh, block, joiner);
  for (Point& x : mesh.x) {
    if (dim == 2) x[2] = 0;
    x = placed(body, x, dim);
  }
  with_order(order, [&](auto n) { dim == 2 ? add_volumes<n, 2>(mesh) : add_volumes<n, 3>(mesh); });
  return mesh;
}

std::vector<MeshFacet> boundary_of(const ElementMesh& mesh) {
  return with_order(mesh.order,
                    [&](auto n) { return mesh.dim == 2 ? boundary<n, 2>(mesh) : boundary<n, 3>(mesh); });
}

}  // namespace taut
