#include "engine/methods/tl_displacement/describe.hpp"

#include "engine/materials/laws.hpp"
#include "engine/solver/initial_configuration.hpp"
#include "engine/solver/initial_pairs.hpp"
#include "engine/terms/contact_laws.hpp"

namespace taut::tl_displacement {
namespace {

constexpr TermInfo time_info{"time", "position Verlet, one step", "[Zhang2020] Eq. 10, 11",
                             "methods/tl_displacement/solver.cpp:step",
                             "total Lagrangian: a colliding ring and disc follow the transcription"};

}  // namespace

std::vector<TermInfo> terms(const TlDisplacementFormulation& m) {
  return {deformation_info, law_row(m.law).term, internal_force_info, contact_info(m.contact), time_info};
}

std::vector<ConstantRow<TlDisplacementConstants>> constants(const TlDisplacementFormulation& m, int dim) {
  using C = TlDisplacementConstants;
  if (m.gradient == GradientCorrection::corrected) return {{&C::h, smoothing_length(m, dim, 0.8)}};
  return {
      {&C::h, smoothing_length(m, dim, 0.36)},  // selects the four nearest
      {&C::normalised,
       {"normalised", 1.0, 0.0, 1.0, "1: gradients divided by the sum of the kernel; 0: not", false, true}}};
}

}  // namespace taut::tl_displacement
