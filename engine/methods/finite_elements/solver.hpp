#pragma once

#include <vector>

#include "engine/materials/chosen_laws.hpp"
#include "engine/methods/finite_elements/kernels.hpp"
#include "engine/solver/scheme.hpp"

namespace taut {

/// Total-Lagrangian finite elements with lumped masses. Position Verlet with forces at mid-step.
template <int Dim>
class FiniteElements final : public Scheme<Dim> {
 public:
  using V = Vec<double, Dim>;
  using Kernels = FiniteElementKernels<Dim>;

  FiniteElements(Common<Dim>& common, const SolverInput& input, const Kernels& kernels);

  double step_size() const override;
  void step(double dt) override;
  void show(Snapshot& out, std::span<const int> groups) const override;
  bool show_motion(Snapshot& out) const override;
  V contact_force(const Probe& probe, double dt) const override { return common_.contact_force(probe, dt); }
  void save(Saver& saver) override { saver(rate_); }
  void load(Loader& loader) override { loader(rate_); }

 private:
  template <int n>
  void set_up(const SolverInput& input);
  template <class Take>
  void with_strains(const std::vector<int>& groups, const Take& take) const;
  std::vector<int> element_groups(std::span<const int> of_nodes) const;
  void set_contact_rate(const SolverInput& input);
  [[noreturn]] void throw_crushed() const;
  void update_rate();

  const Kernels& kernels_;
  Common<Dim>& common_;
  Particles<Dim>& p_;
  const ElementMesh& mesh_;
  Materials materials_;
  std::vector<V> X_, u_;
  std::vector<int> node_, material_;
  // std::vector<Pack> would misalign packs without AVX
  std::vector<Vec<Pack, 1>> points_;  // memory of ElementPoint structs
  std::vector<Vec<Pack, 1>> rates_;   // [group]
  std::vector<double> force_;
  std::vector<int> begin_, slot_;
  std::vector<Vec<Pack, 1>> mobility_;
  FiniteElementFields<Dim> f_;
  double rate_ = 0, first_rate_ = 0, contact_rate_ = 0;  // greatest squared frequencies, 1/s²
};

}  // namespace taut
