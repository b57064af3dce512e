#pragma once

#include "engine/methods/lee2016.hpp"
#include "engine/methods/tl_mixed/formulation.hpp"

namespace taut {

inline constexpr TlMixedFormulation pf{
    lee2016({
        .name = "pf",
        .paper = "Lee2016 §3.3",
        .summary = "momentum and deformation gradient as unknowns, no dissipation: zigzag modes grow",
        .conserves = "linear momentum, angular momentum",
        .family = Family::tl_mixed,
    }),
    {.law = Law::neo_hookean, .others = OtherLaws::all},
    {.unknowns = Unknowns::v_F}};
inline constexpr TlMixedFormulation pf_jst{
    lee2016({
        .name = "pf-jst",
        .paper = "Lee2016 §3.4, §6",
        .summary = "pf with Jameson–Schmidt–Turkel dissipation: no zigzag modes up to Poisson's ratio 0.495",
        .conserves = "linear momentum, angular momentum",
        .family = Family::tl_mixed,
    }),
    {.law = Law::neo_hookean, .others = OtherLaws::all},
    {.unknowns = Unknowns::v_F, .jst = true}};
inline constexpr TlMixedFormulation pfj_jst{
    lee2016({
        .name = "pfj-jst",
        .paper = "Lee2016 §3.4, §6",
        .summary = "pf-jst with the volume ratio as an unknown: smooth pressure near incompressibility",
        .conserves = "linear momentum, angular momentum",
        .family = Family::tl_mixed,
    }),
    {.law = Law::neo_hookean, .others = OtherLaws::with_volume_ratio},
    {.unknowns = Unknowns::v_F_J, .jst = true}};
inline constexpr TlMixedFormulation pfhj_jst{
    lee2016({
        .name = "pfhj-jst",
        .paper = "Lee2016 §4",
        .summary =
            "pfj-jst with the cofactor of the deformation gradient as another unknown: for laws that use it",
        .conserves = "linear momentum, angular momentum",
        .family = Family::tl_mixed,
    }),
    {.law = Law::neo_hookean, .others = OtherLaws::with_volume_ratio},
    {.unknowns = Unknowns::v_F_H_J, .jst = true}};

namespace tl_mixed {
using Methods = MethodList<pf, pf_jst, pfj_jst, pfhj_jst>;
}

}  // namespace taut
