#include "engine/methods/tl_displacement/solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "engine/core/parallel.hpp"
#include "engine/kernels/kernel.hpp"
#include "engine/methods/tl_displacement/describe.hpp"
#include "engine/solver/particle_simulation.hpp"
#include "engine/terms/hourglass/hourglass_force.hpp"

namespace taut {
namespace {

TlDisplacementConstants all_constants(const SolverInput& input) {
  const auto& method = *as<TlDisplacementFormulation>(input.method);
  return constants_of(tl_displacement::constants(method, input.scene.dim), input.constants, input.values);
}

template <int Dim>
InitialConfiguration<Dim> initial_configuration(Common<Dim>& common, const SolverInput& input) {
  const auto& method = *as<TlDisplacementFormulation>(input.method);
  return {common, input, method.gradient, all_constants(input).normalised,
          method.pair_force != PairForce::shear};
}

double youngs_modulus(const Elasticity& m) { return 9 * m.K * m.G / (3 * m.K + m.G); }

}  // namespace

template <int Dim>
TlDisplacement<Dim>::TlDisplacement(Common<Dim>& common, const SolverInput& input, const Kernels& kernels)
    : kernels_(kernels),
      common_(common),
      p_(common.particles),
      body_(initial_configuration(common, input)),
      pair_lanes_(body_.pairs, input.threads, [&](int p) { return body_.pairs.k[p]; }) {
  const PairForce force = as<TlDisplacementFormulation>(input.method)->pair_force;
  const TlDisplacementConstants c = all_constants(input);
  if (force != PairForce::none) bonds_ = make_bonds(input, force, c.alpha);
  if (force == PairForce::hourglass) F_.resize(p_.size());
  if (force == PairForce::shear) {
    velocity_.resize(p_.size()), viscosity_.resize(p_.size()), shear_.resize(p_.size());
    for (int i = 0; i < p_.size(); ++i) {
      const Elasticity& m = input.materials[body_.material[i]];
      viscosity_[0][i] = c.damping * 0.5 * m.rho0 * m.c0 * c.h;
    }
  }
  body_.pairs = {};
  displacement_.resize(p_.size());
  stress_.resize(p_.size());
  f_ = {.size = p_.size(),
        .x = p_.x.data(),
        .v = p_.v.data(),
        .X = body_.X.data(),
        .material = body_.material.data(),
        .sites = body_.sites.data(),
        .laws = body_.laws(),
        .pairs = pair_lanes_.view(),
        .displacement = displacement_,
        .stress = stress_,
        .bonds = bonds_.view(),
        .F = F_,
        .velocity = velocity_,
        .viscosity = viscosity_,
        .shear = shear_,
        .shear_factor = c.shear_factor};
}

/// X_i − X_j and the weights: w_i, w_j of hourglass_force or s of pair_shear_force.
template <int Dim>
auto TlDisplacement<Dim>::make_bonds(const SolverInput& input, PairForce force, double alpha) const -> Bonds {
  const std::vector<int>& begin = body_.pairs.begin;
  const double h = common_.constants.h;
  return with_kernel(input.method.kernel, [&]<class K>(K) {
    return Bonds(body_.pairs, input.threads, [&, scale = K::alpha(Dim) / power<Dim>(h)](int pair) {
      const int i = static_cast<int>(std::ranges::upper_bound(begin, pair) - begin.begin()) - 1;
      const int j = body_.pairs.j[pair];
      const double V_i = body_.V0[i], V_j = body_.V0[j];
      const V X = difference_on_grid(body_.X[i], body_.X[j], h);
      const double r = std::sqrt(dot(X, X));
      std::array<double, Dim + 2> bond{};
      for (int k = 0; k < Dim; ++k) bond[k] = X[k];
      const auto weight = [&](int of) {
        const double E = youngs_modulus(input.materials[body_.material[of]]);
        return hourglass_weight(alpha, E, V_i, V_j, scale * K::w(r / h), r);
      };
      if (force == PairForce::hourglass)
        bond[Dim] = weight(i), bond[Dim + 1] = weight(j);
      else
        bond[Dim] = V_i * V_j * scale / h * K::dw(r / h) / r;
      return bond;
    });
  });
}

template <int Dim>
void TlDisplacement<Dim>::step(double dt) {
  if (common_.contact.prepare(p_, common_.vmax * dt)) common_.show_contacts_to_probes();
  kernels_.drift(f_, 0.5 * dt, common_.threads_now());
  common_.contact.evaluate(p_, dt, common_.threads_now());
  kernels_.stresses(f_, common_.threads_now());
  const Kick<Dim> kick = common_.kick(dt, common_.run.time + dt);
  common_.set_greatest_speed(kernels_.forces(f_, kick, common_.threads_now()));
  common_.stop_approach(0.5 * dt, [&](int i, const V& change) { p_.x[i] += (0.5 * dt) * change; });
  common_.finish_step(dt);
}

template <int Dim>
template <class Take>
void TlDisplacement<Dim>::with_strains(std::span<const int> groups, const Take& take) const {
  Columns<Dim> displacement;
  displacement.resize(p_.size());
  for (int i = 0; i < p_.size(); ++i)
    for (int k = 0; k < Dim; ++k) displacement[k][i] = p_.x[i][k] - body_.X[i][k];
  TlDisplacementFields<Dim> now = f_;
  now.displacement = displacement;
  const int count = static_cast<int>(groups.size());
  std::vector<Mat<Pack, Dim>> F(groups.size());
  kernels_.deform(now, groups.data(), count, F.data(), common_.threads_now());
  parallel_for(count, common_.threads_now(), [&](int k) {
    const int first = lanes * groups[k];
    for (int lane = 0; lane < std::min(lanes, p_.size() - first); ++lane) {
      const Mat<double, Dim> own = lane_of(F[k], lane);
      take(first + lane, own, determinant(own));
    }
  });
}

template <int Dim>
void TlDisplacement<Dim>::show(Snapshot& out, std::span<const int> groups) const {
  body_.begin(out);
  with_strains(groups, [&](int i, const auto& F, double J) { body_.store(out, i, F, J); });
}

template <int Dim>
bool TlDisplacement<Dim>::show_motion(Snapshot& out) const {
  body_.begin_motion(out);
  std::vector<int> groups(body_.groups());
  std::iota(groups.begin(), groups.end(), 0);
  with_strains(groups, [&](int i, const auto& F, double J) { body_.store_motion(out, i, F, J); });
  return true;
}

std::unique_ptr<Simulation> tl_displacement::make(const SolverInput& input) {
  const auto made = [&]<int Dim>() {
    const auto& kernels = kernels_for<Family::tl_displacement, TlDisplacementKernels<Dim>, true>(input);
    return simulation_by<TlDisplacement<Dim>, Dim>(input, initial_support(input), kernels);
  };
  return input.scene.dim == 3 ? made.template operator()<3>() : made.template operator()<2>();
}

}  // namespace taut
