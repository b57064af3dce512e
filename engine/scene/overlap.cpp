#include "engine/scene/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "engine/error.hpp"
#include "engine/scene/shape_members.hpp"

namespace taut {
namespace {

constexpr double least_distance = 0.5;   // of particles of two bodies, spacings
constexpr double greatest_depth = 0.25;  // of a particle in another body

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

/// Around the particles of each body, which are at `x`.
std::vector<Bounds> boxes_of(const InitialParticles& layout, const std::vector<Point>& x) {
  std::vector<Bounds> boxes(layout.first.size() - 1);
  for (std::size_t b = 0; b < boxes.size(); ++b)
    for (int i = layout.first[b]; i < layout.first[b + 1]; ++i)
      boxes[b] = i == layout.first[b] ? Bounds{x[i], x[i]} : joined(boxes[b], {x[i], x[i]});
  return boxes;
}

bool lies_in(const Point& x, const Bounds& box, double beside) {
  for (std::size_t k = 0; k < x.size(); ++k)
    if (x[k] < box.low[k] - beside || x[k] > box.high[k] + beside) return false;
  return true;
}

void refuse_close_particles(const InitialParticles& layout, const Scene& scene) {
  const double reach = least_distance * scene.spacing;
  const auto cell = [&](double x) { return static_cast<long>(std::floor(x / reach)); };
  const auto key = [](long i, long j, long k) {
    return static_cast<std::size_t>(i) * 73856093u ^ static_cast<std::size_t>(j) * 19349663u ^
           static_cast<std::size_t>(k) * 83492791u;
  };
  const std::vector<Bounds> boxes = boxes_of(layout, layout.start.empty() ? layout.x : layout.start);
  const auto is_beside_another = [&](int i) {
    for (std::size_t b = 0; b < boxes.size(); ++b)
      if (std::cmp_not_equal(b, layout.body[i]) && lies_in(layout.at_start(i), boxes[b], reach)) return true;
    return false;
  };
  std::unordered_multimap<std::size_t, int> grid;
  for (int i = 0; i < layout.size(); ++i) {
    if (!is_beside_another(i)) continue;
    const Point& x = layout.at_start(i);
    const long c[3] = {cell(x[0]), cell(x[1]), cell(x[2])};
    const long depth = scene.dim == 3 ? 1 : 0;
    for (long dz = -depth; dz <= depth; ++dz) {
      for (long dy = -1; dy <= 1; ++dy) {
        for (long dx = -1; dx <= 1; ++dx) {
          const auto [begin, end] = grid.equal_range(key(c[0] + dx, c[1] + dy, c[2] + dz));
          for (auto it = begin; it != end; ++it) {
            const int j = it->second;
            if (layout.body[i] == layout.body[j]) continue;
            const Point& y = layout.at_start(j);
            const double r = distance_between(x, y, 3);
            if (r >= reach) continue;
            refuse(scene, layout.body[i], layout.body[j], Bounds{x, y}.middle(),
                   fmt::format("two of their particles are {:g} spacings apart, at least {:g} are needed",
                               r / scene.spacing, least_distance));
          }
        }
      }
    }
    grid.emplace(key(c[0], c[1], c[2]), i);
  }
}

bool starts_as_laid(const Body& body) {
  return std::ranges::none_of(body.displacement, [](const Expression& along) { return along != nullptr; });
}

/// The particles of `a` in the body `b`.
void refuse_particles_inside(const InitialParticles& layout, const Scene& scene, std::size_t a, std::size_t b,
                             const Bounds& box) {
  for (int i = layout.first[a]; i < layout.first[a + 1]; ++i) {
    const Point& x = layout.x[i];
    if (lies_in(x, box, scene.spacing) &&
        holds(scene.bodies[b], x, scene.dim, -greatest_depth * scene.spacing))
      refuse(scene, static_cast<int>(std::max(a, b)), static_cast<int>(std::min(a, b)), x,
             "there a particle of '" + scene.bodies[a].name + "' lies in '" + scene.bodies[b].name + "'");
  }
}

}  // namespace

void refuse_overlap(const InitialParticles& layout, const Scene& scene) {
  if (scene.bodies.size() < 2) return;
  refuse_close_particles(layout, scene);
  const std::vector<Bounds> boxes = boxes_of(layout, layout.x);
  const auto meet = [&](std::size_t a, std::size_t b) {
    for (std::size_t k = 0; k < 3; ++k)
      if (boxes[a].low[k] > boxes[b].high[k] + scene.spacing ||
          boxes[b].low[k] > boxes[a].high[k] + scene.spacing)
        return false;
    return true;
  };
  for (std::size_t a = 0; a < boxes.size(); ++a)
    for (std::size_t b = 0; b < boxes.size(); ++b)
      if (a != b && meet(a, b) && starts_as_laid(scene.bodies[a]) && starts_as_laid(scene.bodies[b]))
        refuse_particles_inside(layout, scene, a, b, boxes[b]);
}

}  // namespace taut
