#include "engine/contact/facet_contacts.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "engine/core/parallel.hpp"
#include "engine/error.hpp"
#include "engine/layout/surface_mesh.hpp"

namespace taut {

FacetContacts::FacetContacts(const SolverInput& input)
    : dp_(input.constants.dp),
      stiffness_(input.constants.contact_stiffness),
      facets_(make_surface_mesh(input.scene, input.initial, input.threads)),
      candidates_(input, facets_, apart * dp_),
      force_(facets_.mesh().size()) {
  if (input.scene.bodies.size() > 1 || !input.scene.walls.empty()) refuse_thin(input.scene);
  for (const SurfaceMesh::Facet& facet : facets_.mesh().facets) {
    const Elasticity& e = input.materials[input.initial.material[facet.particle]];
    M_.push_back(e.K + 4.0 / 3 * e.G);
  }
}

void FacetContacts::refuse_thin(const Scene& scene) const {
  for (int b = 0; b < static_cast<int>(scene.bodies.size()); ++b) {
    if (facets_.mesh().closed[b]) continue;
    throw SceneError(
        "body." + scene.bodies[b].name,
        fmt::format("the contact law 'surface' needs faces, and body '{}' is too thin to have all of them: "
                    "use a smaller spacing or another law",
                    scene.bodies[b].name));
  }
}

bool FacetContacts::search(const Particles<3>& s, const WallContacts<3>& walls, std::optional<double> way) {
  if (facets_.size() == 0) return false;
  if (!way) facets_.renumber(s);
  const bool searched = candidates_.search(s, facets_, walls, way);
  if (searched) list();
  return searched;
}

void FacetContacts::list() {
  rows_.clear();
  begin_.assign(1, 0);
  std::vector<char> watched(facets_.size());
  const auto& pairs = candidates_.pairs;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto& [f, g] = pairs[k];
    if (rows_.empty() || rows_.back().facet != f || rows_.back().body != facets_.body(g)) {
      if (!rows_.empty()) begin_.push_back(static_cast<int>(k));
      rows_.push_back({f, facets_.body(g)});
    }
    watched[f] = true;
  }
  if (!rows_.empty()) begin_.push_back(static_cast<int>(pairs.size()));
  other_.clear();
  for (const auto& [f, g] : pairs) {
    const auto key = [](const Row& row) { return std::pair(row.facet, row.body); };
    const auto found = std::ranges::lower_bound(rows_, std::pair(g, facets_.body(f)), {}, key);
    other_.push_back(static_cast<int>(found - rows_.begin()));
  }
  for (const auto& [f, wall] : candidates_.near_wall) watched[f] = true;
  watched_ = indices_of(watched);
  nodes_ = facets_.nodes_of(watched_);
  touching_ = facets_.particles_of(nodes_);
}

/// Calls f(row of the other facet, pair) for each of the `count` rows from `first` on that contributes to the mean
/// depth of `row`.
template <class F>
void FacetContacts::for_each_pair(int row, const int* first, int count, const F& f) const {
  const MovingFacets::Place& own = facets_[rows_[row].facet];
  const double widest = radius * radius * dp_ * dp_, farthest = widest + behind * behind * dp_ * dp_;
  for (const int* o = first; o < first + count; ++o) {
    const MovingFacets::Place& other = facets_[rows_[*o].facet];
    Pair pair;
    pair.d = own.middle - other.middle;
    const double d2 = dot(pair.d, pair.d);
    if (d2 >= farthest) continue;
    pair.cosine = dot(own.normal, other.normal);
    pair.share = projected_share(pair.cosine);
    if (pair.share == 0) continue;
    const V between = other.normal - own.normal;
    const double square = 2 - 2 * pair.cosine, height = dot(pair.d, between);  // |between|²; p |between|
    if (d2 * square - height * height >= widest * square) continue;
    const double inverse = 1 / std::sqrt(square);
    pair.middle = inverse * between;
    pair.p = inverse * height;
    pair.l2 = d2 - pair.p * pair.p;
    if (std::abs(pair.p) >= reach_at(pair.p)) continue;
    pair.radius = lateral_radius(pair.p, dp_);
    if (pair.l2 >= pair.radius * pair.radius) continue;
    pair.weight = lateral_weight(pair.l2, pair.radius);
    pair.near = near_share(pair.p, reach_at(pair.p));
    f(*o, pair);
  }
}

