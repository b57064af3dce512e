#pragma once

#include <string_view>

#include "engine/contact/contact_law.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// Partners of a contact law; they determine which methods can run with it.
enum class ContactBetween {
  particles,      // pairs of two bodies or a fold, less than a spacing apart; all methods
  faces,          // methods with initial neighbours
  all_neighbors,  // the method's own sums; methods that search neighbours
};

/// A contact law, defined in its own header and listed in contact_laws.hpp.
struct ContactLawRow {
  ContactLaw law;
  std::string_view help;
  TermInfo term{};
  ContactBetween between;
  // gap below which faces count as touching, spacings; above 0, since particles of oblique faces touch earlier
  double touching = 0.1;

  // Force along a pair, N, and its energy, J, both per metre depth in 2D, for r < dp, m; K: contact modulus, Pa. For
  // particles, or in `sph` for walls.
  double (*force)(double r, double dp, double K, int dim) = nullptr;
  double (*energy)(double r, double dp, double K, int dim) = nullptr;
  // Impulse instead of a force, N s (per metre depth in 2D); inverse masses in 1/kg.
  double (*impulse)(double closing_speed, double inv_m_i, double inv_m_j) = nullptr;
};

}  // namespace taut
