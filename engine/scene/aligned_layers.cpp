#include "engine/scene/aligned_layers.hpp"

#include <algorithm>
#include <map>
#include <numbers>
#include <utility>

namespace taut {
namespace {

constexpr double pi = std::numbers::pi;

class Nodes {
 public:
  using Index = std::array<long, 3>;

  explicit Nodes(FacePatches& out) : out_(out) {}

  template <class Place>
  int at(const Index& index, const Place& place) {
    const auto [found, is_new] = number_.try_emplace(index, static_cast<int>(out_.node.size()));
    if (is_new) out_.node.push_back(place(index));
    return found->second;
  }

 private:
  FacePatches& out_;
  std::map<Index, int> number_;
};

constexpr std::array<std::array<long, 2>, 4> around = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

long layers_of(double inner, double outer, double dp) {
  return std::max(1L, std::lround((outer - inner) / dp));
}

/// Surface of a cube of side 2 n with n × n cells per face. Seen from the centre, grid lines are at equal angles.
class RoundCube {
 public:
  using Place = std::array<long, 3>;  // the greatest |component| is n

  explicit RoundCube(long n) : n_(n) {}

  long n() const { return n_; }
  template <class F>
  void for_each_cell(const F& f) const {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const long side : {-1L, 1L})
        for (long p = 0; p < n_; ++p)
          for (long q = 0; q < n_; ++q) f(p, q, axis, side);
  }
  Place on_face(std::size_t axis, long side, long p, long q) const {
    Place place{};
    place[axis] = side * n_;
    place[(axis + 1) % 3] = p - n_;
    place[(axis + 2) % 3] = q - n_;
    return place;
  }
  Place middle(std::size_t axis, long side, long p, long q) const {
    return on_face(axis, side, 2 * p + 1, 2 * q + 1);
  }
  Place corner(std::size_t axis, long side, long p, long q) const {
    return on_face(axis, side, 2 * p, 2 * q);
  }

  /// Adds squares in order of size: symmetric places give the same bits.
  Point direction(const Place& place) const {
    Point way{};
    std::array<double, 3> square{};
    for (std::size_t k = 0; k < 3; ++k) way[k] = tangent(place[k]), square[k] = way[k] * way[k];
    std::ranges::sort(square);
    const double length = std::sqrt((square[0] + square[1]) + square[2]);
    for (double& component : way) component /= length;
    return way;
  }
  /// Bit-identical for symmetric cells.
  double solid_angle(long p, long q) const {
    p = std::max(p, n_ - 1 - p), q = std::max(q, n_ - 1 - q);
    if (p < q) std::swap(p, q);
    // solid angle of the rectangle from the centre of a face to corner (a, b)
    const auto below = [&](long a, long b) {
      const double x = tangent(2 * a - n_), y = tangent(2 * b - n_);
      return std::atan2(x * y, std::sqrt(1 + x * x + y * y));
    };
    return (below(p + 1, q + 1) - below(p, q + 1)) - (below(p + 1, q) - below(p, q));
  }

 private:
  double tangent(long place) const {
    if (std::abs(place) == n_) return place < 0 ? -1 : 1;
    return std::tan(0.25 * pi * static_cast<double>(place) / static_cast<double>(n_));
  }

  long n_;
};

RoundCube cube_of(const Ring& shell, double dp) {
  const double side = std::sqrt(4 * pi / 6) * 0.5 * (shell.inner + shell.outer);
  return RoundCube(std::max(1L, std::lround(side / dp)));
}

Point from_centre(const Point& centre, double r, const Point& way) {
  return {centre[0] + r * way[0], centre[1] + r * way[1], centre[2] + r * way[2]};
}

struct Slices {
  Ring ring;
  long layers, around, number;
  double pitch;             // m
  Point from, along, u, v;  // `along`, `u`, `v`: unit vectors, u × v = along

  Slices(const Cylinder& pipe, double dp)
      : ring{Point{}, pipe.inner, pipe.radius, RoundLayout::aligned},
        layers(layers_of(pipe.inner, pipe.radius, dp)),
        around(static_cast<long>(ring.sites(2, dp).size()) / layers),
        number(std::max(1L, std::lround(pipe.length() / dp))),
        pitch(pipe.length() / static_cast<double>(number)),
        from(pipe.from),
        along{},
        u{},
        v{} {
    for (std::size_t k = 0; k < 3; ++k) along[k] = (pipe.to[k] - pipe.from[k]) / pipe.length();
    std::size_t across = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (std::abs(along[k]) < std::abs(along[across])) across = k;
    for (std::size_t k = 0; k < 3; ++k) u[k] = (k == across ? 1 : 0) - along[across] * along[k];
    const double length = distance_between(u, {}, 3);
    for (double& component : u) component /= length;
    v = {along[1] * u[2] - along[2] * u[1], along[2] * u[0] - along[0] * u[2],
         along[0] * u[1] - along[1] * u[0]};
  }

