#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/materials/laws.hpp"
#include "engine/solver/initial_pairs.hpp"
#include "engine/solver/particle_solver.hpp"

namespace taut::inline TAUT_ISA {

/// What the solvers of total-Lagrangian methods share: bodies whose particles act on their neighbours of the
/// start through a law of elasticity, and on other bodies by contact. A solver adds what it integrates.
/// The papers put particles on the boundary; here they are in the middle of cells, as in every method of this
/// program: the outermost stand half a spacing inside the face.
template <const Formulation& M, int Dim>
class InitialPairSolver : public ParticleSolver<Dim> {
 protected:
  using Base = ParticleSolver<Dim>;
  using Base::c_, Base::s_, Base::contact_, Base::drives_, Base::loads_, Base::initial_, Base::threads_now,
      Base::vmax_;
  using typename Base::V;
  using Mat = taut::Mat<double, Dim>;

  explicit InitialPairSolver(const SolverInput& input);

  /// CFL h/(c_p + |v|max) with the fastest wave, c_p = √((K + 4G/3)/ρ0), s. [Lee2016] Eq. 44 has the spacing
  /// for h and waits for the wave in the strained body; |v|max stands for how fast it is being strained.
  double step_size() const { return this->fixed_or(c_.cfl * c_.h / (c_p_ + vmax_)); }
  double wave_speed() const { return c_p_; }  // c_p, the greatest of all materials, m/s

  const LawOf<M.law>& law(int i) const { return laws_[material_[i]]; }

  void show_contacts_to_probes() {
    s_.neighbors = contact_.neighbors(s_.size());
    this->recorder_.rebuilt(s_, Contact<Dim>::reach * c_.dp);
  }
  void begin_snapshot() {
    Base::begin_snapshot();
    this->snapshot_.strain_energy.resize(s_.size());
  }
  /// A particle with the deformation F and the volume ratio J that its stress comes from.
  void store(int i, const Mat& F, double J);

  std::vector<V> X_;        // m
  std::vector<double> V0_;  // m^Dim
  ReferencePairs<Dim> pairs_of_start_;

 private:
  void check_pairs(const Scene& scene) const;

  std::vector<int> material_;
  std::vector<LawOf<M.law>> laws_;  // by material
  double c_p_ = 0;                  // m/s
};

template <const Formulation& M, int Dim>
InitialPairSolver<M, Dim>::InitialPairSolver(const SolverInput& input)
    : Base(input, Kernel<M.kernel>::support * input.constants.h) {
  s_.reorder(order_in_space(s_.x, initial_.first, this->support_), threads_now());
  X_ = s_.x;
  for (const int id : s_.id) {
    V0_.push_back(initial_.V0[id]);
    material_.push_back(initial_.material[id]);
  }
  pairs_of_start_ =
      make_reference_pairs<Kernel<M.kernel>>(X_, V0_, initial_.first, c_.h, M.gradient, c_.normalised);
  check_pairs(input.scene);
  this->pairs_ = static_cast<long>(pairs_of_start_.j.size());
  for (const Elasticity& e : input.materials) {
    laws_.push_back({{e.K, e.G}});
    c_p_ = std::max(c_p_, std::sqrt((e.K + 4.0 / 3 * e.G) / e.rho0));
  }
  contact_.search(s_);
  show_contacts_to_probes();
}

template <const Formulation& M, int Dim>
void InitialPairSolver<M, Dim>::check_pairs(const Scene& scene) const {
  for (int i = 0; i < s_.size(); ++i) {
    if (trace(pairs_of_start_.B[i]) > 0) continue;
    const std::string& body = scene.bodies[s_.body[i]].name;
    throw SceneError("body." + body, "body '" + body + "' is too thin for method '" + std::string(M.name) +
                                         "': the neighbours of one of its particles do not span the space; "
                                         "use a smaller spacing");
  }
}

template <const Formulation& M, int Dim>
void InitialPairSolver<M, Dim>::store(int i, const Mat& F, double J) {
  const auto [sigma, zz] = law(i).cauchy(F, J);
  const double p = -(trace(sigma) + zz) / 3;
  Sym<double, Dim> s = sigma;
  for (int k = 0; k < Dim; ++k) s(k, k) += p;
  Base::store(i, s_.m[i] / (V0_[i] * J), p, s, zz + p);
  this->snapshot_.strain_energy[s_.id[i]] = V0_[i] * law(i).energy(F, J);
}

}  // namespace taut::inline TAUT_ISA
