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

/// Mixed total-Lagrangian methods: momentum, deformation gradient F and, where the method says so, volume
/// ratio J and cofactor H of F as unknowns of equations of their own, with Jameson–Schmidt–Turkel
/// dissipation. [Lee2016] Algorithm 1. The momentum goes as the velocity p/ρ0. In plane strain H is linear in
/// F, and its equation says nothing that that of F does not: there {p, F, H, J} runs as {p, F, J}.
///
/// Differs from the paper in the biharmonic term, L*[L[U]] with the adjoint of L in place of L[L[U]] (Eq.
/// 37b). L is not symmetric at a surface, where its square may feed what it is to damp: with it `pfj-jst`
/// loses the bending column at Poisson's ratio 0.499 for ε of J from 1/32 on, at any time step. The adjoint
/// takes from every field (−Σ V |L[U]|²) and is the same inside. The constant `adjoint` = 0 gives the printed
/// form. Boundary conditions are set on the particles themselves (its step 8), and where the kernel looks
/// (step 9, "usually disregarded") with `boundary_projection` = 1. Forces of contact, which it has not, act
/// outside the projection and are taken at its Z, about which central forces have no moment; so do loads. Of
/// the dissipation and the internal force the sum is projected, which is the same as each of them (Eq. 49).
///
/// Its two stages share a step, so that external actions come as StageActions and not as a whole Kick.
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
  /// Owner of Strains.
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
  [[noreturn]] void crushed() const;
  void find_rates(double dt);
  void project_on_boundary(double ahead);
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
  double dissipation_limit_ = std::numeric_limits<double>::infinity();  // s, of the step
  PrescribedBoundary<Kernel<KernelName::wendland_c2>, Dim> boundary_;
  TlMixedFields<Dim> f_{};  // pointers to all of these
};

}  // namespace taut
