#pragma once

#include <type_traits>
#include <variant>
#include <vector>

#include "engine/core/shared_rows.hpp"
#include "engine/methods/bonded/clamps.hpp"
#include "engine/methods/bonded/half_cells.hpp"
#include "engine/methods/bonded/interface_sites.hpp"
#include "engine/methods/bonded/kernels.hpp"
#include "engine/methods/bonded/layout/recovered_gradient.hpp"
#include "engine/methods/bonded/layout/setup.hpp"
#include "engine/solver/scheme.hpp"

namespace taut {

template <int Dim, class Storage>
struct StoredBonds {
  PackedBonds<Dim, Storage> packed;
  CancelledBonds<Dim, Storage> cancelled;

  BondsView<Dim, Storage> view() const { return {packed.view(), cancelled.view()}; }
};

/// Bodies of bonds (THEORY.md) with position Verlet.
template <int Dim>
class Bonded final : public Scheme<Dim> {
 public:
  using V = Vec<double, Dim>;
  using Kernels = BondedKernels<Dim>;

  Bonded(Common<Dim>& common, const SolverInput& input, const Kernels& kernels)
      : Bonded(common, input, kernels, make_bonded_setup(input, damping_of(input))) {}

  double step_size() const override;
  void step(double dt) override;
  void show(Snapshot& out, std::span<const int> groups) const override;
  bool show_motion(Snapshot& out) const override;
  V contact_force(const Probe& probe, double dt) const override { return common_.contact_force(probe, dt); }
  void save(Saver& saver) override { saver(stiffest_); }
  void load(Loader& loader) override { loader(stiffest_); }

 private:
  using AnyBonds =
      std::conditional_t<Dim == 2, std::variant<StoredBonds<Dim, AlignedPack>>,
                         std::variant<StoredBonds<Dim, AlignedPack>, StoredBonds<Dim, HalfPack>>>;

  Bonded(Common<Dim>& common, const SolverInput& input, const Kernels& kernels, const BondedSetup& setup);
  static double damping_of(const SolverInput& input);
  AnyBonds stored(const BondedSetup& setup) const;
  void add_group_constants(const Bonds& bonds);
  void make_columns(const BondedSetup& setup);
  void bind_fields();
  void find_layout_frequency();
  void pull_at_clamps();
  void renew_recovered() const;
  BondedFields<Dim> fields_now(Columns<2 * Dim>& places) const;
  int group_count() const { return (p_.size() + lanes - 1) / lanes; }
  LawOfOne law_of_one() const { return {materials_, uses_group_law_, laws_}; }
  /// Energy of particle i that the kernels leave out (interfaces, half cells), J.
  double energy_change(int i) const {
    return interfaces_.energy_of_kink(i, p_.x, law_of_one()) +
           half_cells_.energy_change(i, p_.x, law_of_one());
  }

  const Kernels& kernels_;
  Common<Dim>& common_;
  Particles<Dim>& p_;
  const Constants& c_;
  std::vector<Elasticity> materials_;
  bool uses_group_law_;
  Materials laws_;
  std::vector<int> material_;  // [stored], padded to whole groups
  Constraints constraints_;    // [id]
  double wave_speed_;          // m/s
  double layout_ = 1;          // highest ω² at the start over the highest ω² of a lattice, at least 1
  double stiffest_ = 1;        // in the last step, relative to rest
  SharedRows<GroupLaw> group_laws_;
  SharedRows<Mat<Pack, Dim>> B_;
  std::vector<GroupRows> groups_;
  AnyBonds bonds_;
  InterfaceSites<Dim> interfaces_;
  HalfCells<Dim> half_cells_;
  Clamps<Dim> clamps_;
  Columns<2 * Dim> places_;
  Columns<Dim * Dim> Q_;
  Columns<1> mobility_;
  std::vector<Vec<Pack, Dim>> bond_force_;
  BondedFields<Dim> f_{};
  // renewed after a drive ends
  mutable RecoveredGradient recovered_;
  mutable long released_ = 0;  // particles whose drives have ended
};

}  // namespace taut
