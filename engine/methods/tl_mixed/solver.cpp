#include "engine/methods/tl_mixed/solver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "engine/core/parallel.hpp"
#include "engine/error.hpp"
#include "engine/methods/tl_mixed/describe.hpp"
#include "engine/solver/particle_simulation.hpp"

namespace taut {
namespace {

/// Multiple of c_p beyond which the run has diverged.
constexpr double greatest_wave_ratio = 100;
using K = Kernel<KernelName::wendland_c2>;

}  // namespace

template <int Dim>
TlMixed<Dim>::TlMixed(Common<Dim>& common, const SolverInput& input, const Kernels& kernels)
    : kernels_(kernels),
      method_(*as<TlMixedFormulation>(input.method)),
      common_(common),
      p_(common.particles),
      c_(constants_of(tl_mixed::constants(method_, Dim), input.constants, input.values)),
      body_(common, input),
      v_start_(p_.x.size()) {
  if (c_.deviator_ratio != 0) body_.materials.take_volume_ratio_in_shear();
  make_pairs(input);
  flow_.resize(p_.size());
  stress_.resize(p_.size());
  a_.resize(p_.size() + lanes), a_start_.resize(p_.size());  // the projection begins packs at any particle
  dissipation_J_.resize(p_.size() + lanes);
  make_strains();
  f_ = {.size = p_.size(),
        .x = p_.x.data(),
        .v = p_.v.data(),
        .m = p_.m.data(),
        .v_start = v_start_.data(),
        .X = body_.X.data(),
        .V0 = body_.V0.data(),
        .material = body_.material.data(),
        .sites = body_.sites.data(),
        .laws = body_.laws(),
        .wave_speed = body_.wave_speed,
        .one_sided = c_.internal_force != 0,
        .pairs = pair_lanes_.view(),
        .dissipating_pairs = dissipating_lanes_.view(),
        .now = now_.view(),
        .start = start_.view(),
        .rate = rate_.view(),
        .flow = flow_,
        .stress = stress_,
        .once = once_,
        .a = a_,
        .a_start = a_start_,
        .dissipation_J = dissipation_J_};
  if (!common_.initial.start.empty()) set_start_gradients();
  if (c_.boundary_projection != 0)
    for (Sites<Dim>& sites : body_.sites)
      sites.mobile = filled<Pack>(1);  // the projection stops clamped particles
}

template <int Dim>
void TlMixed<Dim>::make_pairs(const SolverInput& input) {
  InitialPairs<Dim>& pairs = body_.pairs;
  if (method_.jst) {
    const std::vector<double> w =
        corrected_laplacian<K>(pairs, body_.X, body_.V0, c_.h, c_.dp * c_.dp, input.threads);
    dissipating_lanes_ = with_laplacian(pairs, w, body_.V0, c_.adjoint, input.threads);
    once_.resize(p_.size());
    dissipation_limit_ = greatest_step_of_dissipation(input.threads);
  } else {
    pair_lanes_ = {pairs, input.threads, [&](int p) { return pairs.k[p]; }};
  }
  if (c_.boundary_projection == 0)
    pairs = {};
  else
    pairs.k = std::vector<V>();  // frees memory, unlike {}
}

template <int Dim>
void TlMixed<Dim>::make_strains() {
  Mat<Pack, Dim> one{};
  for (int k = 0; k < Dim; ++k) one(k, k) = filled<Pack>(1);
  for (StrainArrays* strains : {&now_, &start_, &rate_}) {
    strains->F.assign(groups(), one);
    if (kernels_.has_J) strains->J.assign(groups(), AlignedPack{filled<Pack>(1)});
    if (kernels_.has_H) strains->H.assign(groups(), one);
  }
}

template <int Dim>
void TlMixed<Dim>::set_start_gradients() {
  for (int i = 0; i < p_.size(); ++i)
    for (int k = 0; k < Dim; ++k) flow_[k][i] = p_.x[i][k] - body_.X[i][k];
  kernels_.start_gradients(f_);
}

/// Limit in s, with a reserve of a tenth for waves.
template <int Dim>
double TlMixed<Dim>::greatest_step_of_dissipation(int threads) const {
  const double square = biharmonic_spectral_radius(dissipating_lanes_.view(), p_.size(), threads),
               once = std::sqrt(square);
  const double rate = std::max(c_.eps_v2 * once + c_.eps_v4 * square, c_.eps_J2 * once + c_.eps_J4 * square);
  return 0.9 * 2 * c_.dp / (body_.wave_speed * rate);
}

/// Time step, s; in 3D with the fastest wave in the strained bodies. Departure: h instead of dp in [Lee2016] Eq. 44,
/// since 0.3 dp/c_p is unstable at free faces of cell-centred particles.
template <int Dim>
double TlMixed<Dim>::step_size() const {
  if (Dim == 2) return std::min(body_.step_size(), common_.fixed_or_stable_step(dissipation_limit_));
  const double fastest = std::sqrt(kernels_.greatest_stiffness(f_, common_.threads_now()) / c_.rho0);
  const double at_least = body_.wave_speed;  // softened bodies may stiffen again
  if (!(fastest <= greatest_wave_ratio * at_least)) throw_crushed();
  return common_.fixed_or_stable_step(
      std::min(c_.cfl * c_.h / std::max(fastest, at_least), dissipation_limit_));
}

/// Throws NumericalError.
template <int Dim>
void TlMixed<Dim>::throw_crushed() const {
  const double limit = greatest_wave_ratio * body_.wave_speed;
  int failed_id = p_.size();
  std::vector<AlignedPack> bound(groups());
  kernels_.stiffnesses(f_, bound.data());
  for (int i = 0; i < p_.size(); ++i)
    if (!(bound[i / lanes].value[i % lanes] <= c_.rho0 * limit * limit))
      failed_id = std::min(failed_id, p_.id[i]);
  throw NumericalError(common_.run.steps, common_.run.time, failed_id, "deformation",
                       fmt::format("particle {} is crushed or turned inside out: "
                                   "waves in it are more than {:g} times as fast as in the unstrained body, "
                                   "or its deformation is not a number",
                                   failed_id, greatest_wave_ratio));
}

/// [Lee2016] Eq. 43
template <int Dim>
void TlMixed<Dim>::step(double dt) {
  if (common_.contact.prepare(p_, common_.vmax * dt)) common_.show_contacts_to_probes();
  const Kick<Dim> kick = common_.kick(dt, common_.run.time + dt);
  const StageActions<Dim> outside = actions();
  find_rates(dt);
  kernels_.predict(f_, kick, outside, common_.threads_now());
  project_on_boundary([](auto&&...) {});
  // the mean of both stages conserves momenta
  parallel_for(p_.size(), common_.threads_now(),
               [&](int i) { p_.x[i] += (0.5 * dt * p_.mobile[i]) * (v_start_[i] + p_.v[i]); });
  find_rates(dt);
  common_.set_greatest_speed(kernels_.correct(f_, kick, outside, common_.threads_now()));
  close_on_boundary(dt);
  stop_approach(dt);
  common_.finish_step(dt);
}

/// Internal rates and, apart from them, contact forces. [Lee2016] Algorithm 1, steps 4–7
template <int Dim>
void TlMixed<Dim>::find_rates(double dt) {
  const int threads = common_.threads_now();
  kernels_.set_columns(f_, threads);
  common_.contact.evaluate(p_, 0.5 * dt, threads);  // each stage has half the step
  kernels_.gather(f_, threads);
  if (method_.jst) kernels_.dissipate(f_, c_, threads);
  if (c_.projection == 0) return;
  const std::vector<int>& first = common_.initial.first;
  for (std::size_t body = 0; body + 1 < first.size(); ++body)
    kernels_.project(f_, c_, first[body], first[body + 1]);
}

template <int Dim>
StageActions<Dim> TlMixed<Dim>::actions() {
  using Of = Common<Dim>;
  const External<Dim>& external = common_.external;
  const bool loaded = external.loads.active(), projected = c_.boundary_projection != 0,
             steered = !projected && (external.drives.active() || external.guides.active());
  const auto load = [](void* of, int i, V& a) {
    Of& all = *static_cast<Of*>(of);
    if (all.particles.mobile[i] == 0 || all.external.drives.moves(all.particles.id[i])) return;
    a = a + all.external.loads.acceleration(all.particles, i);
  };
  const auto steer = [](void* of, int i, V& v) {
    Of& all = *static_cast<Of*>(of);
    const int id = all.particles.id[i];
    if (all.external.drives.moves(id))
      v = all.external.drives.velocity(id);
    else
      all.external.guides.constrain(id, v);
  };
  const auto close = [](void* of, int i, double dt, const V& before, V& v) {
    Of& all = *static_cast<Of*>(of);
    Particles<Dim>& p = all.particles;
    External<Dim>& acting = all.external;
    p.v[i] = before;
    if (acting.drives.moves(p.id[i])) return acting.drives.replace(p, i, v);
    acting.guides.constrain(p.id[i], v);
    if (acting.loads.active()) acting.loads.count(p, i, dt, 0.5 * (p.v[i] + v));
  };
  return {.of = &common_,
          .load = loaded ? +load : nullptr,
          .steer = steered ? +steer : nullptr,
          .close = steered || (loaded && !projected) ? +close : nullptr};
}

/// [Lee2016] Algorithm 1, step 9.
template <int Dim>
template <class Use>
void TlMixed<Dim>::project_on_boundary(const Use& use) {
  if (c_.boundary_projection == 0) return;
  const External<Dim>& external = common_.external;
  std::vector<unsigned char> axes(p_.x.size());
  for (int i = 0; i < p_.size(); ++i) {
    const int id = p_.id[i];
    if (common_.initial.clamped[id] || external.drives.moves(id))
      axes[i] = (1 << Dim) - 1;
    else
      axes[i] = external.guides.axes(id);
  }
  boundary_.prescribe(std::move(axes), body_.pairs, body_.X, body_.V0, p_.m, common_.initial.first, c_.h);
  const auto given = [&](int i) {
    return external.drives.moves(p_.id[i]) ? external.drives.velocity(p_.id[i]) : V{};
  };
  boundary_.project([&](int i) -> V& { return p_.v[i]; }, given, use);
}

/// Projects at the end of a step, and adds what boundary and loads have done to work and reactions.
template <int Dim>
void TlMixed<Dim>::close_on_boundary(double dt) {
  if (c_.boundary_projection == 0) return;
  External<Dim>& external = common_.external;
  project_on_boundary([&](int i, const V& impulse, const auto& weights) {
    V twice_mean{};
    for (const auto& [a, w] : weights) twice_mean += w * (v_start_[a] + p_.v[a]);
    external.drives.add_work(p_.id[i], 0.5 * dot(impulse, twice_mean));
    if (!external.reactions.active()) return;
    for (const auto& [a, w] : weights) external.reactions.add(a, w * impulse);
    external.reactions.add(i, -1.0 * impulse);
  });
  if (!external.loads.active()) return;
  for (int i = 0; i < p_.size(); ++i)
    if (!external.drives.moves(p_.id[i])) external.loads.count(p_, i, dt, 0.5 * (v_start_[i] + p_.v[i]));
}

template <int Dim>
void TlMixed<Dim>::stop_approach(double dt) {
  bool stopped = false;
  common_.stop_approach(0.5 * dt, [&](int i, const V& change) {
    if (!stopped)
      for (int k = 0; k < Dim + 1; ++k) std::fill_n(flow_[k], flow_.size(), 0.0);
    stopped = true;
    p_.x[i] += (0.5 * dt) * change;
    for (int k = 0; k < Dim; ++k) flow_[k][i] = change[k];
  });
  if (stopped) kernels_.follow(f_, 0.5 * dt, common_.threads_now());
}

template <int Dim>
template <class Take>
void TlMixed<Dim>::with_strains(int group, const Take& take) const {
  const int first = lanes * group;
  const Mat<Pack, Dim>& F = now_.F[group];
  const Pack J = kernels_.has_J ? now_.J[group].value : determinant(F);
  for (int lane = 0; lane < std::min(lanes, p_.size() - first); ++lane)
    take(first + lane, lane_of(F, lane), J[lane]);
}

template <int Dim>
void TlMixed<Dim>::show(Snapshot& out, std::span<const int> groups) const {
  body_.begin(out);
  parallel_for(static_cast<int>(groups.size()), common_.threads_now(), [&](int k) {
    with_strains(groups[k], [&](int i, const auto& F, double J) { body_.store(out, i, F, J); });
  });
}

template <int Dim>
bool TlMixed<Dim>::show_motion(Snapshot& out) const {
  body_.begin_motion(out);
  parallel_for(body_.groups(), common_.threads_now(), [&](int group) {
    with_strains(group, [&](int i, const auto& F, double J) { body_.store_motion(out, i, F, J); });
  });
  return true;
}

template <int Dim>
template <class Archive>
void TlMixed<Dim>::serialize(Archive& archive) {
  archive.fixed(now_.F, now_.J, now_.H);
}

std::unique_ptr<Simulation> tl_mixed::make(const SolverInput& input) {
  const auto made = [&]<int Dim>() {
    const auto& kernels = kernels_for<Family::tl_mixed, TlMixedKernels<Dim>>(input);
    return simulation_by<TlMixed<Dim>, Dim>(input, initial_support(input), kernels);
  };
  return input.scene.dim == 3 ? made.template operator()<3>() : made.template operator()<2>();
}

}  // namespace taut
