#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "engine/core/parallel.hpp"
#include "engine/core/shared_rows.hpp"
#include "engine/core/tensor.hpp"
#include "engine/families/bonded/bonds.hpp"
#include "engine/methods/constants.hpp"
#include "engine/neighbors/lane_neighbors.hpp"
#include "engine/scene/initial_particles.hpp"

namespace taut::inline TAUT_ISA {

/// G of a bond, Pa. Halves of two materials stand one behind the other in it, as two springs do: the harmonic
/// mean. What is held is as stiff as who holds on to it.
template <int Dim>
double bond_modulus(const Bonds& bonds, const InitialParticles& initial,
                    const std::vector<Elasticity>& materials, int id, int b) {
  const int other = initial.held[bonds.j[b]] ? id : bonds.j[b];
  const auto of = [&](int particle) {
    const Elasticity& material = materials[initial.material[particle]];
    return bond_modulus<Dim>(material.K, material.G);
  };
  const double G_i = of(id), G_j = of(other);
  return 2 * G_i * G_j / (G_i + G_j);
}

/// One bond of each of four particles; the filling has 0.
template <class Kept>
struct Spring {
  Pack third_of_k;       // ⅓ G (V0_i w_ij + V0_j w_ji)/r0², N/m (per metre depth in 2D)
  Pack per_r0_squared;   // 1/r0², 1/m²
  Pack half_r0_squared;  // ½ r0², m²

  static Spring of(const Pack& third_of_k, const Pack& per_r0_squared, const Pack& half_r0_squared) {
    return {third_of_k, per_r0_squared, half_r0_squared};
  }
  Pack third() const { return third_of_k; }
  Pack per_r02() const { return per_r0_squared; }
  /// 1/(2s) of s = r²/r0²
  Pack half_inverse(const Pack& r2) const { return half_r0_squared / r2; }
};

/// The same in half the bytes. Not 1/r0², though: a bond at rest would pull.
template <>
struct Spring<HalfPack> {
  HalfPack third_of_k;
  double per_r0_squared[lanes];

  static Spring of(const Pack& third_of_k, const Pack& per_r0_squared, const Pack&) {
    Spring spring;
    pack_into(spring.third_of_k, third_of_k);
    store(per_r0_squared, spring.per_r0_squared);
    return spring;
  }
  Pack third() const { return unpacked(third_of_k); }
  Pack per_r02() const { return load(per_r0_squared); }
  Pack half_inverse(const Pack& r2) const {
    const Pack s = r2 * per_r02();
    return s > 0 ? Pack(0.5 / s) : Pack{};
  }
};

/// The bonds of groups of four particles that are stored one behind the other, with the constants of each. A
/// particle sums over its bonds in the order in which their other ends are stored, those with an a_ij first.
/// Kept as StoredPack, or, where no two groups have the same, as HalfPack.
template <int Dim, class Kept>
class PackedBonds {
 public:
  /// Where its bonds begin.
  struct Group {
    int slot, count, spring, scale;
    int a, a_count;  // those with an a_ij are the first
  };

  PackedBonds() = default;
  /// Of particles stored in the order of `ids`.
  PackedBonds(const Bonds& bonds, const Scene& scene, const InitialParticles& initial,
              const std::vector<Elasticity>& materials, const std::vector<int>& ids, int threads = 1);

  const Group& of(int group) const { return groups_[group]; }
  const LaneSlot* slots(const Group& own) const { return slots_.from(own.slot); }
  const Spring<Kept>* springs(const Group& own) const { return springs_.from(own.spring); }
  const Vec<Kept, Dim>* a_ij(const Group& own) const { return a_ij_.from(own.a); }
  /// As far as a bond is an energy of this end: G V0_i w_ij, J
  const Kept* energy_scales(const Group& own) const { return energy_scales_.from(own.scale); }
  /// Where a bond enters a clamp: it leads to what is stored from a whole number of groups on.
  struct PlaceAtClamp {
    Vec<double, Dim> x;  // at the start, m
    int behind;          // where the held particle is stored that the bond would lead to
  };
  const std::vector<PlaceAtClamp>& places_at_clamp() const { return places_at_clamp_; }
  /// A bond of a free particle that ends there.
  struct ToClamp {
    int group, lane, bond, place;
  };
  const std::vector<ToClamp>& bonds_to_clamp() const { return bonds_to_clamp_; }

