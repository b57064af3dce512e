#include "engine/simulation.hpp"

#include <algorithm>
#include <utility>

#include <fmt/core.h>
#include <fmt/format.h>

#include "engine/core/machine.hpp"
#include "engine/error.hpp"
#include "engine/layout/initial_particles.hpp"
#include "engine/layout/overlap.hpp"
#include "engine/methods/catalogue.hpp"
#include "engine/methods/families.hpp"

namespace taut {
namespace {

void check_constants(const MethodInfo& method, const Settings& settings, int dim) {
  const std::vector<MethodConstant> constants = method_constants(method.formulation, dim);
  for (const auto& [name, value] : settings.constants) {
    const auto constant = std::ranges::find(constants, name, &MethodConstant::name);
    if (constant == constants.end()) {
      std::string known;
      for (const MethodConstant& c : constants) known += (known.empty() ? "" : ", ") + std::string(c.name);
      throw UsageError(fmt::format("method '{}' has no constant '{}'; it has {}", method.name, name, known));
    }
    if (!(value >= constant->low && value <= constant->high))
      throw UsageError(fmt::format("constant '{}' is {:g}; it must be from {:g} to {:g}", name, value,
                                   constant->low, constant->high));
  }
}

/// `parameters`: of the law; the material overrides their defaults.
Elasticity elasticity(const Material& material, std::span<const LawParameter> parameters) {
  Elasticity e{material.density, material.sound_speed(), material.bulk_modulus(), material.shear_modulus()};
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const auto given = material.law_parameters.find(parameters[k].key);
    e.of_law[k] = given == material.law_parameters.end() ? parameters[k].value : given->second;
  }
  return e;
}

std::vector<Elasticity> elasticities(const Scene& scene, const LawRow* law) {
  std::vector<Elasticity> all;
  for (const Material& material : scene.materials)
    all.push_back(elasticity(material, law ? law->parameters : std::span<const LawParameter>{}));
  return all;
}

bool same(const Material& a, const Material& b) {
  return a.density == b.density && a.youngs_modulus == b.youngs_modulus &&
         a.poisson_ratio == b.poisson_ratio && a.bulk_modulus() == b.bulk_modulus() &&
         a.law_parameters == b.law_parameters;
}

std::string of_several() {
  std::string names;
  for (const MethodInfo& method : methods())
    if (method.several_materials) names += (names.empty() ? "" : ", ") + std::string(method.name);
  return names;
}

void check_materials(const Scene& scene, const InitialParticles& initial, const MethodInfo& method) {
  if (method.several_materials) return;
  const int first = initial.material.front();
  for (int i = 0; i < initial.size(); ++i) {
    if (same(scene.materials[initial.material[i]], scene.materials[first])) continue;
    const std::string &body = scene.bodies[initial.body[i]].name, &other = scene.bodies.front().name;
    throw SceneError("body." + body,
                     fmt::format("method '{}' allows only one material; body '{}' has '{}'{} '{}'; "
                                 "methods for several materials: {}",
                                 method.name, body, scene.materials[initial.material[i]].name,
                                 initial.body[i] == 0 ? " and" : fmt::format(", but body '{}' has", other),
                                 scene.materials[first].name, of_several()));
  }
}

void check_displacements(const Scene& scene, const MethodInfo& method) {
  if (method.keeps_neighbors) return;
  for (const Body& body : scene.bodies)
    for (const Expression& component : body.displacement)
      if (component)
        throw SceneError(
            fmt::format("body.{}.displacement", body.name),
            fmt::format("method '{}' has no reference configuration: body '{}' would start displaced, "
                        "but without stress; use a method with initial neighbours, such as tl or oenog",
                        method.name, body.name));
}

/// Throws SceneError for bodies behind walls. Clamped regions may be inside walls.
void check_walls(const Scene& scene, const InitialParticles& initial) {
  constexpr double round_off = 1e-6;  // spacings
  const double dp = scene.spacing;
  for (const Wall& wall : scene.walls) {
    for (int i = 0; i < initial.size(); ++i) {
      const Body& body = scene.bodies[initial.body[i]];
      Point deep = initial.at_start(i);
      double height = 0;
      for (std::size_t k = 0; k < 3; ++k) height += (deep[k] - wall.at[k]) * wall.normal[k];
      if (initial.clamped[i] || height > dp) continue;
      const auto refuse = [&](const std::string& how) {
        throw SceneError(
            "wall." + wall.name,
            fmt::format("body '{}' starts inside the wall '{}': {}; move one of them, or reverse the normal",
                        body.name, wall.name, how));
      };
      if (height < -round_off * dp)
        refuse(fmt::format("one of its particles is {:g} m behind the face of the wall", -height));
      for (std::size_t k = 0; k < 3; ++k) deep[k] -= (height + greatest_depth * dp) * wall.normal[k];
      if (body.clamped && body.clamped(deep) != 0) continue;
      if (is_undisplaced(body) && holds(body, deep, scene.dim, -round_off * dp))
        refuse(
            fmt::format("its face is more than {:g} spacings behind the face of the wall", greatest_depth));
    }
  }
}

Constants common_constants(const std::vector<Elasticity>& materials, const InitialParticles& initial,
                           const Scene& scene, const Settings& settings, const MethodInfo& method,
                           const ConstantValues& values) {
  const std::vector<int>& material = initial.material;
  Constants c{materials[material.front()]};
  for (const int used : material) c.c0 = std::max(c.c0, materials[used].c0);
  c.dp = scene.spacing;
  const auto h = values.find("h");
  c.h = h == values.end() ? c.dp : h->second;
  c.contact_stiffness = values.at("contact_stiffness");
  c.cfl = settings.cfl > 0 ? settings.cfl : method.cfl;
  c.step = settings.step;
  return c;
}

int useful_threads(int particles) {
  constexpr int least_particles = 300;  // per thread
  return std::clamp(particles / least_particles, 1, cores());
}

}  // namespace

std::unique_ptr<Simulation> make_simulation(const Scene& given, const Settings& settings) {
  const MethodInfo* method = find_method(settings.method);
  if (!method) throw UsageError(fmt::format("there is no method '{}'", settings.method));
  Scene scene = given;
  scene.element_order = method->formulation.element_order;
  if (scene.bodies.empty()) throw SceneError("body", "the scene has no particles; add a [[body]]");
  const InitialParticles initial = make_initial_particles(scene);
  check_materials(scene, initial, *method);
  check_walls(scene, initial);
  check_displacements(scene, *method);
  const LawRow* law = law_row(*method, settings);
  const std::vector<Elasticity> materials = elasticities(scene, law);
  const int threads = settings.threads > 0 ? settings.threads : useful_threads(initial.size());
  check_constants(*method, settings, scene.dim);
  const ConstantValues values = constant_values(method->formulation, scene.dim, scene.spacing, settings);
  const SolverInput input{method->formulation,
                          scene,
                          initial,
                          common_constants(materials, initial, scene, settings, *method, values),
                          materials,
                          law ? law->law : Law::none,
                          contact_law(scene, *method),
                          method->keeps_neighbors,
                          settings.stepping,
                          threads,
                          settings.instruction_set,
                          values};
  return row_of(method->formulation.family).make(input);
}

}  // namespace taut
