#pragma once

#include <cstddef>
#include <vector>

#include "engine/methods/ul_cauchy/kernels.hpp"
#include "engine/neighbors/neighbors.hpp"
#include "engine/solver/scheme.hpp"

namespace taut {

/// Methods of [Khayyer2024] and [TranDuc2023] §2.2. Neighbour lists are valid until a particle has moved half a skin
/// relative to its body's rigid motion.
template <int Dim>
class UlCauchy final : public Scheme<Dim> {
 public:
  using V = Vec<double, Dim>;
  using S = Sym<double, Dim>;
  using Kernels = UlCauchyKernels<Dim>;

  UlCauchy(Common<Dim>& common, const SolverInput& input, const Kernels& kernels);

  double step_size() const override;
  void step(double dt) override;
  void show(Snapshot& out, std::span<const int> groups) const override;
  V contact_force(const Probe& probe, double dt) const override { return common_.contact_force(probe, dt); }
  void save(Saver& saver) override { serialize(saver); }
  void load(Loader& loader) override { serialize(loader); }

 private:
  /// In spacings.
  static constexpr double skin = 0.25;
  struct alignas(64) CacheLine {
    double c[8];
  };

  const Elasticity& material(int i) const { return materials_[p_.material[i]]; }
  void refuse_contact_forces(const Scene& scene) const;
  void rebuild();
  void show_neighbors_to_probes();
  void mark_materials();
  void set_motion();
  void set_rigid_motion();
  void accelerate(double dt);
  void transport(double dt);
  void bind_fields();
  template <class Archive>
  void serialize(Archive& archive);

  const Kernels& kernels_;
  const UlCauchyFormulation& method_;
  Common<Dim>& common_;
  Particles<Dim>& p_;
  UlCauchyConstants c_;
  std::vector<Elasticity> materials_;
  bool several_materials_ = false;
  bool sph_contact_;  // bodies interact as one
  CellGrid<Dim> grid_;
  NeighborSearch<Dim> search_;

  // see UlCauchyFields
  std::vector<double> rho_, drho_;
  std::vector<S> s_;
  std::vector<MotionRow<Dim>> motion_, moved_, transported_;
  std::vector<CacheLine> stress_;
  std::vector<RepulsionRow<Dim>> repulsion_;
  Neighbors near_;
  std::vector<AlignedPack> w_, of_one_material_;
  // rigid motion at the last search; 0 under sph_contact_
  std::vector<V> drift_;
  std::vector<Spin<Dim>> spin_;
  std::vector<V> centre_;         // centre of mass, moved by drift_, m
  double relative_distance_ = 0;  // bound of the distance from the rigid motion, m
  UlCauchyFields<Dim> f_{};
};

}  // namespace taut
