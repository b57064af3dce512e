#include "engine/simulation.hpp"

#include <algorithm>

#include <omp.h>

#include "engine/error.hpp"
#include "engine/families/catalogue.hpp"
#include "engine/families/make_solver.hpp"
#include "engine/scene/initial_particles.hpp"

namespace taut {
namespace {

/// The default of each constant of the method, unless the settings say otherwise.
class ConstantValues {
 public:
  ConstantValues(const MethodInfo& method, const Settings& settings) : method_(method), settings_(settings) {
    for (const auto& [name, value] : settings.constants) {
      const MethodConstant* constant = find(name);
      if (!constant)
        throw UsageError("method '" + std::string(method.name) + "' has no constant '" + name + "'; it has " +
                         names());
      if (!(value >= constant->low && value <= constant->high))
        throw UsageError("constant '" + name + "' is " + std::to_string(value) + "; allowed is " +
                         std::to_string(constant->low) + " to " + std::to_string(constant->high));
    }
  }
  double operator()(std::string_view name) const {
    if (const auto it = settings_.constants.find(std::string(name)); it != settings_.constants.end())
      return it->second;
    const MethodConstant* constant = find(name);
    return constant ? constant->value : 0;
  }

 private:
  const MethodConstant* find(std::string_view name) const {
    for (const MethodConstant& c : method_.constants)
      if (c.name == name) return &c;
    return nullptr;
  }
  std::string names() const {
    std::string all;
    for (const MethodConstant& c : method_.constants) all += (all.empty() ? "" : ", ") + std::string(c.name);
    return all;
  }

