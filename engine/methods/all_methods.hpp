#pragma once

#include <array>

#include "engine/methods/bonded/methods.hpp"
#include "engine/methods/finite_elements/methods.hpp"
#include "engine/methods/tl_displacement/methods.hpp"
#include "engine/methods/tl_mixed/methods.hpp"
#include "engine/methods/ul_cauchy/methods.hpp"
#include "engine/methods/ul_split/methods.hpp"

namespace taut {

/// In listing order. The index selects the colour in charts: append new methods.
inline constexpr std::array<const Formulation*, 27> all_methods{&og,
                                                                &oas,
                                                                &enog,
                                                                &enog_nonconservative,
                                                                &oenog,
                                                                &ulsph_av_as_uncorrected,
                                                                &ulsph_av_as,
                                                                &d_ulsph_av_as,
                                                                &d_ulsph_av_tic,
                                                                &d_ulsph_r_as,
                                                                &ulsph_r_tic,
                                                                &d_ulsph_r_tic,
                                                                &ccb,
                                                                &ccbwat,
                                                                &icb,
                                                                &tl,
                                                                &pf,
                                                                &pf_jst,
                                                                &pfj_jst,
                                                                &pfhj_jst,
                                                                &tl_small_strain,
                                                                &gnog,
                                                                &tl_hg,
                                                                &tl_enog,
                                                                &fe1,
                                                                &fe2,
                                                                &gnog_amc};
static_assert(all_methods.size() == ul_split::Methods::size + ul_cauchy::Methods::size +
                                        bonded::Methods::size + tl_displacement::Methods::size +
                                        tl_mixed::Methods::size + finite_elements::Methods::size);

}  // namespace taut
