#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "engine/kernels/kernel.hpp"
#include "engine/methods/tl_mixed/corrected_laplacian.hpp"
#include "engine/methods/tl_mixed/kernels.hpp"
#include "engine/methods/tl_mixed/prescribed_boundary.hpp"
#include "engine/solver/initial_configuration.hpp"
#include "engine/solver/scheme.hpp"

namespace taut {

/// [Lee2016] Algorithm 1. Momentum is stored as the velocity p/ρ0. Departures: L*[L[U]] with `adjoint` = 1, because
/// L[L[U]] (Eq. 37b) can add energy at surfaces; either step 8, or with `boundary_projection` = 1
/// step 9 (THEORY.md). Contact and loads are not projected (Eq. 49).
template <int Dim>
class TlMixed final : public Scheme<Dim> {
 public:
  using V = Vec<double, Dim>;
  using Kernels = TlMixedKernels<Dim>;

  TlMixed(Common<Dim>& common, const SolverInput& input, const Kernels& kernels);

  double step_size() const override;
  void step(double dt) override;
  void show(Snapshot& out, std::span<const int> groups) const override;
  bool show_motion(Snapshot& out) const override;
  V contact_force(const Probe& probe, double dt) const override { return common_.contact_force(probe, dt); }
  void save(Saver& saver) override { serialize(saver); }
  void load(Loader& loader) override { serialize(loader); }

 private:
  template <class Take>
  void with_strains(int group, const Take& take) const;
  struct StrainArrays {
    std::vector<Mat<Pack, Dim>> F, H;
    std::vector<AlignedPack> J;

    Strains<Dim> view() { return {F.data(), J.data(), H.data()}; }
  };

  int groups() const { return body_.groups(); }
  void make_pairs(const SolverInput& input);
  void make_strains();
  void set_start_gradients();
  double greatest_step_of_dissipation(int threads) const;
  [[noreturn]] void throw_crushed() const;
  void find_rates(double dt);
  template <class Use>
  void project_on_boundary(const Use& use);
  void close_on_boundary(double dt);
  void stop_approach(double dt);
  StageActions<Dim> actions();
  template <class Archive>
  void serialize(Archive& archive);

  const Kernels& kernels_;
  const TlMixedFormulation& method_;
  Common<Dim>& common_;
  Particles<Dim>& p_;
  TlMixedConstants c_;
  InitialConfiguration<Dim> body_;

  // see TlMixedFields
  PairLanes<Dim> pair_lanes_;
  LaplacianLanes<Dim> dissipating_lanes_;
  StrainArrays now_, start_, rate_;
  std::vector<V> v_start_;
  Columns<Dim + 1> flow_, once_;
  Columns<Dim * Dim> stress_;
  Columns<Dim> a_, a_start_;
  Columns<1> dissipation_J_;
  double dissipation_limit_ = std::numeric_limits<double>::infinity();  // s
  PrescribedBoundary<Kernel<KernelName::wendland_c2>, Dim> boundary_;
  TlMixedFields<Dim> f_{};
};

}  // namespace taut
