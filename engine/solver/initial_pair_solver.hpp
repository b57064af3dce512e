#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/materials/chosen_laws.hpp"
#include "engine/solver/initial_pairs.hpp"
#include "engine/solver/particle_solver.hpp"

namespace taut::inline TAUT_ISA {

/// What the solvers of total-Lagrangian methods share: bodies whose particles act on their initial neighbours
/// through a law of elasticity, and on other bodies by contact. A solver adds what it integrates.
/// The papers put particles on the boundary; here they are in the middle of cells unless the body says so
/// (Body::on_boundary): the outermost stand half a spacing inside the face.
template <class Solver, const Formulation& M, int Dim>
class InitialPairSolver : public ParticleSolver<Solver, Dim> {
 public:
  /// CFL h/(c_p + |v|max) with the fastest wave, c_p = √((K + 4G/3)/ρ0), s. [Lee2016] Eq. 44 has the spacing
  /// for h and waits for the wave in the strained body; |v|max stands for how fast it is being strained.
  double step_size() const { return this->fixed_or(c_.cfl * c_.h / (c_p_ + vmax_)); }

  void begin_snapshot() {
    Base::begin_snapshot();
    this->snapshot_.strain_energy.resize(s_.size());
  }

 protected:
  using Base = ParticleSolver<Solver, Dim>;
  using Base::c_, Base::s_, Base::contact_, Base::drives_, Base::loads_, Base::initial_, Base::threads_now,
      Base::vmax_;
  using typename Base::V;
  using Mat = taut::Mat<double, Dim>;

  explicit InitialPairSolver(const SolverInput& input);

  double wave_speed() const { return c_p_; }  // c_p, the greatest of all materials, m/s

  /// `pass`(laws) with the laws of four particles at a time: the pass is compiled for each law that there may
  /// be.
  template <class Pass>
  auto with_laws(const Pass& pass) const {
    return laws_.visit([&]<class L>(const std::vector<L>& laws) {
      return pass(LawsOfFour<L, M.several_materials>(laws, material_));
    });
  }
  int groups() const { return (s_.size() + lanes - 1) / lanes; }
  /// `f`(i) of the particles of a group, which are fewer in the last one.
  template <class F>
  [[gnu::always_inline]] void each_of(int group, const F& f) const {
    const int first = lanes * group, last = std::min(first + lanes, s_.size());
    for (int i = first; i < last; ++i) f(i);
  }

  /// A particle with the deformation F and the volume ratio J that its stress comes from.
  void store(int i, const Mat& F, double J);

  /// Of four particles; the filling has 0.
  struct Sites {
    Sym<Pack, Dim> B;  // 1/m^Dim
    Pack V0;           // m^Dim
    Pack per_m;        // 1/kg (per metre depth in 2D)
    Pack mobile;       // 1, or 0 where held
  };

  std::vector<V> X_;        // m
  std::vector<double> V0_;  // m^Dim
  InitialPairs<Dim> initial_pairs_;
  std::vector<Sites> sites_;

 private:
  void check_pairs(const Scene& scene) const;
  std::vector<Point> surface() const;

  std::vector<int> material_;  // with the filling of the last group
  ChosenLaws<M> laws_;
  double c_p_ = 0;  // m/s
};

template <class Solver, const Formulation& M, int Dim>
InitialPairSolver<Solver, M, Dim>::InitialPairSolver(const SolverInput& input)
    : Base(input, Kernel<M.kernel>::support * input.constants.h), laws_(input.law, input.materials) {
  // stored as they were made: along the rows of a lattice, the layers of a round body
  X_ = s_.x;
  V0_ = initial_.V0;
  material_ = initial_.material;
  material_.resize(static_cast<std::size_t>(lanes) * groups(), material_.back());
  std::vector<double> cells;  // m^Dim
  for (int i = 0; i < s_.size(); ++i) cells.push_back(V0_[i] / initial_.inside[i]);
  using K = Kernel<M.kernel>;
  initial_pairs_ = make_initial_pairs<K>(initial_neighbors(initial_, reach_of_pairs<K>(c_.h), input.threads),
                                         X_, cells, c_.h, M.gradient, c_.normalised, input.threads);
  check_pairs(input.scene);
  sites_.assign(groups(), Sites{});
  for (int i = 0; i < s_.size(); ++i) {
    Sites& of_four = sites_[i / lanes];
    of_four.V0[i % lanes] = V0_[i];
    of_four.per_m[i % lanes] = 1 / s_.m[i];
    of_four.mobile[i % lanes] = s_.mobile[i];
    for (int c = 0; c < Sym<double, Dim>::size; ++c) of_four.B.c[c][i % lanes] = initial_pairs_.B[i].c[c];
  }
  // normalised gradients keep the loads of their paper: they say less than all of a uniform field
  if constexpr (M.gradient == GradientCorrection::corrected)
    loads_.act_on_faces(input.scene, initial_, FaceRule::uniform, surface(), this->support_);
  this->pairs_ = static_cast<long>(initial_pairs_.j.size());
  for (const int used : initial_.material)
    c_p_ = std::max(c_p_, compression_wave_speed(input.materials[used]));
  this->go_to_start();
  contact_.search(s_);
  this->show_contacts_to_probes();
}

template <class Solver, const Formulation& M, int Dim>
void InitialPairSolver<Solver, M, Dim>::check_pairs(const Scene& scene) const {
  for (int i = 0; i < s_.size(); ++i) {
    if (trace(initial_pairs_.B[i]) > 0) continue;
    const std::string& body = scene.bodies[s_.body[i]].name;
    throw SceneError("body." + body, "body '" + body + "' is too thin for method '" + std::string(M.name) +
                                         "': the neighbours of one of its particles do not span the space; "
                                         "use a smaller spacing");
  }
}

/// By id: S_i = −Σ_j (V_i B_i + V_j B_j) k_ij, against which a uniform stress pushes; 0 inside a lattice.
template <class Solver, const Formulation& M, int Dim>
std::vector<Point> InitialPairSolver<Solver, M, Dim>::surface() const {
  const auto& [begin, j, k, B] = initial_pairs_;
  std::vector<Point> S(s_.size());
  for (int i = 0; i < s_.size(); ++i) {
    V sum{};
    for (int p = begin[i]; p < begin[i + 1]; ++p) sum += (V0_[i] * B[i] + V0_[j[p]] * B[j[p]]) * k[p];
    for (int a = 0; a < Dim; ++a) S[i][a] = -sum[a];
  }
  return S;
}

template <class Solver, const Formulation& M, int Dim>
void InitialPairSolver<Solver, M, Dim>::store(int i, const Mat& F, double J) {
  laws_.visit([&](const auto& laws) {
    const auto& law = laws[material_[i]];
    const auto [sigma, zz] = law.cauchy(F, J);
    const double p = -(trace(sigma) + zz) / 3;
    Sym<double, Dim> s = sigma;
    for (int k = 0; k < Dim; ++k) s(k, k) += p;
    Base::store(i, s_.m[i] / (V0_[i] * J), p, s, zz + p);
    this->snapshot_.strain_energy[s_.id[i]] = V0_[i] * law.energy(F, J);
  });
}

/// The constant h of these methods.
constexpr MethodConstant smoothing_length(const Formulation& m, int dim, double least) {
  const double h = dim == 3 && m.h_over_dp_3d > 0 ? m.h_over_dp_3d : m.h_over_dp;
  return {"h", &Constants::h, h, least, 3.0, "smoothing length over the spacing", true};
}

}  // namespace taut::inline TAUT_ISA
