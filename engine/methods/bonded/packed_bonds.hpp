#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "engine/core/parallel.hpp"
#include "engine/core/shared_rows.hpp"
#include "engine/core/tensor.hpp"
#include "engine/methods/bonded/layout/setup.hpp"
#include "engine/neighbors/lane_neighbors.hpp"

namespace taut {

/// Constants of four bonds; 0 in padding.
template <class Storage>
struct alignas(sizeof(Pack)) Spring {
  Pack third_of_k;  // N/m
  Pack per_r0_squared;
  Pack half_r0_squared;  // m²

  static Spring of(const Pack& third_of_k, const Pack& per_r0_squared, const Pack& half_r0_squared) {
    return {third_of_k, per_r0_squared, half_r0_squared};
  }
  Pack third() const { return third_of_k; }
  Pack per_r02() const { return per_r0_squared; }
  /// 1/(2s), s = r²/r0².
  Pack half_inverse(const Pack& r2) const { return half_r0_squared / r2; }
};

/// 1/r0² stays in double precision, so that bonds at rest have no force.
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

struct BondToClamp {
  int group, lane, bond, place;
};

/// Bonds of groups of four particles: first bonds with a_ij ≠ 0, then the others, each part in storage order.
template <int Dim, class Storage>
struct PackedBondsView {
  struct GroupRows {  // first indices, numbers of slots
    int slot, count, spring, scale;
    int a, a_count;
  };

  const GroupRows* groups = nullptr;
  const LaneSlot* all_slots = nullptr;
  const Spring<Storage>* all_springs = nullptr;
  const Vec<Storage, Dim>* all_a_ij = nullptr;
  const Storage* all_energy_scales = nullptr;

  const GroupRows& of(int group) const { return groups[group]; }
  const LaneSlot* slots(const GroupRows& own) const { return all_slots + own.slot; }
  const Spring<Storage>* springs(const GroupRows& own) const { return all_springs + own.spring; }
  const Vec<Storage, Dim>* a_ij(const GroupRows& own) const { return all_a_ij + own.a; }
  /// G V0_i w_ij, J.
  const Storage* energy_scales(const GroupRows& own) const { return all_energy_scales + own.scale; }
};

template <int Dim, class Storage>
class PackedBonds {
 public:
  using View = PackedBondsView<Dim, Storage>;

  PackedBonds() = default;
  /// `ids` is in storage order.
  PackedBonds(const BondedSetup& setup, const std::vector<int>& ids, int threads = 1);

  View view() const {
    return {groups_.data(), slots_.from(0), springs_.from(0), a_ij_.from(0), energy_scales_.from(0)};
  }
  const std::vector<BondToClamp>& bonds_to_clamp() const { return bonds_to_clamp_; }

 private:
  struct LaneBond : BondConstants {};  // j is a stored index
  using BondsOfFour = std::array<std::vector<LaneBond>, lanes>;
  struct PackedGroup {
    std::vector<LaneSlot> slots;
    std::vector<Spring<Storage>> springs;
    std::vector<Storage> scales;
    std::vector<Vec<Storage, Dim>> areas;
    std::vector<BondToClamp> to_clamp;
    struct {
      std::size_t slots, springs, scales, areas;
    } hash;

    void append(int group, const BondsOfFour& bonds, int size);
  };

