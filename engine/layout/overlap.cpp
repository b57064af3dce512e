#include "engine/layout/overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include <fmt/core.h>
#include <fmt/format.h>

#include "engine/core/tensor.hpp"
#include "engine/error.hpp"

namespace taut {
namespace {

constexpr double least_distance = 0.5;  // in spacings

class ParticleGrid {
 public:
  ParticleGrid(double side, int dim) : side_(side), depth_(dim == 3 ? 1 : 0) {}

  void add(const Point& x, int i) {
    const auto [a, b, c] = cell(x);
    at_.emplace(key(a, b, c), i);
  }
  template <class Visit>
  void for_each_near(const Point& x, const Visit& visit) const {
    const auto [a, b, c] = cell(x);
    for (long dz = -depth_; dz <= depth_; ++dz)
      for (long dy = -1; dy <= 1; ++dy)
        for (long dx = -1; dx <= 1; ++dx) {
          const auto [begin, end] = at_.equal_range(key(a + dx, b + dy, c + dz));
          for (auto it = begin; it != end; ++it) visit(it->second);
        }
  }

 private:
  std::array<long, 3> cell(const Point& x) const {
    std::array<long, 3> c{};
    for (std::size_t k = 0; k < c.size(); ++k) c[k] = static_cast<long>(std::floor(x[k] / side_));
    return c;
  }
  static std::size_t key(long i, long j, long k) {
    return static_cast<std::size_t>(i) * 73856093u ^ static_cast<std::size_t>(j) * 19349663u ^
           static_cast<std::size_t>(k) * 83492791u;
  }

  double side_;  // m
  long depth_;
  std::unordered_multimap<std::size_t, int> at_;
};

std::string place_text(const Point& x, int dim) {
  return dim == 2 ? fmt::format("({:.6g}, {:.6g}) m", x[0], x[1])
                  : fmt::format("({:.6g}, {:.6g}, {:.6g}) m", x[0], x[1], x[2]);
}

[[noreturn]] void refuse(const Scene& scene, int a, int b, const Point& at, const std::string& why) {
  const std::string &one = scene.bodies[static_cast<std::size_t>(a)].name,
                    &other = scene.bodies[static_cast<std::size_t>(b)].name;
  throw SceneError("body." + one, fmt::format("bodies '{}' and '{}' overlap at {}: {}; move one of them", one,
                                              other, place_text(at, scene.dim), why));
}

std::vector<Bounds> boxes_at_start(const InitialParticles& layout) {
  std::vector<Bounds> boxes(layout.first.size() - 1);
  for (std::size_t b = 0; b < boxes.size(); ++b)
    for (int i = layout.first[b]; i < layout.first[b + 1]; ++i)
      boxes[b] = i == layout.first[b] ? Bounds{layout.at_start(i), layout.at_start(i)}
                                      : joined(boxes[b], {layout.at_start(i), layout.at_start(i)});
  return boxes;
}

bool lies_in(const Point& x, const Bounds& box, double beside) {
  for (std::size_t k = 0; k < x.size(); ++k)
    if (x[k] < box.low[k] - beside || x[k] > box.high[k] + beside) return false;
  return true;
}

void refuse_close_particles(const InitialParticles& layout, const Scene& scene) {
  const double reach = least_distance * scene.spacing;
  const std::vector<Bounds> boxes = boxes_at_start(layout);
  const auto is_beside_another = [&](int i) {
    for (std::size_t b = 0; b < boxes.size(); ++b)
      if (std::cmp_not_equal(b, layout.body[i]) && lies_in(layout.at_start(i), boxes[b], reach)) return true;
    return false;
  };
  ParticleGrid grid(reach, scene.dim);
  for (int i = 0; i < layout.size(); ++i) {
    if (!is_beside_another(i)) continue;
    const Point& x = layout.at_start(i);
    grid.for_each_near(x, [&](int j) {
      if (layout.body[i] == layout.body[j]) return;
      const Point& y = layout.at_start(j);
      const double r = distance_between(x, y, 3);
      if (r >= reach) return;
      refuse(scene, layout.body[i], layout.body[j], Bounds{x, y}.middle(),
             fmt::format("two of their particles are {:g} spacings apart; the distance must be at least {:g}",
                         r / scene.spacing, least_distance));
    });
    grid.add(x, i);
  }
}

/// Maps positions in a displaced body to reference positions, linearly about the nearest particle.
class LaidPlaces {
 public:
  LaidPlaces(const InitialParticles& layout, const Scene& scene, std::size_t b)
      : layout_(layout), body_(scene.bodies[b]), spacing_(scene.spacing), grid_(reach * spacing_, scene.dim) {
    for (int i = layout.first[b]; i < layout.first[b + 1]; ++i) grid_.add(layout.at_start(i), i);
  }