 private:
  struct Bond {
    int j;  // where its other end is stored
    double k, r2, scale;
    Point a;
  };
  using Four = std::array<std::vector<Bond>, lanes>;
  struct Packed {  // of a group
    std::vector<LaneSlot> slots;
    std::vector<Spring<Kept>> springs;
    std::vector<Kept> scales;
    std::vector<Vec<Kept, Dim>> areas;
    std::vector<ToClamp> to_clamp;
    struct {
      std::size_t slots, springs, scales, areas;
    } hash;

    void append(int group, const Four& bonds, int size);
  };

  std::vector<int> add_places_at_clamp(const Bonds& bonds, const Scene& scene,
                                       const InitialParticles& initial, const std::vector<int>& ids,
                                       const std::vector<int>& where);

  std::vector<Group> groups_;
  SharedRows<LaneSlot> slots_;
  SharedRows<Spring<Kept>> springs_;
  SharedRows<Vec<Kept, Dim>> a_ij_;  // times a constant that B takes out again
  SharedRows<Kept> energy_scales_;
  std::vector<PlaceAtClamp> places_at_clamp_;
  std::vector<ToClamp> bonds_to_clamp_;
};

/// The bond that particle `id` is seen through by the other end; −1 if it is not.
inline int seen_from(const Bonds& bonds, int other, int id) {
  const int* const last = bonds.j.data() + bonds.begin[other + 1];
  const int* const found = std::find(bonds.j.data() + bonds.begin[other], last, id);
  return found == last ? -1 : static_cast<int>(found - bonds.j.data());
}

/// Where those of each stored particle begin: in the order of its bonds.
template <int Dim, class Kept>
std::vector<int> PackedBonds<Dim, Kept>::add_places_at_clamp(const Bonds& bonds, const Scene& scene,
                                                             const InitialParticles& initial,
                                                             const std::vector<int>& ids,
                                                             const std::vector<int>& where) {
  std::vector<int> begin;
  begin.reserve(ids.size());
  for (const int id : ids) {
    begin.push_back(static_cast<int>(places_at_clamp_.size()));
    for (int b = bonds.begin[id]; b < bonds.begin[id + 1]; ++b) {
      if (!initial.held[bonds.j[b]] || seen_from(bonds, bonds.j[b], id) >= 0) continue;
      Point x = initial.x[id];
      for (int k = 0; k < Dim; ++k) x[k] += bonds.of(id, b).X[k];
      x = displaced(scene.bodies[initial.body[id]], x);
      PlaceAtClamp& place = places_at_clamp_.emplace_back();
      for (int k = 0; k < Dim; ++k) place.x[k] = x[k];
      place.behind = where[bonds.j[b]];
    }
  }
  return begin;
}

template <int Dim, class Kept>
PackedBonds<Dim, Kept>::PackedBonds(const Bonds& bonds, const Scene& scene, const InitialParticles& initial,
                                    const std::vector<Elasticity>& materials, const std::vector<int>& ids,
                                    int threads) {
  const int n = static_cast<int>(ids.size()), groups = (n + lanes - 1) / lanes, size = groups * lanes;
  std::vector<int> where(ids.size());
  for (int i = 0; i < n; ++i) where[ids[i]] = i;
  const std::vector<int> at_clamp = add_places_at_clamp(bonds, scene, initial, ids, where);
  const auto make = [&](int group) {
    const int first = lanes * group;
    Four with_area, others;
    for (int lane = 0; lane < lanes && first + lane < n; ++lane) {
      const int id = ids[first + lane];
      int place = size + at_clamp[first + lane];
      with_area[lane].reserve(bonds.begin[id + 1] - bonds.begin[id]);
      for (int b = bonds.begin[id]; b < bonds.begin[id + 1]; ++b) {
        const taut::Bond& own = bonds.of(id, b);
        Bond bond{where[bonds.j[b]], 0, 0, 0, own.area};
        for (int d = 0; d < Dim; ++d) bond.r2 += own.X[d] * own.X[d];
        const int back = seen_from(bonds, bonds.j[b], id);
        if (back < 0) bond.j = place++;
        // a place at a clamp has no energy of its own
        const double G = bond_modulus<Dim>(bonds, initial, materials, id, b),
                     w_ji = back < 0 ? 0 : bonds.of(bonds.j[b], back).weight;
        bond.scale = G * initial.V0[id] * own.weight;
        bond.k = (bond.scale + G * initial.V0[bonds.j[b]] * w_ji) / bond.r2;  // the same bits from both ends
        (own.area != Point{} ? with_area : others)[lane].push_back(bond);
      }
      std::ranges::sort(with_area[lane], {}, &Bond::j);
      std::ranges::sort(others[lane], {}, &Bond::j);
    }
    Packed packed;
    packed.append(group, with_area, size);
    const std::size_t a_count = packed.slots.size();
    packed.append(group, others, size);
    packed.areas.resize(a_count);
    packed.hash = {slots_.hash_of(packed.slots), springs_.hash_of(packed.springs),
                   energy_scales_.hash_of(packed.scales), a_ij_.hash_of(packed.areas)};
    return packed;
  };
  groups_.reserve(groups);
  slots_ = SharedRows<LaneSlot>(groups), springs_ = SharedRows<Spring<Kept>>(groups);
  a_ij_ = SharedRows<Vec<Kept, Dim>>(groups), energy_scales_ = SharedRows<Kept>(groups);
  make_in_order(groups, threads, make, [&](int, const Packed& packed) {
    groups_.push_back({slots_.add(packed.slots, packed.hash.slots), static_cast<int>(packed.slots.size()),
                       springs_.add(packed.springs, packed.hash.springs),
                       energy_scales_.add(packed.scales, packed.hash.scales),
                       a_ij_.add(packed.areas, packed.hash.areas), static_cast<int>(packed.areas.size())});
    bonds_to_clamp_.insert(bonds_to_clamp_.end(), packed.to_clamp.begin(), packed.to_clamp.end());
  });
  slots_.close(), springs_.close(), a_ij_.close(), energy_scales_.close();
}

template <int Dim, class Kept>
void PackedBonds<Dim, Kept>::Packed::append(int group, const Four& bonds, int size) {
  std::array<std::vector<int>, lanes> neighbors;
  for (int lane = 0; lane < lanes; ++lane) {
    neighbors[lane].reserve(bonds[lane].size());
    for (const Bond& bond : bonds[lane]) neighbors[lane].push_back(bond.j);
  }
  const LaneSlots found = lane_slots(lanes * group, neighbors, size);
  for (std::size_t b = 0; b < found.slots.size(); ++b) {
    slots.push_back(found.slots[b]);
    Pack third_of_k{}, per_r0_squared{}, half_r0_squared{}, scale{};
    Vec<Pack, Dim> area{};
    for (int lane = 0; lane < lanes; ++lane) {
      if (found.taken[b][lane] < 0) continue;
      const Bond& bond = bonds[lane][found.taken[b][lane]];
      if (bond.j >= size) to_clamp.push_back({group, lane, static_cast<int>(springs.size()), bond.j - size});
      third_of_k[lane] = bond.k / 3;
      per_r0_squared[lane] = 1 / bond.r2;
      half_r0_squared[lane] = 0.5 * bond.r2;
      scale[lane] = bond.scale;
      for (int k = 0; k < Dim; ++k) area[k][lane] = bond.a[k];
    }
    springs.push_back(Spring<Kept>::of(third_of_k, per_r0_squared, half_r0_squared));
    pack_into(scales.emplace_back(), scale);
    Vec<Kept, Dim>& kept = areas.emplace_back();
    for (int k = 0; k < Dim; ++k) pack_into(kept[k], area[k]);
  }
}

}  // namespace taut::inline TAUT_ISA