  /// `pitches`: height above `from`.
  Point place(const Point& x, double pitches) const {
    Point at{};
    for (std::size_t k = 0; k < 3; ++k)
      at[k] = from[k] + pitches * pitch * along[k] + x[0] * u[k] + x[1] * v[k];
    return at;
  }
  Point corner(long layer, long turn) const {
    const double r =
        ring.inner + static_cast<double>(layer) * (ring.outer - ring.inner) / static_cast<double>(layers);
    const double angle = pi * static_cast<double>(2 * turn - 1) / static_cast<double>(around);
    return {r * std::cos(angle), r * std::sin(angle), 0};
  }
  int site(long layer, long turn, long slice) const {
    return static_cast<int>((slice * layers + layer) * around + turn);
  }
};

}  // namespace

std::vector<InitialSite> aligned_sites(const Ring& shell, double dp) {
  const RoundCube cube = cube_of(shell, dp);
  const long layers = layers_of(shell.inner, shell.outer, dp);
  const double thickness = (shell.outer - shell.inner) / static_cast<double>(layers);
  std::vector<InitialSite> sites;
  sites.reserve(static_cast<std::size_t>(6 * cube.n() * cube.n() * layers));
  for (long layer = 0; layer < layers; ++layer) {
    const double r = shell.inner + (static_cast<double>(layer) + 0.5) * thickness;
    const double per_angle = thickness * (r * r + thickness * thickness / 12);  // ∫ r² dr
    cube.for_each_cell([&](long p, long q, std::size_t axis, long side) {
      sites.push_back({.x = from_centre(shell.centre, r, cube.direction(cube.middle(axis, side, p, q))),
                       .V0 = cube.solid_angle(p, q) * per_angle});
    });
  }
  return sites;
}

FacePatches aligned_patches(const Ring& shell, double dp) {
  const RoundCube cube = cube_of(shell, dp);
  const long layers = layers_of(shell.inner, shell.outer, dp), of_layer = 6 * cube.n() * cube.n();
  FacePatches faces;
  for (const bool outside : {false, true}) {
    Nodes nodes(faces);
    const auto place = [&](const RoundCube::Place& corner) {
      return from_centre(shell.centre, outside ? shell.outer : shell.inner, cube.direction(corner));
    };
    int site = static_cast<int>(outside ? (layers - 1) * of_layer : 0);
    cube.for_each_cell([&](long p, long q, std::size_t axis, long side) {
      FacePatches::Patch patch{.site = site++};
      for (std::size_t k = 0; k < around.size(); ++k)
        patch.node[k] = nodes.at(cube.corner(axis, side, p + around[k][0], q + around[k][1]), place);
      if ((side > 0) != outside) std::swap(patch.node[1], patch.node[3]);
      faces.patches.push_back(patch);
    });
  }
  return faces;
}

std::vector<InitialSite> aligned_sites(const Cylinder& pipe, double dp) {
  const Slices slices(pipe, dp);
  const std::vector<InitialSite> of_slice = slices.ring.sites(2, dp);
  std::vector<InitialSite> sites;
  for (long slice = 0; slice < slices.number; ++slice)
    for (const InitialSite& site : of_slice)
      sites.push_back(
          {.x = slices.place(site.x, static_cast<double>(slice) + 0.5), .V0 = site.V0 * slices.pitch});
  return sites;
}

FacePatches aligned_patches(const Cylinder& pipe, double dp) {
  const Slices slices(pipe, dp);
  FacePatches faces;
  Nodes nodes(faces);
  const auto place = [&](const Nodes::Index& n) { return slices.place(slices.corner(n[0], n[1]), n[2]); };
  const auto add = [&](int site, std::array<Nodes::Index, 4> corners, bool turned) {
    FacePatches::Patch patch{.site = site};
    for (std::size_t k = 0; k < corners.size(); ++k) {
      corners[k][1] %= slices.around;
      patch.node[k] = nodes.at(corners[k], place);
    }
    if (turned) std::swap(patch.node[1], patch.node[3]);
    faces.patches.push_back(patch);
  };
  for (long turn = 0; turn < slices.around; ++turn) {
    for (const long layer : {0L, slices.layers})
      for (long slice = 0; slice < slices.number; ++slice)
        add(slices.site(layer == 0 ? 0 : layer - 1, turn, slice),
            {{{layer, turn, slice},
              {layer, turn + 1, slice},
              {layer, turn + 1, slice + 1},
              {layer, turn, slice + 1}}},
            layer == 0);
    for (const long slice : {0L, slices.number})
      for (long layer = 0; layer < slices.layers; ++layer)
        add(slices.site(layer, turn, slice == 0 ? 0 : slice - 1),
            {{{layer, turn, slice},
              {layer + 1, turn, slice},
              {layer + 1, turn + 1, slice},
              {layer, turn + 1, slice}}},
            slice == 0);
  }
  return faces;
}

}  // namespace taut
