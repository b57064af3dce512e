#pragma once

#include "engine/core/tensor.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// Term j of (û_i − u_i)/ε, m/s. [Khayyer2024] Eq. 14
template <class T, int Dim>
Vec<T, Dim> xsph_term(const Vec<T, Dim>& v_ij, const T& rho_i, const T& rho_j, const T& V_j, const T& W) {
  return T(-2 * rho_j * V_j / (rho_i + rho_j) * W) * v_ij;
}
inline constexpr TermInfo xsph_info{"transport velocity", "û = u + ε Σ 2 m_j/(ρ_i + ρ_j) (u_j − u_i) W",
                                    "[Khayyer2024] Eq. 14", "terms/xsph.hpp:xsph_term",
                                    "xsph: the transport velocity conserves momentum and angular momentum"};

}  // namespace taut