  std::vector<typename View::GroupRows> groups_;
  SharedRows<LaneSlot> slots_;
  SharedRows<Spring<Storage>> springs_;
  SharedRows<Vec<Storage, Dim>> a_ij_;  // up to a factor that B removes
  SharedRows<Storage> energy_scales_;
  std::vector<BondToClamp> bonds_to_clamp_;
};

inline std::vector<int> stored_places(const std::vector<int>& ids) {
  std::vector<int> where(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) where[ids[i]] = static_cast<int>(i);
  return where;
}

/// Clamp places are stored after all groups.
template <int Dim, class Storage>
PackedBonds<Dim, Storage>::PackedBonds(const BondedSetup& setup, const std::vector<int>& ids, int threads) {
  const int n = static_cast<int>(ids.size()), groups = (n + lanes - 1) / lanes, size = groups * lanes;
  const std::vector<int> where = stored_places(ids);
  const auto make = [&](int group) {
    const int first = lanes * group;
    BondsOfFour with_area, others;
    for (int lane = 0; lane < lanes && first + lane < n; ++lane) {
      for (BondConstants bond : setup.bond_constants(ids[first + lane])) {
        bond.j = bond.j < 0 ? size - 1 - bond.j : where[bond.j];
        (bond.area != Point{} ? with_area : others)[lane].push_back({bond});
      }
      std::ranges::sort(with_area[lane], {}, &LaneBond::j);
      std::ranges::sort(others[lane], {}, &LaneBond::j);
    }
    PackedGroup packed;
    packed.append(group, with_area, size);
    const std::size_t a_count = packed.slots.size();
    packed.append(group, others, size);
    packed.areas.resize(a_count);
    packed.hash = {slots_.hash_of(packed.slots), springs_.hash_of(packed.springs),
                   energy_scales_.hash_of(packed.scales), a_ij_.hash_of(packed.areas)};
    return packed;
  };
  groups_.reserve(groups);
  slots_ = SharedRows<LaneSlot>(groups), springs_ = SharedRows<Spring<Storage>>(groups);
  a_ij_ = SharedRows<Vec<Storage, Dim>>(groups), energy_scales_ = SharedRows<Storage>(groups);
  make_in_order(groups, threads, make, [&](int, const PackedGroup& packed) {
    groups_.push_back({slots_.add(packed.slots, packed.hash.slots), static_cast<int>(packed.slots.size()),
                       springs_.add(packed.springs, packed.hash.springs),
                       energy_scales_.add(packed.scales, packed.hash.scales),
                       a_ij_.add(packed.areas, packed.hash.areas), static_cast<int>(packed.areas.size())});
    bonds_to_clamp_.insert(bonds_to_clamp_.end(), packed.to_clamp.begin(), packed.to_clamp.end());
  });
  slots_.close(), springs_.close(), a_ij_.close(), energy_scales_.close();
}

template <int Dim, class Storage>
void PackedBonds<Dim, Storage>::PackedGroup::append(int group, const BondsOfFour& bonds, int size) {
  std::array<std::vector<int>, lanes> neighbors;
  for (int lane = 0; lane < lanes; ++lane)
    for (const LaneBond& bond : bonds[lane]) neighbors[lane].push_back(bond.j);
  const LaneSlots found = lane_slots(lanes * group, neighbors, size);
  for (std::size_t b = 0; b < found.slots.size(); ++b) {
    slots.push_back(found.slots[b]);
    Pack third_of_k{}, per_r0_squared{}, half_r0_squared{}, scale{};
    Vec<Pack, Dim> area{};
    for (int lane = 0; lane < lanes; ++lane) {
      if (found.taken[b][lane] < 0) continue;
      const LaneBond& bond = bonds[lane][found.taken[b][lane]];
      if (bond.j >= size) to_clamp.push_back({group, lane, static_cast<int>(springs.size()), bond.j - size});
      third_of_k[lane] = bond.k / 3;
      per_r0_squared[lane] = 1 / bond.r2;
      half_r0_squared[lane] = 0.5 * bond.r2;
      scale[lane] = bond.energy;
      for (int k = 0; k < Dim; ++k) area[k][lane] = bond.area[k];
    }
    springs.push_back(Spring<Storage>::of(third_of_k, per_r0_squared, half_r0_squared));
    pack_into(scales.emplace_back(), scale);
    Vec<Storage, Dim>& stored = areas.emplace_back();
    for (int k = 0; k < Dim; ++k) pack_into(stored[k], area[k]);
  }
}

}  // namespace taut
