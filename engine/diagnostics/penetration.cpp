#include "engine/diagnostics/penetration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "engine/core/tensor.hpp"
#include "engine/neighbors/close_pairs.hpp"
#include "engine/neighbors/neighbors.hpp"

namespace taut {
namespace {

using V = Vec<double, 2>;
/// Two doubles that any x86-64 works on at once.
typedef double Pair __attribute__((vector_size(2 * sizeof(double))));

// in spacings
constexpr double near = 1.5;   // the eight around a particle of a square lattice, the six of a hexagonal one
constexpr double far = 4;      // at the start: as far as what contact keeps apart is
constexpr double reach = 2.5;  // of the lists; below `far` a body with little strain has nobody in them
constexpr double skin = reach - near;

constexpr double widest_inside = 2 * std::numbers::pi / 3;

V place(const Snapshot& now, int i) {
  const std::size_t at = 2 * static_cast<std::size_t>(i);
  return {now.x[at], now.x[at + 1]};
}

double direction(const Snapshot& now, int from, int to) {
  const Point a = now.position(static_cast<std::size_t>(from)),
              b = now.position(static_cast<std::size_t>(to));
  return std::atan2(b[1] - a[1], b[0] - a[0]);
}

std::vector<int> surface_particles(const Snapshot& start, double radius) {
  std::vector<std::vector<double>> directions(start.size());
  for_each_close_pair(start, radius, [&](int i, int j) {
    directions[static_cast<std::size_t>(i)].push_back(direction(start, i, j));
    directions[static_cast<std::size_t>(j)].push_back(direction(start, j, i));
  });
  std::vector<int> surface;
  for (std::size_t i = 0; i < directions.size(); ++i)
    if (widest_gap(directions[i]) > widest_inside) surface.push_back(static_cast<int>(i));
  return surface;
}

/// Some of the particles, in cells.
class Cells {
 public:
  Cells(const Snapshot& now, const std::vector<int>& particles, double radius) : radius_(radius) {
    std::vector<V> x;
    for (const int i : particles) x.push_back(place(now, i));
    for (const int k : grid_.sort(x, radius)) {
      const auto at = static_cast<std::size_t>(k);
      stored_.push_back({x[at], particles[at]});
    }
  }

  /// Calls visit(j) for every one of them at most `radius` from x, which lies among them.
  template <class Visit>
  void for_each_around(const V& x, Visit visit) const {
    grid_.for_each_row(x, [&](int first, int last) {
      for (int k = first; k < last; ++k) {
        const Stored& other = stored_[static_cast<std::size_t>(k)];
        if (const V d = other.x - x; dot(d, d) <= radius_ * radius_) visit(other.particle);
      }
    });
  }

 private:
  struct Stored {
    V x;
    int particle;
  };

  double radius_;  // m
  CellGrid<2> grid_;
  std::vector<Stored> stored_;  // in the order of the cells
};

/// All in the box of some, widened by a margin.
std::vector<int> particles_around(const Snapshot& now, const std::vector<int>& some, double margin) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::array<double, 2> low{infinite, infinite}, high{-infinite, -infinite};
  for (const int i : some)
    for (std::size_t k = 0; k < 2; ++k) {
      const double x = now.x[2 * static_cast<std::size_t>(i) + k];
      low[k] = std::min(low[k], x - margin), high[k] = std::max(high[k], x + margin);
    }
  std::vector<int> around;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (const double x = now.x[2 * i], y = now.x[2 * i + 1];
        x >= low[0] && x <= high[0] && y >= low[1] && y <= high[1])
      around.push_back(static_cast<int>(i));
  return around;
}

}  // namespace

double widest_gap(std::span<double> directions) {
  constexpr double turn = 2 * std::numbers::pi;
  if (directions.size() < 2) return turn;
  std::ranges::sort(directions);
  double widest = directions.front() + turn - directions.back();
  for (std::size_t k = 1; k < directions.size(); ++k)
    widest = std::max(widest, directions[k] - directions[k - 1]);
  return widest;
}

Penetration::Penetration(const Snapshot& start, double spacing)
    : spacing_(spacing), on_surface_(start.size()) {
  if (start.dim != 2) return;
  surface_ = surface_particles(start, near * spacing);
  for (const int i : surface_) on_surface_[static_cast<std::size_t>(i)] = true;
}

int Penetration::operator()(const Snapshot& now) {
  if (surface_.empty()) return 0;
  if (!lists_hold(now)) search(now);
  return static_cast<int>(
      std::ranges::count_if(asked_, [&](const Asked& asked) { return is_inside(now, asked); }));
}

bool Penetration::lists_hold(const Snapshot& now) const {
  if (at_search_.empty()) return false;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Pair low{infinite, infinite}, high{-infinite, -infinite};
  for (std::size_t i = 0; i < now.x.size(); i += 2) {
    Pair x, before;
    std::memcpy(&x, &now.x[i], sizeof x);
    std::memcpy(&before, &at_search_[i], sizeof before);
    const Pair moved = x - before;
    low = moved < low ? moved : low;
    high = moved > high ? moved : high;
  }
  const Pair sides = high - low;
  return std::hypot(sides[0], sides[1]) <= skin * spacing_;
}

void Penetration::search(const Snapshot& now) {
  at_search_ = now.x;
  asked_.clear();
  near_.clear();
  const std::vector<int> ask = to_ask(now);
  if (ask.empty()) return;
  const double radius = reach * spacing_;
  const Cells around(now, particles_around(now, ask, radius), radius);
  for (const int i : ask) {
    const int begin = static_cast<int>(near_.size());
    around.for_each_around(place(now, i), [&](int j) {
      if (is_far(now, i, j)) near_.push_back(j);
    });
    asked_.push_back({i, begin, static_cast<int>(near_.size())});
  }
}

/// The particles of a surface that have a far one of a surface in reach.
std::vector<int> Penetration::to_ask(const Snapshot& now) const {
  const Cells surface(now, surface_, reach * spacing_);
  std::vector<int> ask;
  for (const int i : surface_) {
    bool any = false;
    surface.for_each_around(place(now, i), [&](int j) { any = any || is_far(now, i, j); });
    if (any) ask.push_back(i);
  }
  return ask;
}

bool Penetration::is_far(const Snapshot& now, int i, int j) const {
  const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
  if (now.body[a] != now.body[b]) return true;
  const double dx = now.x0[2 * a] - now.x0[2 * b], dy = now.x0[2 * a + 1] - now.x0[2 * b + 1];
  return dx * dx + dy * dy > far * far * spacing_ * spacing_;
}

bool Penetration::is_inside(const Snapshot& now, const Asked& asked) {
  directions_.clear();
  bool at_surface = false;
  for (int k = asked.begin; k < asked.end; ++k) {
    const int j = near_[static_cast<std::size_t>(k)];
    if (squared_distance(now, asked.particle, j) >= near * near * spacing_ * spacing_) continue;
    directions_.push_back(direction(now, asked.particle, j));
    at_surface = at_surface || on_surface_[static_cast<std::size_t>(j)];
  }
  return at_surface && widest_gap(directions_) <= widest_inside;
}

}  // namespace taut
