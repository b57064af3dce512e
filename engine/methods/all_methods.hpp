#pragma once

#include "engine/methods/khayyer2024.hpp"
#include "engine/methods/lee2016.hpp"
#include "engine/methods/oenog.hpp"
#include "engine/methods/tranduc2023.hpp"
#include "engine/methods/zhang2020.hpp"
#include "engine/methods/zhang2024.hpp"

namespace taut {

/// Every method, in the order in which they are listed. A method is one value in the file of its
/// paper and its name here.
template <const Formulation&... M>
struct MethodList {
  static_assert((consistent(M) && ...));
};
using Methods = MethodList<og, oas, enog, enog_nonconservative, oenog, ulsph_av_as_uncorrected, ulsph_av_as,
                           d_ulsph_av_as, d_ulsph_av_tic, d_ulsph_r_as, ulsph_r_tic, d_ulsph_r_tic, ccb,
                           ccbwat, icb, tl, pf, pf_jst, pfj_jst, pfhj_jst, tl_small_strain>;

}  // namespace taut
