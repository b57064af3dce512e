#include "engine/methods/tl_displacement/describe.hpp"

#include "engine/materials/laws.hpp"
#include "engine/solver/initial_configuration.hpp"
#include "engine/solver/initial_pairs.hpp"
#include "engine/terms/contact_laws.hpp"
#include "engine/terms/hourglass/hourglass_force.hpp"
#include "engine/terms/hourglass/pair_shear.hpp"

namespace taut::tl_displacement {
namespace {

constexpr TermInfo time_info{"time", "position Verlet, one step", "[Zhang2020] Eq. 10, 11",
                             "methods/tl_displacement/solver.cpp:step",
                             "total Lagrangian: a colliding ring and disc follow the transcription"};

}  // namespace

std::vector<TermInfo> terms(const TlDisplacementFormulation& m) {
  std::vector<TermInfo> t{deformation_info, law_row(m.law).term};
  if (m.pair_force == PairForce::shear)
    t.insert(t.end(), {isotropic_stress_info, pair_shear_info});
  else
    t.push_back(internal_force_info);
  if (m.pair_force == PairForce::hourglass) t.push_back(hourglass_force_info);
  t.insert(t.end(), {contact_info(m.contact), time_info});
  return t;
}

std::vector<ConstantRow<TlDisplacementConstants>> constants(const TlDisplacementFormulation& m, int dim) {
  using C = TlDisplacementConstants;
  const bool corrected = m.gradient == GradientCorrection::corrected;
  // with 0.36 the support 3 h just includes the nearest neighbours
  const double least_h = corrected ? 0.8 : 0.36;
  std::vector<ConstantRow<C>> c{{&C::h, smoothing_length(m, dim, least_h)}};
  if (!corrected)
    c.push_back({&C::normalised,
                 {"normalised", 1.0, 0.0, 1.0, "1: divides gradients by the sum of the kernel; 0: does not",
                  false, true}});
  if (m.pair_force == PairForce::hourglass)
    c.push_back({&C::alpha, {"alpha", 10.0, 0.0, 20.0, "amplitude α of the hourglass force", false, true}});
  if (m.pair_force == PairForce::shear) {
    c.push_back(
        {&C::shear_factor,
         {"shear_factor", 1.07, 0.5, 2.0, "factor of the shear modulus (1: consistent)", false, true}});
    c.push_back({&C::damping,
                 {"damping", 1.0, 0.0, 10.0, "damping relative to χ = ½ ρ0 c0 h of the paper", false, true}});
  }
  return c;
}

}  // namespace taut::tl_displacement
