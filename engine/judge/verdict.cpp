#include "engine/judge/verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "engine/core/parallel.hpp"
#include "engine/neighbors/close_pairs.hpp"

namespace taut {
namespace {

constexpr std::array<std::pair<Verdict, std::string_view>, 5> verdicts = {{
    {Verdict::stable, "stable"},
    {Verdict::hourglass, "hourglass"},
    {Verdict::penetrated, "penetrated"},
    {Verdict::fractured, "fractured"},
    {Verdict::diverged, "diverged"},
}};

template <int Dim>
std::array<double, Dim> between(const std::vector<double>& x, int i, int j) {
  std::array<double, Dim> d;
  for (std::size_t k = 0; k < Dim; ++k)
    d[k] = x[Dim * static_cast<std::size_t>(j) + k] - x[Dim * static_cast<std::size_t>(i) + k];
  return d;
}
template <std::size_t Dim>
double dot(const std::array<double, Dim>& a, const std::array<double, Dim>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

std::string_view name(Verdict verdict) {
  return std::ranges::find(verdicts, verdict, &std::pair<Verdict, std::string_view>::first)->second;
}

std::optional<Verdict> find_verdict(std::string_view name) {
  const auto* found = std::ranges::find(verdicts, name, &std::pair<Verdict, std::string_view>::second);
  return found == verdicts.end() ? std::nullopt : std::optional(found->first);
}

std::vector<std::string> names_of_verdicts() {
  std::vector<std::string> names;
  for (int v = static_cast<int>(Verdict::stable); v <= static_cast<int>(Verdict::diverged); ++v)
    names.emplace_back(name(static_cast<Verdict>(v)));
  return names;
}

std::vector<std::string> names_of_failures() {
  std::vector<std::string> names = names_of_verdicts();
  names.erase(names.begin());
  return names;
}

Judge::Judge(const Scene& scene, const Snapshot& start, double support, bool keeps_neighbors, int threads)
    : particles_(start.size()),
      longest_(std::max(support, 2 * scene.spacing)),
      keeps_neighbors_(keeps_neighbors),
      energies_(scene, start, support, keeps_neighbors),
      penetration_(start, scene.spacing, threads) {
  for (const Material& material : scene.materials) compliance_.push_back(1 / material.youngs_modulus);
  const auto add = [this](int i, int j) { bonds_.push_back({i, j, false}); };
  for_each_close_pair(start, 1.5 * scene.spacing, add, threads);
  bonds_.shrink_to_fit();
  first_of_.assign(particles_ + 1, 0);
  for (const Bond& bond : bonds_) ++first_of_[bond.i + 1], ++first_of_[bond.j + 1];
  std::partial_sum(first_of_.begin(), first_of_.end(), first_of_.begin());
  bonds_of_.resize(2 * bonds_.size());
  std::vector<int> end(first_of_.begin(), first_of_.end() - 1);
  for (std::size_t b = 0; b < bonds_.size(); ++b)
    for (const int i : {bonds_[b].i, bonds_[b].j}) bonds_of_[end[i]++] = static_cast<int>(b);
  pieces_ = start_pieces_ = count_pieces();
}

Judge::Judge(const Scene& scene, const Simulation& simulation)
    : Judge(scene, simulation.snapshot(), simulation.support(), simulation.keeps_neighbors(),
            simulation.threads()) {
  lawful_stretch_ = simulation.lawful_stretch();
  const Snapshot& start = simulation.snapshot();
  const int n = static_cast<int>(bonds_.size()), threads = simulation.threads();
  std::vector<double> shortest(chunks_of(n, threads), std::numeric_limits<double>::infinity());
  parallel_chunks(n, threads, [&](int chunk, int first, int last) {
    for (int b = first; b < last; ++b) {
      const Point X = start.initial(static_cast<std::size_t>(bonds_[b].i)),
                  Y = start.initial(static_cast<std::size_t>(bonds_[b].j));
      shortest[chunk] = std::min(shortest[chunk], std::hypot(X[0] - Y[0], X[1] - Y[1], X[2] - Y[2]));
    }
  });
  shortest_ = std::ranges::min(shortest);
}

void Judge::observe(const Snapshot& now, const Balance& balance, const Readings& readings) {
  // `balance` sums all positions, velocities, and strain energies or stresses
  const bool finite = std::isfinite(balance.kinetic + balance.strain) && std::isfinite(balance.angular_scale);
  if (!finite || energies_.diverges(now)) since_.try_emplace(Verdict::diverged, now.time);
  if (!finite) return;
  static_assert(indicators[0].key == "hourglass_error");
  if (readings[0].share() > hourglass_threshold) since_.try_emplace(Verdict::hourglass, now.time);
  if (!since_.contains(Verdict::penetrated) && penetration_(now) > 0)
    since_.emplace(Verdict::penetrated, now.time);
  if (!update_broken(now)) return;
  pieces_ = count_pieces();
  if (!since_.contains(Verdict::fractured) && (pieces_ > start_pieces_ || has_crack()))
    since_.emplace(Verdict::fractured, now.time);
}

Verdict Judge::verdict() const { return since_.empty() ? Verdict::stable : since_.rbegin()->first; }

bool Judge::update_broken(const Snapshot& now) {
  return now.dim == 3 ? update_broken_in<3>(now) : update_broken_in<2>(now);
}

template <int Dim>
bool Judge::update_broken_in(const Snapshot& now) {
  const double* const x = now.x.data();
  const double longest2 = longest_ * longest_, lawful2 = lawful_stretch_ * lawful_stretch_,
               least2 = lawful2 * shortest_ * shortest_;
  bool changed = false;
  std::size_t beyond = 0;
  for (Bond& bond : bonds_) {
    const double *from = x + std::ptrdiff_t{Dim} * bond.i, *to = x + std::ptrdiff_t{Dim} * bond.j;
    double squared = 0;
    for (int k = 0; k < Dim; ++k) squared += (to[k] - from[k]) * (to[k] - from[k]);
    if (squared > least2 && squared_stretch<Dim>(bond, now) > lawful2) ++beyond;
    const bool broken = squared > longest2 && (!keeps_neighbors_ || stands_out<Dim>(bond, now));
    if (broken == bond.broken) continue;
    bond.broken = broken;
    changed = true;
  }
  if (beyond > 0 && beyond_law_.share == 0) beyond_law_.since = now.time;
  if (beyond > 0)
    beyond_law_.share =
        std::max(beyond_law_.share, static_cast<double>(beyond) / static_cast<double>(bonds_.size()));
  return changed;
}

template <int Dim>
double Judge::squared_stretch(const Bond& bond, const Snapshot& now) {
  const auto X = between<Dim>(now.x0, bond.i, bond.j), x = between<Dim>(now.x, bond.i, bond.j);
  return dot(x, x) / dot(X, X);
}

double Judge::compliance(const Bond& bond, const Snapshot& now) const {
  return compliance_[now.material[bond.i]] + compliance_[now.material[bond.j]];
}

/// Whether the bond is stretched much more than its continuations.
template <int Dim>
bool Judge::stands_out(const Bond& bond, const Snapshot& now) const {
  constexpr double jump = 1.5, straight = 0.9;  // ratio of stretches; cosine
  const auto continues = [](const std::array<double, Dim>& a, const std::array<double, Dim>& b) {
    const double along = dot(a, b);
    return along < 0 && along * along > straight * straight * dot(a, a) * dot(b, b);
  };
  const double elongation = std::sqrt(squared_stretch<Dim>(bond, now)) - 1, own = compliance(bond, now);
  for (const auto& [i, j] : {std::pair(bond.i, bond.j), std::pair(bond.j, bond.i)}) {
    const auto X = between<Dim>(now.x0, i, j), x = between<Dim>(now.x, i, j);
    for (int k = first_of_[i]; k < first_of_[i + 1]; ++k) {
      const Bond& other = bonds_[bonds_of_[k]];
      const int to = other.i == i ? other.j : other.i;
      if (continues(X, between<Dim>(now.x0, i, to)) && continues(x, between<Dim>(now.x, i, to)) &&
          jump * std::sqrt(squared_stretch<Dim>(other, now)) >= 1 + elongation * compliance(other, now) / own)
        return false;
    }
  }
  return true;
}

int Judge::count_pieces() const {
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
  for (const Bond& bond : bonds_) {
    if (bond.broken) continue;
    const int i = root(bond.i), j = root(bond.j);
    if (i == j) continue;
    parent[static_cast<std::size_t>(std::max(i, j))] = std::min(i, j);
    --pieces;
  }
  return pieces;
}

bool Judge::has_crack() const {
  std::vector<int> seen(particles_, -1);  // [particle] last bond whose search reached it
  for (std::size_t b = 0; b < bonds_.size(); ++b)
    if (bonds_[b].broken && !bypassed(static_cast<int>(b), seen)) return true;
  return false;
}

/// Whether at most `around` unbroken bonds connect the bond's ends.
bool Judge::bypassed(int bond, std::vector<int>& seen) const {
  constexpr int around = 8;
  const auto [start, goal, broken] = bonds_[static_cast<std::size_t>(bond)];
  std::vector<int> edge{start}, next;
  seen[static_cast<std::size_t>(start)] = bond;
  for (int length = 0; length < around && !edge.empty(); ++length) {
    next.clear();
    for (const int from : edge) {
      for (int k = first_of_[from]; k < first_of_[from + 1]; ++k) {
        const Bond& way = bonds_[bonds_of_[k]];
        const int to = way.i == from ? way.j : way.i;
        if (way.broken || seen[static_cast<std::size_t>(to)] == bond) continue;
        if (to == goal) return true;
        seen[static_cast<std::size_t>(to)] = bond;
        next.push_back(to);
      }
    }
    edge.swap(next);
  }
  return false;
}

}  // namespace taut
