#include "engine/methods/tl_displacement/solver.hpp"

#include <algorithm>
#include <numeric>

#include "engine/core/parallel.hpp"
#include "engine/methods/tl_displacement/describe.hpp"
#include "engine/solver/particle_simulation.hpp"

namespace taut {
namespace {

template <int Dim>
InitialConfiguration<Dim> initial_configuration(Common<Dim>& common, const SolverInput& input) {
  const auto& method = *as<TlDisplacementFormulation>(input.method);
  const auto c = constants_of(tl_displacement::constants(method, Dim), input.constants, input.values);
  return {common, input, method.gradient, c.normalised};
}

}  // namespace

template <int Dim>
TlDisplacement<Dim>::TlDisplacement(Common<Dim>& common, const SolverInput& input, const Kernels& kernels)
    : kernels_(kernels),
      common_(common),
      p_(common.particles),
      body_(initial_configuration(common, input)),
      pair_lanes_(body_.pairs, input.threads, [&](int p) { return body_.pairs.k[p]; }) {
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
        .stress = stress_};
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
