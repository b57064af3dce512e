#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

#include "engine/contact/contact_law.hpp"
#include "engine/kernels/kernel_name.hpp"
#include "engine/term_info.hpp"

namespace taut {

enum class Family : std::uint8_t {
  ul_split,         // separate pressure and shear, [Zhang2024] §3
  ul_cauchy,        // divergence of the Cauchy stress, [Khayyer2024] Eq. 9
  bonded,           // energy of bonds, terms/bond.hpp
  tl_displacement,  // F from positions, [Lee2016] Eq. 34
  tl_mixed,         // F is an unknown, [Lee2016] §3.3.2
  finite_elements,  // particles are nodes
};

/// Share of the trace that the deviator removes.
enum class Deviator : std::uint8_t {
  in_plane,      // 1/d, [Zhang2024] Eq. 7; in 2D s_zz = 0
  plane_strain,  // 1/3, [Khayyer2024] Eq. 6
};

struct Formulation {
  std::string_view name;
  std::string_view paper;
  std::string_view summary;
  std::string_view conserves;
  Family family = Family::ul_split;
  std::span<const Citation> citations = {};  // replace sources and tests of terms
  Deviator deviator = Deviator::in_plane;
  KernelName kernel = KernelName::wendland_c2;
  ContactLaw contact = ContactLaw::sph;  // unless the scene chooses another
  double contact_stiffness = 1;          // see the contact law in terms/
  bool several_materials = false;
  double h_over_dp = 1.3;
  double h_over_dp_3d = 0;  // 0: as in 2D
  double cfl = 0.4;         // acoustic, [Zhang2024] Eq. 22
  int element_order = 0;    // 0 = particles
};

template <class F>
constexpr const F* as(const Formulation& m) {
  return m.family == F::own_family ? static_cast<const F*>(&m) : nullptr;
}

/// Families may add overloads.
constexpr bool consistent(const Formulation& m) {
  return m.h_over_dp > 0 && m.h_over_dp_3d >= 0 && m.cfl > 0 && !m.name.empty();
}

template <const auto&... M>
struct MethodList {
  static_assert(((consistent(static_cast<const Formulation&>(M)) && consistent(M) &&
                  M.family == std::remove_cvref_t<decltype(M)>::own_family) &&
                 ...));
  static constexpr int size = sizeof...(M);
};

}  // namespace taut
