#include "engine/judge/penetration.hpp"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "engine/core/parallel.hpp"
#include "engine/core/tensor.hpp"
#include "engine/neighbors/close_pairs.hpp"
#include "engine/neighbors/neighbors.hpp"

namespace taut {
namespace {

// in spacings
constexpr double near = 1.5;  // includes diagonal neighbours of a square lattice
constexpr double far = 4;
constexpr double reach = 2.5;  // range of the lists; less than `far` for speed
constexpr double skin = reach - near;

constexpr double shallow(int dim) { return dim == 3 ? 0.41 : 0.29; }  // see THEORY.md

constexpr double widest_inside = 2 * std::numbers::pi / 3;

template <int Dim>
Vec<double, Dim> place(const std::vector<double>& places, int i) {
  Vec<double, Dim> x;
  std::copy_n(places.data() + std::ptrdiff_t{Dim} * i, Dim, &x[0]);
  return x;
}

template <int Dim>
struct Around;

template <>
struct Around<2> {
  std::vector<double> directions;  // rad

  void clear() { directions.clear(); }
  void add(const Vec<double, 2>& d) { directions.push_back(std::atan2(d[1], d[0])); }
  bool leaves_gap() { return widest_gap(directions) > widest_inside; }
};

/// Unit vectors to the surface points of a 5 × 5 × 5 lattice.
std::array<Vec<double, 3>, 98> spread_directions() {
  std::array<Vec<double, 3>, 98> all;
  std::size_t n = 0;
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z)
        if (const double r = std::hypot(x, y, z); std::max({x * x, y * y, z * z}) == 4)
          all[n++] = Vec<double, 3>{x / r, y / r, z / r};
  return all;
}

template <>
struct Around<3> {
  std::bitset<98> has_one;  // [direction] whether a particle lies within `widest_inside`/2 of it

  void clear() { has_one.reset(); }
  void add(const Vec<double, 3>& d) {
    static const std::array<Vec<double, 3>, 98> spread = spread_directions();
    static const double nearest = std::cos(widest_inside / 2);
    if (has_one.all()) return;
    const double least = nearest * std::sqrt(dot(d, d));
    for (std::size_t k = 0; k < spread.size(); ++k)
      if (const double along = dot(spread[k], d); along > 0 && along >= least) has_one.set(k);
  }
  bool leaves_gap() const { return !has_one.all(); }
};

/// Initial vector from i to j, m; exactly antisymmetric, including the sign of zeros.
template <int Dim>
Vec<double, Dim> way(const Snapshot& start, int i, int j) {
  return i < j ? place<Dim>(start.x0, j) - place<Dim>(start.x0, i) : -1.0 * way<Dim>(start, j, i);
}

template <int Dim>
std::vector<int> surface_particles(const Snapshot& start, double radius, int threads) {
  const PlacesInCells<Dim> places(start.x0, radius);
  std::vector<unsigned char> leaves_gap(start.size());
  parallel_chunks(static_cast<int>(start.size()), threads, [&](int, int first, int last) {
    Around<Dim> around;
    for (int i = first; i < last; ++i) {
      around.clear();
      places.for_each_around(i, [&](int j) {
        if (j != i && start.body[j] == start.body[i]) around.add(way<Dim>(start, i, j));
      });
      leaves_gap[i] = around.leaves_gap();
    }
  });
  std::vector<int> surface;
  for (std::size_t i = 0; i < leaves_gap.size(); ++i)
    if (leaves_gap[i] != 0) surface.push_back(static_cast<int>(i));
  return surface;
}

template <int Dim>
class Cells {
 public:
  Cells(const Snapshot& now, const std::vector<int>& particles, double radius) : radius_(radius) {
    std::vector<Vec<double, Dim>> x;
    for (const int i : particles) x.push_back(place<Dim>(now.x, i));
    for (const int k : grid_.sort(x, radius)) {
      const auto at = static_cast<std::size_t>(k);
      stored_.push_back({x[at], particles[at]});
    }
  }

  /// Calls visit(j) for each particle j within `radius` of x. Requires x inside the bounding box.
  template <class Visit>
  void for_each_around(const Vec<double, Dim>& x, Visit visit) const {
    grid_.for_each_row(x, [&](int first, int last) {
      for (int k = first; k < last; ++k) {
        const Stored& other = stored_[static_cast<std::size_t>(k)];
        if (const Vec<double, Dim> d = other.x - x; dot(d, d) <= radius_ * radius_) visit(other.particle);
      }
    });
  }

 private:
  struct Stored {
    Vec<double, Dim> x;
    int particle;
  };

