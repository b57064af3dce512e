#include "engine/diagnostics/balance.hpp"

#include <array>
#include <cmath>

#include "engine/diagnostics/compensated_sum.hpp"
#include "engine/diagnostics/deviator.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"

namespace taut {
namespace {

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The method's own, or V (p²/2K + s:s/4G), J: linear elasticity, with the present volume V = m/ρ.
double strain_energy(const Snapshot& now, std::size_t i, const Material& material) {
  if (!now.strain_energy.empty()) return now.strain_energy[i];
  const double volumetric = now.p[i] * now.p[i] / (2 * material.bulk_modulus());
  const double deviatoric = deviator_squared(now, i) / (4 * material.shear_modulus());
  return now.m[i] / now.rho[i] * (volumetric + deviatoric);
}

Point values(const std::array<CompensatedSum, 3>& sums) {
  return {sums[0].value(), sums[1].value(), sums[2].value()};
}

}  // namespace

Balance balance(const Snapshot& now, const Scene& scene) {
  const auto dim = static_cast<std::size_t>(now.dim);
  CompensatedSum kinetic, strain, momentum_scale, angular_scale;
  std::array<CompensatedSum, 3> linear, angular;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const Point x = now.position(i), v = now.velocity(i), spin = cross(x, v);
    const double m = now.m[i], speed = std::sqrt(dot(v, v));
    kinetic += 0.5 * m * dot(v, v);
    strain += strain_energy(now, i, scene.materials.at(static_cast<std::size_t>(now.material[i])));
    momentum_scale += m * speed;
    angular_scale += m * std::sqrt(dot(x, x)) * speed;
    for (std::size_t a = 0; a < dim; ++a) linear[a] += m * v[a];
    for (std::size_t a = dim == 3 ? 0 : 2; a < 3; ++a) angular[a] += m * spin[a];
  }
  strain += now.contact_energy;
  return {kinetic.value(),       strain.value(), values(linear), values(angular), momentum_scale.value(),
          angular_scale.value(), now.work,       now.damped,     now.of_walls};
}

}  // namespace taut
