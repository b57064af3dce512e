#pragma once

#include <vector>

#include "engine/methods/ul_split/kernels.hpp"
#include "engine/neighbors/neighbors.hpp"
#include "engine/solver/scheme.hpp"

namespace taut {

/// Methods of [Zhang2024], [Zhang2024b] and [SPHinXsys2025] with the position Verlet scheme of [Zhang2024] §5.
template <int Dim>
class UlSplit final : public Scheme<Dim> {
 public:
  using V = Vec<double, Dim>;
  using S = Sym<double, Dim>;
  using Kernels = UlSplitKernels<Dim>;

  UlSplit(Common<Dim>& common, const SolverInput& input, const Kernels& kernels);

  double step_size() const override;
  void step(double dt) override;
  void show(Snapshot& out, std::span<const int> groups) const override;
  V contact_force(const Probe& probe, double dt) const override;
  void save(Saver& saver) override { serialize(saver); }
  void load(Loader& loader) override { serialize(loader); }

 private:
  void rebuild();
  void cache_pairs();
  void list_mixed_packs();
  void accelerate(double dt);
  void close_rates(double dt);
  std::vector<FlowRow<Dim>> displacements() const;
  int packs() const { return near_.begin.back(); }
  void bind_fields();
  template <class Archive>
  void serialize(Archive& archive);

  const Kernels& kernels_;
  const UlSplitFormulation& method_;
  Common<Dim>& common_;
  Particles<Dim>& p_;
  UlSplitConstants c_;
  Stepping stepping_;
  CellGrid<Dim> grid_;
  NeighborSearch<Dim> search_;
  Neighbors near_;
  double greatest_speed_ = 0;          // since the start, m/s
  double distance_since_rebuild_ = 0;  // m

  // see UlSplitFields
  std::vector<double> rho_, drho_;
  std::vector<V> a_shear_, da_shear_;
  std::vector<S> s_, ds_;
  // positions at the last stress recovery, m
  std::vector<V> x_recovered_;
  std::vector<FlowRow<Dim>> flow_, flow_new_;
  std::vector<TensorRow<Dim>> stress_, repulsion_, recovery_;
  std::vector<GradientRow<Dim>> velocity_gradient_;
  std::vector<int> has_foreign_neighbors_;
  using Stored = typename PairCache<Dim>::Stored;
  std::vector<Stored> gradients_, inverse_slopes_, inverse_distances_, closeness_;
  bool sph_contact_;
  double kernel_steepness_ = 1, kernel_length_ = 1;  // see PairCache
  std::vector<MixedPack> mixed_;                     // for sph_contact_
  UlSplitFields<Dim> f_{};
};

}  // namespace taut