/// Calls f(facet, wall, depth, projected share, k) for facets behind a wall that face it. `depth`: overlap with the
/// mirror image, m.
template <class F>
void FacetContacts::for_each_wall(const WallContacts<3>& walls, const F& f) const {
  for (const auto& [facet, wall] : candidates_.near_wall) {
    const double height = walls.height(wall, facets_[facet].middle);
    if (height >= 0) continue;
    const double share = projected_share(dot(facets_[facet].normal, walls.normal(wall)));
    if (share > 0)
      f(facet, wall, -2 * height, share, surface_stiffness(M_[facet], M_[facet], stiffness_, dp_));
  }
}

void FacetContacts::place(const Particles<3>& s) {
  facets_.place(s, nodes_, watched_, threads_);
  near_.resize(other_.size());
  touches_.resize(rows_.size());
  parallel_for(static_cast<int>(rows_.size()), threads_, [&](int r) { touches_[r] = measured(r); });
}

auto FacetContacts::measured(int r) -> Touch {
  Touch touch;
  double sum = 0;
  int* const near = near_.data() + begin_[r];
  for_each_pair(r, other_.data() + begin_[r], begin_[r + 1] - begin_[r], [&](int other, const Pair& pair) {
    near[touch.near++] = other;
    const double W = facets_[rows_[other].facet].area * weight_of(pair);
    sum += W * pair.p;
    touch.M += W * M_[rows_[other].facet];
    touch.cover += W;
  });
  if (!(touch.cover > 0)) return touch;
  touch.height = sum / touch.cover;
  if (touch.height >= 0) return touch;
  touch.M /= touch.cover;
  const int facet = rows_[r].facet;
  const double area = area_of(facet) * covered_share(touch.cover),
               k_per_M = surface_stiffness_slope(M_[facet], touch.M, stiffness_, dp_);
  touch.k = surface_stiffness(M_[facet], touch.M, stiffness_, dp_);
  touch.per_sum = hard_energy(-touch.height, area_of(facet) * covered_slope(touch.cover), touch.k, dp_);
  touch.per_p = -hard_force(-touch.height, area, touch.k, dp_) / touch.cover;
  touch.per_M = hard_energy(-touch.height, area, k_per_M, dp_) / touch.cover;
  return touch;
}

/// Derivatives of the energy of all contacts, also of the other rows.
MovingFacets::Slope FacetContacts::slope_of(int r) const {
  const Touch& own = touches_[r];
  const double area = facets_[rows_[r].facet].area, M = M_[rows_[r].facet];
  MovingFacets::Slope slope;
  for_each_pair(r, near_.data() + begin_[r], own.near, [&](int o, const Pair& pair) {
    const Touch& other = touches_[o];
    if (own.per_p == 0 && other.per_p == 0) return;
    const MovingFacets::Place& at = facets_[rows_[o].facet];
    const double per_other = other.per_weight(pair.p, M);
    const double per_weight = own.per_weight(pair.p, M_[rows_[o].facet]) * at.area + per_other * area;
    const double per_w = per_weight * pair.share * pair.near,
                 per_l2 = per_w * lateral_slope(pair.l2, pair.radius),
                 per_radius = per_w * lateral_slope_in_radius(pair.l2, pair.radius);
    const double per_share = per_weight * pair.weight * pair.near;
    const double per_p = (own.per_p * at.area + other.per_p * area) * weight_of(pair) +
                         per_weight * pair.share * pair.weight * near_slope(pair.p, reach_at(pair.p)) +
                         per_radius * lateral_radius_slope(pair.p, dp_) - 2 * pair.p * per_l2;
    slope.middle += per_p * pair.middle + (2 * per_l2) * pair.d;
    const double square = 2 - 2 * pair.cosine;  // |n_g − n_f|²
    slope.normal += (per_share * projected_slope(pair.cosine) + per_p * pair.p / square) * at.normal -
                    (per_p / std::sqrt(square)) * pair.d;
    slope.area += per_other * weight_of(pair);
  });
  return slope;
}

