#pragma once

#include <string_view>

#include "engine/contact/contact_law.hpp"
#include "engine/term_info.hpp"

namespace taut {

/// What acts by a law of contact. It decides which methods can run with the law.
enum class ContactBetween {
  particles,      // pairs of two bodies or of a fold, less than a spacing apart; every method
  faces,          // faces move with initial neighbours; methods that keep their initial neighbours
  all_neighbors,  // the method's own sums, as within a body; methods that search neighbours
};

/// A law of contact. Each header of a law defines its row; contact_laws.hpp lists the rows.
struct ContactLawRow {
  ContactLaw law;
  std::string_view help;
  TermInfo term{};
  ContactBetween between;
  // initial gap of two faces that are about to touch, in spacings; particles of oblique faces touch before the faces
  double touching = 0.1;

  // A law between particles has a force with its energy, or an impulse; `sph` has a force and an energy for walls. The
  // force along a pair, N, and its energy, J (both per metre depth in 2D), at a distance r < dp, m; K: modulus of the
  // contact, Pa.
  double (*force)(double r, double dp, double K, int dim) = nullptr;
  double (*energy)(double r, double dp, double K, int dim) = nullptr;
  // Instead of a force: the impulse along a pair, N s (per metre depth in 2D); inverse masses in 1/kg.
  double (*impulse)(double closing_speed, double inv_m_i, double inv_m_j) = nullptr;
};

}  // namespace taut