  double radius_;  // m
  CellGrid<Dim> grid_;
  std::vector<Stored> stored_;  // by cell
};

template <int Dim>
std::vector<int> particles_around(const Snapshot& now, const std::vector<int>& some, double margin) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::array<double, Dim> low, high;
  low.fill(infinite), high.fill(-infinite);
  for (const int i : some)
    for (std::size_t k = 0; k < Dim; ++k) {
      const double x = now.x[Dim * static_cast<std::size_t>(i) + k];
      low[k] = std::min(low[k], x - margin), high[k] = std::max(high[k], x + margin);
    }
  std::vector<int> around;
  for (std::size_t i = 0; i < now.size(); ++i) {
    bool inside = true;
    for (std::size_t k = 0; k < Dim; ++k)
      inside = inside && now.x[Dim * i + k] >= low[k] && now.x[Dim * i + k] <= high[k];
    if (inside) around.push_back(static_cast<int>(i));
  }
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

Penetration::Penetration(const Snapshot& start, double spacing, int threads)
    : spacing_(spacing), on_surface_(start.size()) {
  surface_ = start.dim == 3 ? surface_particles<3>(start, near * spacing, threads)
                            : surface_particles<2>(start, near * spacing, threads);
  for (const int i : surface_) on_surface_[static_cast<std::size_t>(i)] = true;
}

int Penetration::operator()(const Snapshot& now) { return now.dim == 3 ? count<3>(now) : count<2>(now); }

template <int Dim>
int Penetration::count(const Snapshot& now) {
  if (surface_.empty()) return 0;
  if (!lists_hold<Dim>(now)) search<Dim>(now);
  Around<Dim> around;
  return static_cast<int>(std::ranges::count_if(
      tested_, [&](const Tested& tested) { return is_inside<Dim>(now, tested, around); }));
}

template <int Dim>
bool Penetration::lists_hold(const Snapshot& now) const {
  if (at_search_.empty()) return false;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  constexpr int lanes = Dim == 2 ? 2 : 1;  // divides Dim; any x86-64 has vectors of two doubles
  typedef double Several __attribute__((vector_size(lanes * sizeof(double))));
  constexpr int packs = Dim / lanes;
  Several low[packs], high[packs];
  for (int a = 0; a < packs; ++a) low[a] = Several{} + infinite, high[a] = Several{} - infinite;
  for (std::size_t i = 0; i < now.x.size(); i += Dim)
    for (int a = 0; a < packs; ++a) {
      Several x, before;
      std::memcpy(&x, &now.x[i] + a * lanes, sizeof x);
      std::memcpy(&before, &at_search_[i] + a * lanes, sizeof before);
      const Several moved = x - before;
      low[a] = moved < low[a] ? moved : low[a];
      high[a] = moved > high[a] ? moved : high[a];
    }
  double squared = 0;
  for (int k = 0; k < Dim; ++k) {
    const double side = high[k / lanes][k % lanes] - low[k / lanes][k % lanes];
    squared += side * side;
  }
  return std::sqrt(squared) <= skin * spacing_;
}

template <int Dim>
void Penetration::search(const Snapshot& now) {
  at_search_ = now.x;
  tested_.clear();
  near_.clear();
  const std::vector<int> particles = particles_to_test<Dim>(now);
  if (particles.empty()) return;
  const double radius = reach * spacing_;
  const Cells<Dim> around(now, particles_around<Dim>(now, particles, radius), radius);
  for (const int i : particles) {
    const int begin = static_cast<int>(near_.size());
    around.for_each_around(place<Dim>(now.x, i), [&](int j) {
      if (is_far<Dim>(now, i, j)) near_.push_back(j);
    });
    std::ranges::stable_sort(near_.begin() + begin, near_.end(), {},
                             [&](int j) { return now.body[static_cast<std::size_t>(j)]; });
    tested_.push_back({i, begin, static_cast<int>(near_.size())});
  }
}

template <int Dim>
std::vector<int> Penetration::particles_to_test(const Snapshot& now) const {
  const Cells<Dim> surface(now, surface_, reach * spacing_);
  std::vector<int> particles;
  for (const int i : surface_) {
    bool any = false;
    surface.for_each_around(place<Dim>(now.x, i), [&](int j) { any = any || is_far<Dim>(now, i, j); });
    if (any) particles.push_back(i);
  }
  return particles;
}

template <int Dim>
bool Penetration::is_far(const Snapshot& now, int i, int j) const {
  const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
  if (now.body[a] != now.body[b]) return true;
  const Vec<double, Dim> d = place<Dim>(now.x0, i) - place<Dim>(now.x0, j);
  return dot(d, d) > far * far * spacing_ * spacing_;
}

template <int Dim, class Around>
bool Penetration::is_inside(const Snapshot& now, const Tested& tested, Around& around) const {
  for (int k = tested.begin; k < tested.end;) {
    around.clear();
    bool at_surface = false;
    const int body = now.body[static_cast<std::size_t>(near_[static_cast<std::size_t>(k)])];
    for (; k < tested.end; ++k) {
      const int j = near_[static_cast<std::size_t>(k)];
      if (now.body[static_cast<std::size_t>(j)] != body) break;
      const Vec<double, Dim> d = place<Dim>(now.x, j) - place<Dim>(now.x, tested.particle);
      const double r2 = dot(d, d) / (spacing_ * spacing_);
      if (r2 >= near * near) continue;
      if (r2 > shallow(Dim) * shallow(Dim)) around.add(d);
      at_surface = at_surface || on_surface_[static_cast<std::size_t>(j)];
    }
    if (at_surface && !around.leaves_gap()) return true;
  }
  return false;
}

}  // namespace taut
