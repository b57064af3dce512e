#include "engine/methods/ul_cauchy/solver.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "engine/core/parallel.hpp"
#include "engine/error.hpp"
#include "engine/methods/ul_cauchy/describe.hpp"
#include "engine/solver/particle_simulation.hpp"
#include "engine/solver/step_speed.hpp"
#include "engine/terms/equation_of_state.hpp"
#include "engine/terms/riemann_second_order.hpp"

namespace taut {
namespace {

/// Maximum riemann_step_speed() of two interacting materials, m/s.
double riemann_speed(const SolverInput& input) {
  const std::vector<Elasticity>& materials = input.materials;
  const InitialParticles& initial = input.initial;
  const bool joins_bodies = input.contact == ContactLaw::sph;
  std::set<std::pair<int, int>> materials_of_bodies;
  for (std::size_t i = 0; i < initial.material.size(); ++i)
    materials_of_bodies.emplace(joins_bodies ? 0 : initial.body[i], initial.material[i]);
  double speed = 0;
  for (const auto& [body, a] : materials_of_bodies)
    for (const auto& [other, b] : materials_of_bodies)
      if (body == other && materials[a].rho0 < materials[b].rho0)
        speed = std::max(speed, riemann_step_speed(materials[a].rho0, materials[a].c0, materials[b].rho0,
                                                   materials[b].c0));
  return speed;
}

UlCauchyConstants cauchy_constants(const SolverInput& input) {
  const auto& method = *as<UlCauchyFormulation>(input.method);
  UlCauchyConstants c =
      constants_of(ul_cauchy::constants(method, input.scene.dim), input.constants, input.values);
  c.step_speed = step_speed(input);
  if (method.viscosity == Viscosity::riemann)
    c.step_speed = std::max(c.step_speed, c.riemann_factor * riemann_speed(input));
  return c;
}

double magnitude(double spin) { return std::abs(spin); }
double magnitude(const Vec<double, 3>& spin) { return std::sqrt(dot(spin, spin)); }

template <int Dim>
struct BodyRotation;
template <>
struct BodyRotation<2> {
  double momentum = 0, inertia = 0;

  void add(double m, const Vec<double, 2>& arm, const Vec<double, 2>& v) {
    momentum += m * (arm[0] * v[1] - arm[1] * v[0]);
    inertia += m * dot(arm, arm);
  }
  double spin() const { return inertia > 0 ? momentum / inertia : 0; }
};
template <>
struct BodyRotation<3> {
  Vec<double, 3> momentum{};
  Sym<double, 3> inertia{};

