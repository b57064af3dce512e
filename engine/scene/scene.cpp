#include "engine/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace taut {

double Material::sound_speed() const { return std::sqrt(bulk_modulus() / density); }

bool has_drives(const Scene& scene) {
  return std::ranges::any_of(scene.bodies, [](const Body& body) { return !body.drives.empty(); });
}

bool has_guides(const Scene& scene) {
  return std::ranges::any_of(scene.bodies, [](const Body& body) {
    return std::ranges::any_of(body.guided, [](const Expression& along) { return along != nullptr; });
  });
}

bool has_gravity(const Scene& scene) {
  return std::ranges::any_of(scene.gravity, [](const auto& component) { return component != nullptr; });
}

bool has_loads(const Scene& scene) {
  return has_gravity(scene) ||
         std::ranges::any_of(scene.bodies, [](const Body& body) { return !body.loads.empty(); });
}

std::string_view name(Load::Kind kind) {
  constexpr std::string_view names[] = {"force", "force_density", "traction"};
  return names[static_cast<int>(kind)];
}

std::string_view name(ContactLaw law) {
  constexpr std::string_view names[] = {"published", "sph", "impulse", "penalty", "lennard-jones", "surface"};
  return names[static_cast<int>(law)];
}

double fitted_spacing(const Body& first, int dim, double spacing) {
  const double extent = std::visit([&](const auto& s) { return s.thinnest(dim); }, first.shapes.front());
  const double fitted = extent / std::max(1.0, std::round(extent / spacing));
  return std::abs(fitted - spacing) <= 1e-9 * spacing ? spacing : fitted;  // 0.04 − 0.03 is not quite 0.01
}

}  // namespace taut
