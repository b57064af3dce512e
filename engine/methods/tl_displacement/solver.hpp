#pragma once

#include "engine/methods/tl_displacement/kernels.hpp"
#include "engine/solver/initial_configuration.hpp"
#include "engine/solver/scheme.hpp"

namespace taut {

/// Computes F from positions, [Lee2016] Eq. 34. Position Verlet, [Zhang2020] Eq. 10, 11, with forces at mid-step.
template <int Dim>
class TlDisplacement final : public Scheme<Dim> {
 public:
  using V = Vec<double, Dim>;
  using Kernels = TlDisplacementKernels<Dim>;

  TlDisplacement(Common<Dim>& common, const SolverInput& input, const Kernels& kernels);

  double step_size() const override { return body_.step_size(); }
  void step(double dt) override;
  void show(Snapshot& out, std::span<const int> groups) const override;
  bool show_motion(Snapshot& out) const override;
  V contact_force(const Probe& probe, double dt) const override { return common_.contact_force(probe, dt); }
  void save(Saver&) override {}
  void load(Loader&) override {}

 private:
  using Bonds = PairLanes<Dim, Dim + 2>;
  Bonds make_bonds(const SolverInput& input, PairForce force, double alpha) const;
  template <class Take>
  void with_strains(std::span<const int> groups, const Take& take) const;

  const Kernels& kernels_;
  Common<Dim>& common_;
  Particles<Dim>& p_;
  InitialConfiguration<Dim> body_;
  PairLanes<Dim> pair_lanes_;
  Columns<Dim> displacement_;
  Columns<Dim * Dim> stress_;
  Bonds bonds_;
  Columns<Dim * Dim> F_;
  Columns<Dim> velocity_;
  Columns<1> viscosity_, shear_;
  TlDisplacementFields<Dim> f_;
};

}  // namespace taut