  void add(double m, const Vec<double, 3>& arm, const Vec<double, 3>& v) {
    momentum += m * cross(arm, v);
    add_outer(inertia, -m, arm);
    for (int k = 0; k < 3; ++k) inertia(k, k) += m * dot(arm, arm);
  }
  Vec<double, 3> spin() const { return inverse(inertia) * momentum; }  // 0 for particles in a line
};

}  // namespace

template <int Dim>
UlCauchy<Dim>::UlCauchy(Common<Dim>& common, const SolverInput& input, const Kernels& kernels)
    : kernels_(kernels),
      method_(*as<UlCauchyFormulation>(input.method)),
      common_(common),
      p_(common.particles),
      c_(cauchy_constants(input)),
      materials_(input.materials),
      sph_contact_(input.contact == ContactLaw::sph && common.initial.first.size() > 2) {
  const std::size_t n = p_.x.size();
  rho_.assign(n, 0), drho_.assign(n, 0), s_.assign(n, {});
  for (int i = 0; i < p_.size(); ++i) {
    rho_[i] = material(i).rho0;
    if (p_.material[i] != p_.material[0]) several_materials_ = true;
  }
  if (sph_contact_) refuse_contact_forces(input.scene);
  motion_.resize(n), moved_.resize(n), transported_.resize(n);
  stress_.resize((n * kernels_.stress_row + sizeof(CacheLine) - 1) / sizeof(CacheLine));
  if (method_.artificial_stress) repulsion_.resize(n);
  rebuild();
}

/// Throws SceneError.
template <int Dim>
void UlCauchy<Dim>::refuse_contact_forces(const Scene& scene) const {
  for (const Probe& probe : scene.probes)
    if (probe.kind == Probe::Kind::contact_force && probe.wall < 0)
      throw SceneError("probe." + probe.name,
                       fmt::format("the probe '{}' has no force to measure: "
                                   "with contact = \"sph\" the method '{}' treats touching bodies as one; "
                                   "choose another law, such as \"penalty\"",
                                   probe.name, method_.name));
}

/// Time step, s, [Khayyer2024] Eq. 26 with `step_speed`.
template <int Dim>
double UlCauchy<Dim>::step_size() const {
  return common_.fixed_or_stable_step(c_.cfl * c_.h / c_.step_speed);
}

/// Symplectic Euler step. Departure: with rates of the old state ([Khayyer2024] Eq. 22–25) waves grow, and with ∇u at
/// the old positions rotating bodies swell.
template <int Dim>
void UlCauchy<Dim>::step(double dt) {
  if (2 * relative_distance_ > skin * c_.dp) rebuild();
  if (common_.contact.prepare(p_, common_.vmax * dt)) show_neighbors_to_probes();
  common_.contact.evaluate(p_, dt, common_.threads_now());
  kernels_.gradients(f_, c_, common_.threads_now());
  accelerate(dt);
  transport(dt);
  kernels_.rates(f_, c_, dt, common_.threads_now());
  common_.finish_step(dt);
}

template <int Dim>
void UlCauchy<Dim>::accelerate(double dt) {
  const Kick<Dim> kick = common_.kick(dt, common_.run.time + 0.5 * dt);
  common_.set_greatest_speed(kernels_.stresses(f_, c_, kick, common_.threads_now()));
  common_.stop_approach(0, [&](int i, const V&) { moved_[i].put_velocity(p_.v[i]); });
}

template <int Dim>
void UlCauchy<Dim>::transport(double dt) {
  const double fastest2 =
      kernels_.transport(f_, c_, common_.external.steering(), c_.geometry * dt, common_.threads_now());
  relative_distance_ += dt * std::sqrt(fastest2);
  for (std::size_t body = 0; body < drift_.size(); ++body) centre_[body] += dt * drift_[body];
  // a straight step through the angle ω dt stretches a pair by ½ (ω dt)² of its length, ¼ (ω dt)² for each end
  double spin = 0;  // greatest
  for (const Spin<Dim>& each : spin_) spin = std::max(spin, magnitude(each));
  const double turn = dt * spin;
  relative_distance_ += 0.25 * turn * turn * (common_.run.support + skin * c_.dp);
}

template <int Dim>
void UlCauchy<Dim>::rebuild() {
  const double reach = common_.run.support + skin * c_.dp;
  const int threads = common_.threads_now();
  reorder(grid_.sort(p_.x, reach), threads, p_.x, p_.v, p_.m, p_.mobile, rho_, drho_, s_, p_.id, p_.body,
          p_.material);
  search_(grid_, p_.x, reach, threads, near_, common_.contact.between_bodies() ? p_.body.data() : nullptr);
  common_.run.pairs = near_.pairs;
  mark_materials();
  set_motion();
  set_rigid_motion();
  bind_fields();
  common_.contact.search(p_);
  show_neighbors_to_probes();
  relative_distance_ = 0;
}

template <int Dim>
void UlCauchy<Dim>::bind_fields() {
  if (kernels_.needs_kernel) w_.resize(near_.begin.back());
  f_ = {.size = p_.size(),
        .x = p_.x.data(),
        .v = p_.v.data(),
        .m = p_.m.data(),
        .mobile = p_.mobile.data(),
        .id = p_.id.data(),
        .body = p_.body.data(),
        .material = p_.material.data(),
        .materials = materials_.data(),
        .rho = rho_.data(),
        .drho = drho_.data(),
        .s = s_.data(),
        .motion = motion_.data(),
        .moved = moved_.data(),
        .transported = transported_.data(),
        .stress = stress_.data(),
        .repulsion = repulsion_.data(),
        .begin = near_.begin.data(),
        .j = near_.j.data(),
        .w = w_.data(),
        .of_one_material = of_one_material_.empty() ? nullptr : of_one_material_.data(),
        .drift = drift_.data(),
        .centre = centre_.data(),
        .spin = spin_.data()};
}

template <int Dim>
void UlCauchy<Dim>::show_neighbors_to_probes() {
  if (!sph_contact_) return common_.show_contacts_to_probes();
  common_.probes.rebuilt(p_, near_, common_.run.support);
}

template <int Dim>
void UlCauchy<Dim>::mark_materials() {
  if (!method_.density_diffusion || !several_materials_) return;
  of_one_material_.resize(near_.begin.back());
  parallel_for(p_.size(), common_.threads_now(), [&](int i) {
    for (int b = near_.begin[i]; b < near_.begin[i + 1]; ++b)
      for (int lane = 0; lane < lanes; ++lane)
        of_one_material_[b].value[lane] = p_.material[near_.pack(b)[lane]] == p_.material[i];
  });
}

template <int Dim>
void UlCauchy<Dim>::set_motion() {
  for (int i = 0; i < p_.size(); ++i) motion_[i].set(p_.v[i], rho_[i], p_.m[i] / rho_[i], p_.x[i]);
}

template <int Dim>
void UlCauchy<Dim>::set_rigid_motion() {
  const std::size_t bodies = common_.initial.first.size() - 1;
  drift_.assign(bodies, V{}), centre_.assign(bodies, V{}), spin_.assign(bodies, Spin<Dim>{});
  if (sph_contact_) return;
  std::vector<double> mass(bodies);
  for (int i = 0; i < p_.size(); ++i) {
    const int body = p_.body[i];
    mass[body] += p_.m[i];
    drift_[body] += p_.m[i] * p_.v[i], centre_[body] += p_.m[i] * p_.x[i];
  }
  for (std::size_t body = 0; body < bodies; ++body)
    drift_[body] = (1 / mass[body]) * drift_[body], centre_[body] = (1 / mass[body]) * centre_[body];
  std::vector<BodyRotation<Dim>> rotation(bodies);
  for (int i = 0; i < p_.size(); ++i) {
    const int body = p_.body[i];
    rotation[body].add(p_.m[i], p_.x[i] - centre_[body], p_.v[i] - drift_[body]);
  }
  for (std::size_t body = 0; body < bodies; ++body) spin_[body] = rotation[body].spin();
}

template <int Dim>
void UlCauchy<Dim>::show(Snapshot& out, std::span<const int> groups) const {
  parallel_for(static_cast<int>(groups.size()), common_.threads_now(), [&](int k) {
    for (int i = lanes * groups[k]; i < std::min(lanes * (groups[k] + 1), p_.size()); ++i) {
      const double p = pressure(rho_[i], material(i).rho0, material(i).c0);
      common_.store(out, i, rho_[i], p, s_[i], -trace(s_[i]));
    }
  });
}

template <int Dim>
template <class Archive>
void UlCauchy<Dim>::serialize(Archive& archive) {
  archive.fixed(rho_, drho_, s_, motion_);
  near_.serialize(archive, motion_.size());
  archive(of_one_material_);
  archive.check("the materials of pairs", [&] {
    return of_one_material_.empty() || std::cmp_equal(of_one_material_.size(), near_.begin.back());
  });
  archive.fixed(drift_, spin_, centre_);
  archive(relative_distance_);
  if constexpr (Archive::loads) bind_fields();
}

std::unique_ptr<Simulation> ul_cauchy::make(const SolverInput& input) {
  const auto made = [&]<int Dim>() {
    const auto& kernels = kernels_for<Family::ul_cauchy, UlCauchyKernels<Dim>, true>(input);
    return simulation_by<UlCauchy<Dim>, Dim>(input, kernels.support * input.constants.h, kernels);
  };
  return input.scene.dim == 3 ? made.template operator()<3>() : made.template operator()<2>();
}

}  // namespace taut
