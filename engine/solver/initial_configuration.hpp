#pragma once

#include <vector>

#include "engine/materials/chosen_laws.hpp"
#include "engine/solver/common.hpp"
#include "engine/solver/initial_pairs.hpp"
#include "engine/solver/sites.hpp"

namespace taut {

/// The initial configuration of total-Lagrangian methods: bodies whose particles act on their initial neighbours
/// through a law of elasticity.
/// The papers put particles on the boundary; here they are in the middle of cells unless the body says so
/// (Body::on_boundary): the outermost stand half a spacing inside the face.
template <int Dim>
class InitialConfiguration {
 public:
  using V = Vec<double, Dim>;

  /// Puts the particles where they start, and lets loads act on faces. Throws SceneError for a
  /// body that is too thin. `normalised`: see TlDisplacementConstants.
  InitialConfiguration(Common<Dim>& common, const SolverInput& input,
                       GradientCorrection gradient = GradientCorrection::corrected, double normalised = 0);

  std::vector<V> X;        // m
  std::vector<double> V0;  // m^Dim
  InitialPairs<Dim> pairs;
  std::vector<Sites<Dim>> sites;
  std::vector<int> material;  // with the filling of the last group
  Materials materials;
  double wave_speed = 0;  // c_p = √((K + 4G/3)/ρ0), the greatest of all materials, m/s

  int groups() const { return static_cast<int>(sites.size()); }
  LawsInUse laws() const { return materials.in_use(); }
  /// CFL h/(c_p + |v|max), s. [Lee2016] Eq. 44 has the spacing for h and waits for the wave in the strained body; |v|max
  /// stands for how fast it is being strained.
  double step_size() const;
  /// Adds the strain energies of particles to a snapshot that has begun.
  static void begin(Snapshot& out) { out.strain_energy.resize(out.size()); }
  void begin_motion(Snapshot& out) const { common_.begin_motion(out), begin(out); }
  /// Stores motion and strain energy only.
  void store_motion(Snapshot& out, int i, const Mat<double, Dim>& F, double J) const;
  /// A particle with the deformation F and the volume ratio J that its stress comes from.
  void store(Snapshot& out, int i, const Mat<double, Dim>& F, double J) const;

 private:
  void check_pairs(const Scene& scene, const Formulation& method) const;
  std::vector<Point> surface() const;

  Common<Dim>& common_;
};

/// Radius of interaction of a total-Lagrangian method, m.
double initial_support(const SolverInput& input);

/// The constant h of these methods.
constexpr MethodConstant smoothing_length(const Formulation& m, int dim, double least) {
  const double h = dim == 3 && m.h_over_dp_3d > 0 ? m.h_over_dp_3d : m.h_over_dp;
  return {"h", h, least, 3.0, "smoothing length over the spacing", true, true};
}

}  // namespace taut
