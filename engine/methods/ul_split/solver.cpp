#include "engine/methods/ul_split/solver.hpp"

#include <algorithm>
#include <utility>

#include "engine/core/parallel.hpp"
#include "engine/methods/ul_split/describe.hpp"
#include "engine/solver/particle_simulation.hpp"
#include "engine/solver/step_speed.hpp"
#include "engine/terms/equation_of_state.hpp"

namespace taut {
namespace {

UlSplitConstants split_constants(const SolverInput& input) {
  const auto& method = *as<UlSplitFormulation>(input.method);
  UlSplitConstants c =
      constants_of(ul_split::constants(method, input.scene.dim), input.constants, input.values);
  constexpr double known = 0.75;  // G/K for ν = 0.2; above it `enog` fails if steps follow from c0
  c.step_speed = c.zeta > 0 ? step_speed(input, c.zeta, known) : step_speed(input);
  // up to G/K = 1/4 the sound speed c0 limits the step, above that the penalty
  if (has_penalty(method)) c.step_speed = step_speed(input, 4.0 / 3 + c.xi, 0.25);
  return c;
}

}  // namespace

template <int Dim>
UlSplit<Dim>::UlSplit(Common<Dim>& common, const SolverInput& input, const Kernels& kernels)
    : kernels_(kernels),
      method_(*as<UlSplitFormulation>(input.method)),
      common_(common),
      p_(common.particles),
      c_(split_constants(input)),
      stepping_(input.stepping),
      sph_contact_(input.contact == ContactLaw::sph && common.initial.first.size() > 2) {
  const std::size_t n = p_.x.size();
  rho_.assign(n, c_.rho0), drho_.assign(n, 0);
  s_.assign(n, {});
  flow_.resize(n), flow_new_.resize(n);
  has_foreign_neighbors_.resize(n);
  if (carries_stress(method_)) {
    ds_.assign(n, {});
    stress_.resize(n);
  } else {
    x_recovered_ = p_.x;
  }
  if (integrates_shear(method_)) {
    a_shear_.assign(n, V{}), da_shear_.assign(n, V{});
    recovery_.resize(n);
  }
  if (has_penalty(method_)) velocity_gradient_.resize(n);
  if (method_.artificial_stress) repulsion_.resize(n);
  rebuild();
  greatest_speed_ = common_.vmax;
}

/// Time step, s, [Zhang2024] Eq. 22, shorter for materials stiff in shear.
template <int Dim>
double UlSplit<Dim>::step_size() const {
  return common_.fixed_or_stable_step(c_.cfl * c_.h / (c_.step_speed + common_.vmax));
}

/// One acoustic step, [Zhang2024] Eq. 23–25.
template <int Dim>
void UlSplit<Dim>::step(double dt) {
  // Eq. 21 with the greatest speed so far, in case a body speeds up or turns back
  if (stepping_ == Stepping::single ? common_.run.steps > 0
                                    : distance_since_rebuild_ >= c_.cfl_advection * c_.h)
    rebuild();
  common_.contact.prepare(p_, common_.vmax * dt);
  kernels_.half_drift(f_, c_, 0.5 * dt, common_.threads_now());
  kernels_.contact_geometry(f_, c_);
  common_.contact.evaluate(p_, dt, common_.threads_now());
  accelerate(dt);
  close_rates(0.5 * dt);
  distance_since_rebuild_ += greatest_speed_ * dt;
  common_.finish_step(dt);
}

/// [Zhang2024] Eq. 24, 25.
template <int Dim>
void UlSplit<Dim>::accelerate(double dt) {
  const Kick<Dim> kick = common_.kick(dt, common_.run.time + dt);
  common_.set_greatest_speed(kernels_.momentum(f_, c_, kick, common_.threads_now()));
  common_.stop_approach(0.5 * dt, [&](int i, const V& change) {
    p_.x[i] += (0.5 * dt) * change;
    const FlowRow<Dim>& old = flow_[i];
    flow_new_[i].set(p_.v[i], old.c[Dim], old.c[Dim + 1]);
  });
  greatest_speed_ = std::max(greatest_speed_, common_.vmax);
}

template <int Dim>
void UlSplit<Dim>::close_rates(double dt) {
  kernels_.rates(f_, c_, common_.external.steering(), dt, common_.threads_now());
}

template <int Dim>
void UlSplit<Dim>::rebuild() {
  const int threads = common_.threads_now();
  const bool at_start = common_.run.steps == 0;
  if (!carries_stress(method_) && !at_start) {
    kernels_.recover_stress(f_, c_, displacements().data(), nullptr, p_.size(), s_.data(), threads);
    x_recovered_ = p_.x;
  }
  reorder(grid_.sort(p_.x, common_.run.support), threads, p_.x, p_.v, p_.m, p_.mobile, rho_, drho_, a_shear_,
          da_shear_, s_, ds_, x_recovered_, p_.id, p_.body, p_.material);
  search_(grid_, p_.x, common_.run.support, threads, near_);
  common_.run.pairs = near_.pairs;
  cache_pairs();
  common_.contact.search(p_);
  common_.probes.rebuilt(p_, near_, common_.run.support);
  distance_since_rebuild_ = 0;
  if (!at_start) return;
  // for the first half step
  for (int i = 0; i < p_.size(); ++i) flow_new_[i].set(p_.v[i], 0, p_.m[i] / rho_[i]);
  close_rates(0);
}

template <int Dim>
void UlSplit<Dim>::cache_pairs() {
  const auto n = static_cast<std::size_t>(packs());
  gradients_.resize(Dim * n), inverse_slopes_.resize(n), inverse_distances_.resize(n);
  if (method_.artificial_stress) closeness_.resize(n);
  if (PairCache<Dim>::single_precision) kernel_steepness_ = kernels_.steepness(c_), kernel_length_ = c_.h;
  bind_fields();
  kernels_.geometry(f_, c_, common_.threads_now());
  list_mixed_packs();
}

template <int Dim>
void UlSplit<Dim>::list_mixed_packs() {
  mixed_.clear();
  for (int i = 0; i < p_.size() && sph_contact_; ++i) {
    if (!has_foreign_neighbors_[i]) continue;
    const auto is_of_another_body = [&](int j) { return p_.body[j] != p_.body[i]; };
    for (int b = near_.begin[i]; b < near_.begin[i + 1]; ++b)
      if (std::any_of(near_.pack(b), near_.pack(b) + lanes, is_of_another_body)) mixed_.push_back({i, b});
  }
  f_.mixed = mixed_.data(), f_.mixed_count = static_cast<int>(mixed_.size());
}

template <int Dim>
void UlSplit<Dim>::bind_fields() {
  f_ = {.size = p_.size(),
        .x = p_.x.data(),
        .v = p_.v.data(),
        .m = p_.m.data(),
        .mobile = p_.mobile.data(),
        .id = p_.id.data(),
        .body = p_.body.data(),
        .rho = rho_.data(),
        .drho = drho_.data(),
        .a_shear = a_shear_.data(),
        .da_shear = da_shear_.data(),
        .s = s_.data(),
        .ds = ds_.data(),
        .sph_contact = sph_contact_,
        .flow = flow_.data(),
        .flow_new = flow_new_.data(),
        .stress = stress_.data(),
        .repulsion = repulsion_.data(),
        .recovery = recovery_.data(),
        .velocity_gradient = velocity_gradient_.data(),
        .begin = near_.begin.data(),
        .j = near_.j.data(),
        .has_foreign_neighbors = has_foreign_neighbors_.data(),
        .pairs = {gradients_.data(), inverse_slopes_.data(), inverse_distances_.data(), closeness_.data(),
                  kernel_steepness_, kernel_length_},
        .mixed = mixed_.data(),
        .mixed_count = static_cast<int>(mixed_.size())};
}

/// Displacements since the last stress recovery, and volumes at that time.
template <int Dim>
std::vector<FlowRow<Dim>> UlSplit<Dim>::displacements() const {
  std::vector<FlowRow<Dim>> rows(p_.x.size());
  parallel_for(p_.size(), common_.threads_now(),
               [&](int i) { rows[i].set(p_.x[i] - x_recovered_[i], 0, recovery_[i].scalar()); });
  return rows;
}

template <int Dim>
void UlSplit<Dim>::show(Snapshot& out, std::span<const int> groups) const {
  std::vector<int> shown;
  shown.reserve(lanes * groups.size());
  for (const int group : groups)
    for (int i = lanes * group; i < std::min(lanes * (group + 1), p_.size()); ++i) shown.push_back(i);
  const int count = static_cast<int>(shown.size());
  std::vector<S> recovered;
  if (!carries_stress(method_)) {
    recovered.resize(shown.size());
    kernels_.recover_stress(f_, c_, displacements().data(), shown.data(), count, recovered.data(),
                            common_.threads_now());
  }
  parallel_for(count, common_.threads_now(), [&](int k) {
    const int i = shown[k];
    const S& s = recovered.empty() ? s_[i] : recovered[k];
    common_.store(out, i, rho_[i], pressure(rho_[i], c_.rho0, c_.c0), s,
                  method_.deviator == Deviator::plane_strain ? -trace(s) : 0);
  });
}

template <int Dim>
auto UlSplit<Dim>::contact_force(const Probe& probe, double dt) const -> V {
  if (probe.wall >= 0 || !sph_contact_) return common_.contact_force(probe, dt);
  return kernels_.force_between(f_, c_, probe.bodies[0], probe.bodies[1]);
}

template <int Dim>
template <class Archive>
void UlSplit<Dim>::serialize(Archive& archive) {
  archive.fixed(rho_, drho_, a_shear_, da_shear_, s_, ds_, x_recovered_);
  near_.serialize(archive, p_.x.size());
  archive.fixed(has_foreign_neighbors_, recovery_);
  archive(gradients_, inverse_slopes_, inverse_distances_, closeness_, kernel_steepness_, kernel_length_);
  archive.check("the geometry of pairs", [&] {
    const auto n = static_cast<std::size_t>(packs());
    return gradients_.size() == Dim * n && inverse_slopes_.size() == n && inverse_distances_.size() == n &&
           closeness_.size() == (method_.artificial_stress ? n : 0) && kernel_steepness_ > 0 &&
           kernel_length_ > 0;
  });
  archive(greatest_speed_, distance_since_rebuild_);
  if constexpr (Archive::loads) {
    list_mixed_packs();
    bind_fields();
  }
}

std::unique_ptr<Simulation> ul_split::make(const SolverInput& input) {
  const auto made = [&]<int Dim>() {
    const auto& kernels = kernels_for<Family::ul_split, UlSplitKernels<Dim>>(input);
    return simulation_by<UlSplit<Dim>, Dim>(input, kernels.support * input.constants.h, kernels);
  };
  return input.scene.dim == 3 ? made.template operator()<3>() : made.template operator()<2>();
}

}  // namespace taut
