#pragma once

#include <stdexcept>

#include "tests/references/mesh.hpp"

namespace references {

/// Elastic body of spectral elements: total Lagrangian, mass lumped at the nodes, stress at Gauss points, velocity
/// Verlet without damping. Per metre of depth in 2D. SI units.
template <int d>
class Solid {
 public:
  using Field = std::function<Vector<d>(const Vector<d>&)>;

  /// Components for which `fixed` is not 0 keep their initial `velocity`.
  Solid(Mesh<d> mesh, const Material& material, const Field& velocity, const Field& fixed);

  /// Keeps the nodes `contact` at x <= 0: a node that would pass the plane stops there.
  void add_contact(std::vector<int> contact) { contact_ = std::move(contact); }

  /// Advances to `time` in equal steps of at most `courant` times the transit time of a wave between two nodes.
  void advance(double time, double courant);

  /// Node at the initial position `x`; throws if there is none.
  int node_at(const Vector<d>& x) const;
  Vector<d> displacement(int node) const { return displacements_[node]; }
  Vector<d> position(int node) const;
  Vector<d> mean_velocity() const;
  const std::vector<Vector<d>>& nodes() const { return mesh_.nodes; }
  double energy() const;  ///< kinetic and strain energy, J
  double time() const { return time_; }

 private:
  static constexpr int points = points_per_element<d>;
  using Values = std::array<Lanes, points>;
  /// Copies of an element, with weight 0, fill the last batch.
  struct Batch {
    std::array<std::array<int, lanes>, points> nodes;
    std::array<std::array<Values, d>, d> inverse;  ///< ∂ξ_a/∂X_b at Gauss points: [a][b]
    Values volume;                                 ///< of each Gauss point
  };

  void prepare();
  void add_forces(const Batch& batch);
  void update_forces();
  void step(double dt);

  Mesh<d> mesh_;
  Material material_;
  std::vector<Batch> batches_;
  std::vector<Vector<d>> displacements_, velocities_, forces_, inverse_masses_;
  std::vector<double> masses_;
  std::vector<int> contact_;
  double time_ = 0, strain_energy_ = 0, transit_time_ = 0;
  Rule lobatto_ = gauss_lobatto(), gauss_ = gauss();
  Matrix to_gauss_ = interpolation(lobatto_.points, gauss_.points), from_gauss_ = transposed(to_gauss_),
         derivative_ = derivative(gauss_.points), divergence_ = transposed(derivative_);
};

}  // namespace references
