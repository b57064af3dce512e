#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

#include "engine/contact/contact_law.hpp"
#include "engine/kernels/kernel_name.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// The algorithm that runs a method, a folder of engine/methods/.
enum class Family : std::uint8_t {
  ul_split,         // updated Lagrangian, pressure and shear stress act apart; [Zhang2024] §5
  ul_cauchy,        // updated Lagrangian, the divergence of σ = −pI + s as a whole; [Khayyer2024] Eq. 9
  bonded,           // an energy of bonds between initial neighbours; ours, terms/bond.hpp
  tl_displacement,  // first Piola–Kirchhoff stress on initial pairs, F from the positions; [Lee2016] Eq. 29c
  tl_mixed,         // the same with F as an unknown of its own; [Lee2016] §3.3.2
};

/// The trace that is taken from the strain rate: two different materials in plane strain.
enum class Deviator : std::uint8_t {
  in_plane,      // 1/d of the trace, [Zhang2024] Eq. 7: in-plane bulk modulus K, s_zz = 0
  plane_strain,  // 1/3 of the trace, [Khayyer2024] Eq. 6: in-plane bulk modulus K + G/3
};

/// The data that every method has. Each family derives a struct that adds its switches; named values of these structs,
/// and nothing else, are instantiated.
struct Formulation {
  std::string_view name;
  std::string_view paper;
  std::string_view summary;
  std::string_view conserves;
  Family family = Family::ul_split;
  int greatest_dim = 3;                      // of the scenes that it can run
  std::span<const Citation> citations = {};  // of the paper, where its family cites another one
  Deviator deviator = Deviator::in_plane;
  KernelName kernel = KernelName::wendland_c2;
  ContactLaw contact = ContactLaw::sph;  // the published one
  double contact_stiffness = 1;          // of the penalty, see terms/penalty_contact.hpp
  bool several_materials = false;        // in one scene
  double h_over_dp = 1.3;                // smoothing length over spacing
  double h_over_dp_3d = 0;               // 0: as in the plane
  double cfl = 0.4;                      // acoustic, [Zhang2024] Eq. 22
};

/// The method as the type `F` of its family; null if it belongs to another family.
template <class F>
constexpr const F* as(const Formulation& m) {
  return m.family == F::own_family ? static_cast<const F*>(&m) : nullptr;
}

/// A family may have an overload of its own, which is asked, too.
constexpr bool consistent(const Formulation& m) {
  return m.h_over_dp > 0 && m.h_over_dp_3d >= 0 && m.cfl > 0 && !m.name.empty();
}

/// Methods of one family. Mixtures that make no sense are refused at compile time.
template <const auto&... M>
struct MethodList {
  static_assert(((consistent(static_cast<const Formulation&>(M)) && consistent(M) &&
                  M.family == std::remove_cvref_t<decltype(M)>::own_family) &&
                 ...));
  static constexpr int size = sizeof...(M);
};

}  // namespace taut
