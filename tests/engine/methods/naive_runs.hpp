#pragma once

#include <cstddef>
#include <string>

#include "engine/layout/initial_particles.hpp"
#include "engine/methods/catalogue.hpp"
#include "tests/engine/methods/naive_cauchy.hpp"
#include "tests/engine/methods/naive_lee2016.hpp"
#include "tests/engine/methods/naive_total_lagrangian.hpp"
#include "tests/engine/methods/naive_zhang2024.hpp"

namespace taut::test {

template <class Vector>
Vector vector_of(const Point& x) {
  Vector v;
  for (std::size_t k = 0; k < static_cast<std::size_t>(v.size()); ++k) v[k] = x[k];
  return v;
}

/// `lay(a, i, initial)` sets the members whose names differ between transcriptions.
template <class Run, class Lay>
void lay_particles(Run& run, const Scene& scene, const Lay& lay) {
  const InitialParticles initial = make_initial_particles(scene);
  for (int i = 0; i < initial.size(); ++i) {
    auto& a = run.particles.emplace_back();
    a.body = initial.body[i];
    a.clamped = initial.clamped[i];
    lay(a, i, initial);
  }
}

/// The transcriptions have no contact of faces: `penalty` replaces `surface`.
inline Scene with_contact_of_particles(Scene scene, const std::string& method) {
  if (find_method(method)->contact == ContactLaw::surface) scene.contact = ContactLaw::penalty;
  return scene;
}

/// Value in the settings, else the default, else 0.
inline double constant_of(const Settings& settings, int dim, const std::string& name) {
  const auto set = settings.constants.find(name);
  if (set != settings.constants.end()) return set->second;
  for (const MethodConstant& c : method_constants(find_method(settings.method)->formulation, dim))
    if (c.name == name) return c.value;
  return 0;
}

/// [Zhang2024], [Zhang2024b], [SPHinXsys2025]
template <int Dim>
naive::Run<Dim> naive_split(const Scene& scene, const Settings& settings) {
  const Material& material = scene.materials[0];
  naive::Run<Dim> run(naive::method_named(settings.method), settings.stepping == Stepping::dual,
                      scene.spacing, material.density, material.sound_speed(), material.shear_modulus());
  run.cubic_spline = constant_of(settings, Dim, "cubic_spline") != 0;
  run.pressure_diffusion = constant_of(settings, Dim, "pressure_diffusion");
  run.penalty_rotates = constant_of(settings, Dim, "penalty_rotation") != 0;
  lay_particles(run, scene, [&](auto& a, int i, const InitialParticles& initial) {
    a.x = vector_of<naive::Vector<Dim>>(initial.x[i]);
    a.v = vector_of<naive::Vector<Dim>>(initial.v[i]);
    a.m = material.density * initial.V0[i];
  });
  return run;
}

/// [Khayyer2024], [TranDuc2023] §2.2
template <int Dim>
naive_cauchy::Run<Dim> naive_current(const Scene& scene, const Settings& settings) {
  double c0 = 0;
  for (const Material& material : scene.materials) c0 = std::max(c0, material.sound_speed());
  naive_cauchy::Run<Dim> run(naive_cauchy::method_named(settings.method), scene.spacing, c0);
  run.riemann_factor = constant_of(settings, Dim, "riemann_factor");
  run.limiter = static_cast<int>(constant_of(settings, Dim, "limiter"));
  run.geometry = constant_of(settings, Dim, "geometry");
  run.printed_weight = constant_of(settings, Dim, "repulsion_weight") != 0;
  run.diffusion_of_order_0 = constant_of(settings, Dim, "delta_order") == 0;
  lay_particles(run, scene, [&](auto& a, int i, const InitialParticles& initial) {
    const Material& material = scene.materials[initial.material[i]];
    a.r = vector_of<naive_cauchy::Vector<Dim>>(initial.x[i]);
    a.u = vector_of<naive_cauchy::Vector<Dim>>(initial.v[i]);
    a.material = {material.density, material.bulk_modulus(), material.shear_modulus()};
    a.m = material.density * initial.V0[i];
    a.rho = material.density;
    a.of_material = initial.material[i];
  });
  return run;
}

/// Methods and laws of naive_reference::Method.
template <int Dim>
naive_reference::Run<Dim> naive_total_lagrangian(const Scene& scene, const Settings& settings) {
  const Material& material = scene.materials[0];
  naive_reference::Run<Dim> run{naive_reference::method_named(settings.method, settings.law),
                                scene.spacing,
                                constant_of(settings, Dim, "h") * scene.spacing,
                                find_method(settings.method)->cfl,
                                material.density,
                                material.bulk_modulus(),
                                material.shear_modulus(),
                                constant_of(settings, Dim, "contact_stiffness"),
                                {}};
  run.alpha = constant_of(settings, Dim, "alpha");
  run.shear_factor = constant_of(settings, Dim, "shear_factor");
  run.damping = constant_of(settings, Dim, "damping");
  lay_particles(run, scene, [&](auto& a, int i, const InitialParticles& initial) {
    a.X = a.x = vector_of<naive_reference::Vector<Dim>>(initial.x[i]);
    a.v = vector_of<naive_reference::Vector<Dim>>(initial.v[i]);
    a.V = initial.V0[i];
    a.m = material.density * a.V;
  });
  return run;
}

/// [Lee2016]
template <int Dim>
naive_lee::Run<Dim> naive_mixed(const Scene& scene, const Settings& settings) {
  const Material& material = scene.materials[0];
  const std::string& name = settings.method;
  const auto constant = [&](const char* key) { return constant_of(settings, Dim, key); };
  naive_lee::Run<Dim> run{.jst = name != "pf",
                          .with_J = name.starts_with("pfj") || name == "pfhj-jst",
                          .with_H = Dim == 3 && name == "pfhj-jst",
                          .dp = scene.spacing,
                          .h = constant("h") * scene.spacing,
                          .cfl = settings.step > 0 ? 0 : find_method(name)->cfl,
                          .rho0 = material.density,
                          .K = material.bulk_modulus(),
                          .G = material.shear_modulus(),
                          .contact_stiffness = constant("contact_stiffness"),
                          .eps_p2 = constant("eps_v2"),
                          .eps_p4 = constant("eps_v4"),
                          .eps_J2 = constant("eps_J2"),
                          .eps_J4 = constant("eps_J4"),
                          .projection = constant("projection") != 0,
                          .adjoint = constant("adjoint") != 0,
                          .one_sided = constant("internal_force") != 0,
                          .J_in_deviator = constant("deviator_ratio") != 0,
                          .particles = {},
                          .dt = settings.step};
  lay_particles(run, scene, [&](auto& a, int i, const InitialParticles& initial) {
    a.X = a.x = vector_of<naive_lee::Vec<Dim>>(initial.x[i]);
    a.p = material.density * vector_of<naive_lee::Vec<Dim>>(initial.v[i]);
    a.V = initial.V0[i];
  });
  return run;
}

template <class Run>
Run after_steps(Run run, int steps) {
  if constexpr (requires { run.start(); }) run.start();
  for (int k = 0; k < steps; ++k) run.step();
  return run;
}

}  // namespace taut::test
