#include "engine/methods/tl_mixed/describe.hpp"

#include "engine/materials/laws.hpp"
#include "engine/methods/tl_mixed/boundary_projection.hpp"
#include "engine/methods/tl_mixed/passes.hpp"
#include "engine/solver/initial_configuration.hpp"
#include "engine/terms/contact_laws.hpp"

namespace taut::tl_mixed {
namespace {

constexpr TermInfo time_info{"time", "TVD Runge–Kutta, two stages", "[Lee2016] Eq. 43",
                             "methods/tl_mixed/solver.cpp:step",
                             "mixed: a colliding ring and disc follow the transcription"};

constexpr std::string_view internal_force_names[] = {"conservative", "one-sided"};
constexpr std::string_view deviator_ratio_names[] = {"det-F", "J"};

}  // namespace

std::vector<TermInfo> terms(const TlMixedFormulation& m) {
  std::vector<TermInfo> t{deformation_rate_info};
  if (follows_volume_ratio(m)) t.push_back(volume_ratio_info);
  if (m.unknowns == Unknowns::v_F_H_J) t.push_back(cofactor_info);
  t.insert(t.end(), {law_row(m.law).term, internal_force_info});
  if (m.jst) t.push_back(corrected_laplacian_info);
  t.insert(t.end(), {projection_info, boundary_projection_info, contact_info(m.contact), time_info});
  return t;
}

std::vector<ConstantRow<TlMixedConstants>> constants(const TlMixedFormulation& m, int dim) {
  using C = TlMixedConstants;
  std::vector<ConstantRow<TlMixedConstants>> c{{&C::h, smoothing_length(m, dim, 0.8)}};
  if (m.jst) {
    c.push_back({&C::eps_v2, {"eps_v2", 0.0, 0.0, 1.0, "ε₂ of the momentum, for shocks"}});
    c.push_back({&C::eps_v4, {"eps_v4", 0.125, 0.0, 1.0, "ε₄ of the momentum, against zigzags"}});
    c.push_back(
        {&C::adjoint,
         {"adjoint", 1.0, 0.0, 1.0, "1: biharmonic term L*[L[U]], damps all modes; 0: L[L[U]] as printed"}});
  }
  if (m.jst && follows_volume_ratio(m)) {
    c.push_back({&C::eps_J2, {"eps_J2", 0.0, 0.0, 1.0, "ε₂ of the volume ratio"}});
    c.push_back(
        {&C::eps_J4,
         {"eps_J4", 1.0 / 256, 0.0, 1.0,
          "ε₄ of the volume ratio; 1/8 suits near incompressibility, but faces in contact fail with it"}});
  }
  if (follows_volume_ratio(m))
    c.push_back({&C::deviator_ratio,
                 {.name = "deviator_ratio",
                  .value = 0,
                  .low = 0,
                  .high = 1,
                  .help = "volume ratio in the deviator; J: the unknown, Eq. 8 as printed",
                  .choices = deviator_ratio_names}});
  c.push_back({&C::internal_force,
               {.name = "internal_force",
                .value = 0,
                .low = 0,
                .high = 1,
                .help = "conservative: Eq. 29c; one-sided: Eq. 30 with corrected gradients, Remark 4",
                .choices = internal_force_names}});
  c.push_back({&C::projection,
               {"projection", 1.0, 0.0, 1.0, "1: projects forces to conserve both momenta; 0: does not"}});
  c.push_back(
      {&C::boundary_projection,
       switch_constant("boundary_projection", 0,
                       "1: kernel sums of velocities have the values of clamped and prescribed particles; "
                       "0: they do not")});
  return c;
}

}  // namespace taut::tl_mixed