void FacetContacts::evaluate(const Particles<3>& s, double dt, WallContacts<3>& walls, std::vector<V>& force,
                             int threads) {
  threads_ = threads;
  place(s);
  for (const int n : nodes_) force_[n] = V{};
  const auto share_out = [&](const auto& take) {
    for (const int n : nodes_)
      if (dot(force_[n], force_[n]) != 0)
        facets_.for_each_share(n, [&](int i, double weight) { take(i, weight * force_[n]); });
  };
  for_each_wall(walls, [&](int facet, int wall, double depth, double share, double k) {
    const V& normal = walls.normal(wall);
    const double area = area_of(facet), slope = projected_slope(dot(facets_[facet].normal, normal));
    // 2: the facet touches its image, and the image the facet
    facets_.push(facet,
                 {.middle = (-2 * surface_force(depth, area * share, k)) * normal,
                  .normal = (surface_energy(depth, area, k) * slope) * normal},
                 force_);
  });
  share_out([&](int i, const V& f) { walls.record_impulse(s.x[i], (dt * s.mobile[i]) * f); });
  slopes_.resize(rows_.size());
  parallel_for(static_cast<int>(rows_.size()), threads_, [&](int r) { slopes_[r] = slope_of(r); });
  for (std::size_t r = 0; r < rows_.size(); ++r)
    if (touches_[r].near > 0) facets_.push(rows_[r].facet, slopes_[r], force_);
  for (const int i : touching_) force[i] = V{};
  share_out([&](int i, const V& f) { force[i] += f; });
  hardening_ = 1;
  for (const Touch& touch : touches_)
    if (touch.height < 0) hardening_ = std::max(hardening_, hardening(-touch.height, touch.cover, dp_));
}

double FacetContacts::energy(const Particles<3>& s, const WallContacts<3>& walls) {
  place(s);
  double sum = 0;
  for (std::size_t r = 0; r < rows_.size(); ++r)
    sum += hard_energy(-touches_[r].height, area_of(rows_[r].facet) * covered_share(touches_[r].cover),
                       touches_[r].k, dp_);
  for_each_wall(walls, [&](int facet, int, double depth, double share, double k) {
    // half of the energy belongs to the image
    sum += surface_energy(depth, area_of(facet) * share, k);
  });
  return sum;
}

auto FacetContacts::between(const Particles<3>&, int a, int b) const -> V {
  V sum{};
  for (std::size_t r = 0; r < rows_.size(); ++r)
    if (rows_[r].body == b && facets_.body(rows_[r].facet) == a) sum -= slopes_[r].middle;
  return sum;
}

auto FacetContacts::of_wall(const Particles<3>&, int a, int wall, const WallContacts<3>& walls) const -> V {
  double sum = 0;
  for_each_wall(walls, [&](int facet, int touched, double depth, double share, double k) {
    if (touched == wall && facets_.body(facet) == a)
      sum += 2 * surface_force(depth, area_of(facet) * share, k);
  });
  return sum * walls.normal(wall);
}

double FacetContacts::gap(const Particles<3>& s, int a, int b) {
  double least = before * dp_;
  if (rows_.empty()) return least;
  place(s);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const int own = facets_.body(rows_[r].facet), other = rows_[r].body;
    if (((own == a && other == b) || (own == b && other == a)) && covered_share(touches_[r].cover) > 0)
      least = std::min(least, touches_[r].height);
  }
  return least;
}

}  // namespace taut
