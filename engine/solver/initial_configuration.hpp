#pragma once

#include <vector>

#include "engine/materials/chosen_laws.hpp"
#include "engine/solver/common.hpp"
#include "engine/solver/initial_pairs.hpp"
#include "engine/solver/sites.hpp"

namespace taut {

/// Departs from the papers, which place particles on the boundary: the outermost particles lie half a spacing inside
/// the face unless Body::on_boundary is set.
template <int Dim>
class InitialConfiguration {
 public:
  using V = Vec<double, Dim>;

  /// Moves particles to their start. `normalised`: `share` in gradient_correction. `corrected_forces`: forces as in
  /// internal_force_info, otherwise as in pair_shear_force. Throws SceneError if a body is too thin.
  InitialConfiguration(Common<Dim>& common, const SolverInput& input,
                       GradientCorrection gradient = GradientCorrection::corrected, double normalised = 0,
                       bool corrected_forces = true);

  std::vector<V> X;        // m
  std::vector<double> V0;  // m^Dim
  InitialPairs<Dim> pairs;
  std::vector<Sites<Dim>> sites;
  std::vector<int> material;
  Materials materials;
  double wave_speed = 0;  // greatest c_p = √((K + 4G/3)/ρ0), m/s

  int groups() const { return static_cast<int>(sites.size()); }
  LawsInUse laws() const { return materials.in_use(); }
  /// Time step from CFL h/(c_p + |v|max), s. Departs from [Lee2016] Eq. 44, which uses the spacing and the wave speed
  /// of the strained body.
  double step_size() const;
  static void begin(Snapshot& out) { out.strain_energy.resize(out.size()); }
  void begin_motion(Snapshot& out) const { common_.begin_motion(out), begin(out); }
  void store_motion(Snapshot& out, int i, const Mat<double, Dim>& F, double J) const;
  void store(Snapshot& out, int i, const Mat<double, Dim>& F, double J) const;

 private:
  void check_pairs(const Scene& scene, const Formulation& method) const;
  std::vector<Point> surface(bool corrected_forces) const;

  Common<Dim>& common_;
};

/// In m.
double initial_support(const SolverInput& input);

constexpr MethodConstant smoothing_length(const Formulation& m, int dim, double least) {
  const double h = dim == 3 && m.h_over_dp_3d > 0 ? m.h_over_dp_3d : m.h_over_dp;
  return {"h", h, least, 3.0, "smoothing length over the spacing", true, true};
}

}  // namespace taut