  const MethodInfo& method_;
  const Settings& settings_;
};

Elasticity elasticity(const Material& material) {
  return {material.density, material.sound_speed(), material.bulk_modulus(), material.shear_modulus()};
}

std::vector<Elasticity> elasticities(const Scene& scene) {
  std::vector<Elasticity> all;
  for (const Material& material : scene.materials) all.push_back(elasticity(material));
  return all;
}

bool same(const Material& a, const Material& b) {
  return a.density == b.density && a.youngs_modulus == b.youngs_modulus &&
         a.poisson_ratio == b.poisson_ratio && a.bulk_modulus() == b.bulk_modulus();
}

/// Throws SceneError if the scene has several materials and the method takes one.
void check_materials(const Scene& scene, const InitialParticles& layout, const MethodInfo& method) {
  if (method.several_materials) return;
  const int first = layout.material.front();
  for (int i = 0; i < layout.size(); ++i) {
    if (same(scene.materials[layout.material[i]], scene.materials[first])) continue;
    const std::string& body = scene.bodies[layout.body[i]].name;
    throw SceneError("body." + body, "method '" + std::string(method.name) + "' takes one material; body '" +
                                         body + "' has '" + scene.materials[layout.material[i]].name +
                                         "' where body '" + scene.bodies.front().name + "' has '" +
                                         scene.materials[first].name + "'");
  }
}

/// Throws SceneError for a body that begins inside a wall.
void check_walls(const Scene& scene, const InitialParticles& layout) {
  for (const Wall& wall : scene.walls) {
    for (int i = 0; i < layout.size(); ++i) {
      double height = 0;
      for (std::size_t k = 0; k < 3; ++k) height += (layout.x[i][k] - wall.at[k]) * wall.normal[k];
      if (layout.held[i] || height >= 0) continue;
      const std::string& body = scene.bodies[layout.body[i]].name;
      throw SceneError("wall." + wall.name, "body '" + body + "' begins inside the wall '" + wall.name +
                                                "': a particle of it is " + std::to_string(-height) +
                                                " m behind its face; move one of them, or turn the normal");
    }
  }
}

Constants make_constants(const std::vector<Elasticity>& materials, int first, const Scene& scene,
                         const Settings& settings, const MethodInfo& method) {
  const ConstantValues value(method, settings);
  Constants c{materials[first]};
  for (const Elasticity& material : materials) c.c0 = std::max(c.c0, material.c0);
  c.dp = scene.spacing;
  c.h = value("h") * scene.spacing;
  c.zeta = value("zeta");
  c.epsilon = value("epsilon");
  c.exponent = value("exponent");
  c.riemann_limiter = value("riemann_limiter");
  c.beta_least = value("beta_least");
  c.pressure_diffusion = value("pressure_diffusion");
  c.contact_stiffness = value("contact_stiffness");
  c.alpha = value("alpha");
  c.xsph = value("xsph");
  c.geometry = value("geometry");
  c.damping = value("damping");
  c.delta = value("delta");
  c.riemann_factor = value("riemann_factor");
  c.surface_colour = value("surface_colour");
  c.vicinity = value("vicinity");
  c.surface_artificial_stress = value("surface_artificial_stress");
  c.normalised = value("normalised");
  c.eps_v2 = value("eps_v2");
  c.eps_v4 = value("eps_v4");
  c.eps_J2 = value("eps_J2");
  c.eps_J4 = value("eps_J4");
  c.adjoint = value("adjoint");
  c.projection = value("projection");
  c.cfl = settings.cfl > 0 ? settings.cfl : method.cfl;
  c.cfl_advection = value("cfl_advection");
  c.step = settings.step;
  return c;
}

/// Of the law of the settings among those of the method. Throws UsageError if it is none of them.
std::size_t law_index(const MethodInfo& method, const Settings& settings) {
  if (settings.law.empty()) return 0;
  std::string known;
  for (std::size_t k = 0; k < method.laws.size(); ++k) {
    if (method.laws[k].name == settings.law) return k;
    known += (known.empty() ? "" : ", ") + std::string(method.laws[k].name);
  }
  throw UsageError("method '" + std::string(method.name) + "' has no law '" + settings.law + "'; " +
                   (known.empty() ? "its own cannot be changed" : "it has: " + known));
}

bool has_x86_64_v3() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

}  // namespace

std::string_view material_law(const MethodInfo& method, const Settings& settings) {
  return method.laws.empty() && settings.law.empty() ? method.material_law
                                                     : method.laws[law_index(method, settings)].material_law;
}

ContactLaw contact_law(const Scene& scene, const MethodInfo& method) {
  if (scene.contact == ContactLaw::published) return method.contact;
  std::string known;
  for (const ContactLaw law : method.contact_laws) {
    if (law == scene.contact) return law;
    known += (known.empty() ? "" : ", ") + std::string(name(law));
  }
  throw SceneError("contact", "method '" + std::string(method.name) + "' cannot run with the contact law '" +
                                  std::string(name(scene.contact)) +
                                  "': its particles act on their neighbours of the start, not on what comes "
                                  "near; it can with: " +
                                  known);
}

std::unique_ptr<Simulation> make_simulation(const Scene& scene, const Settings& settings) {
  const MethodInfo* method = find_method(settings.method);
  if (!method) throw UsageError("there is no method '" + settings.method + "'");
  if (scene.dim != 2) throw SceneError("dim", "only dim = 2 is available in this version");
  if (scene.bodies.empty()) throw SceneError("body", "the scene has no particles; add a [[body]]");
  const InitialParticles layout = make_initial_particles(scene);
  check_materials(scene, layout, *method);
  check_walls(scene, layout);
  const std::vector<Elasticity> materials = elasticities(scene);
  const int threads = settings.threads > 0 ? settings.threads : omp_get_max_threads();
  const SolverInput input{scene,
                          layout,
                          make_constants(materials, layout.material.front(), scene, settings, *method),
                          materials,
                          free_laws[law_index(*method, settings)],
                          contact_law(scene, *method),
                          settings.stepping,
                          threads};
#if defined(__x86_64__)
  if (settings.instruction_set == InstructionSet::best && has_x86_64_v3())
    return x86_64_v3::make_solver(settings.method, input);
#endif
  return make_solver(settings.method, input);
}

}  // namespace taut
