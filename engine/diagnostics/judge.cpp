#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <numeric>
#include <utility>

#include "engine/verdict.hpp"

namespace taut {
namespace {

constexpr std::array<std::pair<Verdict, std::string_view>, 3> verdicts = {{
    {Verdict::stable, "stable"},
    {Verdict::fractured, "fractured"},
    {Verdict::diverged, "diverged"},
}};

double squared_distance(const Snapshot& now, int i, int j) {
  const double* a = now.x.data() + static_cast<std::ptrdiff_t>(i) * now.dim;
  const double* b = now.x.data() + static_cast<std::ptrdiff_t>(j) * now.dim;
  double squared = 0;
  for (int k = 0; k < now.dim; ++k) squared += (a[k] - b[k]) * (a[k] - b[k]);
  return squared;
}

/// A particle by its body and its cell z, y, x; sorted, three cells abreast in x follow one another.
struct Place {
  std::array<long, 4> cell{};
  int particle = 0;
  auto operator<=>(const Place&) const = default;
};

std::vector<Place> sorted_places(const Snapshot& now, double width) {
  std::vector<Place> places(now.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    places[i] = {{now.body[i], 0, 0, 0}, static_cast<int>(i)};
    for (int a = 0; a < now.dim; ++a) {
      const double x = now.x[i * static_cast<std::size_t>(now.dim) + static_cast<std::size_t>(a)];
      places[i].cell[static_cast<std::size_t>(3 - a)] = std::lround(std::floor(x / width));
    }
  }
  std::ranges::sort(places);
  return places;
}

/// Calls visit(i, j), i < j, for every two particles of one body at most `reach` apart.
template <class Visit>
void for_each_close_pair(const Snapshot& now, double reach, Visit visit) {
  const std::vector<Place> places = sorted_places(now, reach);
  const int layers = now.dim == 3 ? 1 : 0;
  for (const auto& [cell, i] : places) {
    for (int dz = -layers; dz <= layers; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        const Place first = {{cell[0], cell[1] + dz, cell[2] + dy, cell[3] - 1}, 0};
        const std::array<long, 4> last = {cell[0], cell[1] + dz, cell[2] + dy, cell[3] + 1};
        auto place = std::ranges::lower_bound(places, first);
        for (; place != places.end() && place->cell <= last; ++place) {
          const int j = place->particle;
          if (i < j && squared_distance(now, i, j) <= reach * reach) visit(i, j);
        }
      }
    }
  }
}

}  // namespace

std::string_view name(Verdict verdict) {
  return std::ranges::find(verdicts, verdict, &std::pair<Verdict, std::string_view>::first)->second;
}

std::optional<Verdict> find_verdict(std::string_view name) {
  const auto* found = std::ranges::find(verdicts, name, &std::pair<Verdict, std::string_view>::second);
  return found == verdicts.end() ? std::nullopt : std::optional(found->first);
}

Judge::Judge(const Scene& scene, const Snapshot& start, double support)
    : particles_(start.size()), longest_(std::max(support, 2 * scene.spacing)) {
  // 1.5 dp: the eight nearest of a square lattice (√2 dp), the six of a hexagonal one, no second row
  for_each_close_pair(start, 1.5 * scene.spacing, [this](int i, int j) { bonds_.push_back({i, j}); });
  broken_.assign(bonds_.size(), false);
  pieces_ = start_pieces_ = count_pieces(broken_);
  const Balance at_start = balance(start, scene);
  start_energy_ = given_energy_ = at_start.kinetic + at_start.strain;
}

void Judge::look(const Snapshot& now, const Balance& balance) {
  const double energy = balance.kinetic + balance.strain;
  // the angular scale contains every position, the energies every other value
  const bool finite = std::isfinite(energy) && std::isfinite(balance.angular_scale);
  given_energy_ = std::max(given_energy_, start_energy_ + balance.work);
  if (!finite || (given_energy_ > 0 && energy > 2 * given_energy_)) {
    since_.try_emplace(Verdict::diverged, now.time);
  }
  if (!finite) return;
  std::vector<bool> broken = find_broken(now);
  if (broken != broken_) {
    pieces_ = count_pieces(broken);
    broken_ = std::move(broken);
  }
  if (pieces_ > start_pieces_) since_.try_emplace(Verdict::fractured, now.time);
}

Verdict Judge::verdict() const { return since_.empty() ? Verdict::stable : since_.rbegin()->first; }

std::vector<bool> Judge::find_broken(const Snapshot& now) const {
  std::vector<bool> broken(bonds_.size());
  for (std::size_t b = 0; b < bonds_.size(); ++b) {
    broken[b] = squared_distance(now, bonds_[b].i, bonds_[b].j) > longest_ * longest_;
  }
  return broken;
}

int Judge::count_pieces(const std::vector<bool>& broken) const {
  std::vector<int> parent(particles_);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&parent](int i) {
    while (parent[static_cast<std::size_t>(i)] != i) {
      int& up = parent[static_cast<std::size_t>(i)];
      i = up = parent[static_cast<std::size_t>(up)];
    }
    return i;
  };
  int pieces = static_cast<int>(particles_);
  for (std::size_t b = 0; b < bonds_.size(); ++b) {
    if (broken[b]) continue;
    const int i = root(bonds_[b].i), j = root(bonds_[b].j);
    if (i == j) continue;
    parent[static_cast<std::size_t>(std::max(i, j))] = std::min(i, j);
    --pieces;
  }
  return pieces;
}

}  // namespace taut