  std::optional<Point> operator()(const Point& y) const {
    int nearest = -1;
    double least = reach * spacing_;
    grid_.for_each_near(y, [&](int i) {
      const double r = distance_between(y, layout_.at_start(i), 3);
      if (r < least || (r == least && i < nearest)) least = r, nearest = i;
    });
    if (nearest < 0) return {};
    const Mat<double, 3> F = gradient(layout_.x[nearest]), H = cofactor(F);
    const double J = determinant(F);
    if (J == 0) return {};
    Point X = layout_.x[nearest];
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) X[a] += H(b, a) / J * (y[b] - layout_.at_start(nearest)[b]);
    return X;
  }

 private:
  static constexpr double reach = 1.5;  // in spacings

  Mat<double, 3> gradient(const Point& X) const {
    const double way = 1e-3 * spacing_;
    Mat<double, 3> F;
    for (int b = 0; b < 3; ++b) {
      Point on = X, back = X;
      on[b] += way, back[b] -= way;
      const Point high = displaced(body_, on), low = displaced(body_, back);
      for (int a = 0; a < 3; ++a) F(a, b) = (high[a] - low[a]) / (2 * way);
    }
    return F;
  }

  const InitialParticles& layout_;
  const Body& body_;
  double spacing_;  // m
  ParticleGrid grid_;
};

void refuse_particles_inside(const InitialParticles& layout, const Scene& scene, std::size_t a, std::size_t b,
                             const Bounds& box) {
  std::optional<LaidPlaces> laid;
  if (!is_undisplaced(scene.bodies[b])) laid.emplace(layout, scene, b);
  for (int i = layout.first[a]; i < layout.first[a + 1]; ++i) {
    const Point& x = layout.at_start(i);
    if (!lies_in(x, box, scene.spacing)) continue;
    const std::optional<Point> in_layout = laid ? (*laid)(x) : x;
    if (in_layout && holds(scene.bodies[b], *in_layout, scene.dim, -greatest_depth * scene.spacing))
      refuse(scene, static_cast<int>(std::max(a, b)), static_cast<int>(std::min(a, b)), x,
             fmt::format("a particle of '{}' is inside '{}'", scene.bodies[a].name, scene.bodies[b].name));
  }
}

}  // namespace

void refuse_overlap(const InitialParticles& layout, const Scene& scene) {
  if (scene.bodies.size() < 2) return;
  if (scene.element_order == 0) refuse_close_particles(layout, scene);
  const std::vector<Bounds> boxes = boxes_at_start(layout);
  const auto meet = [&](std::size_t a, std::size_t b) {
    for (std::size_t k = 0; k < 3; ++k)
      if (boxes[a].low[k] > boxes[b].high[k] + scene.spacing ||
          boxes[b].low[k] > boxes[a].high[k] + scene.spacing)
        return false;
    return true;
  };
  for (std::size_t a = 0; a < boxes.size(); ++a)
    for (std::size_t b = 0; b < boxes.size(); ++b)
      if (a != b && meet(a, b)) refuse_particles_inside(layout, scene, a, b, boxes[b]);
}

}  // namespace taut
