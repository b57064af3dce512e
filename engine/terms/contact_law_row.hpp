#pragma once

#include <string_view>

#include "engine/contact/contact_law.hpp"
#include "engine/term_info.hpp"

namespace taut {

enum class ContactBetween {
  particles,      // pairs of two bodies or a fold; not for finite elements
  faces,          // for methods with initial neighbours
  all_neighbors,  // in the method's own sums; for methods that search neighbours
};

struct ContactLawRow {
  ContactLaw law;
  std::string_view help;
  TermInfo term{};
  ContactBetween between;
  // gap in spacings below which faces count as touching
  double touching = 0.1;

  // Along a pair, N; its energy, J.
  double (*force)(double r, double dp, double K, int dim) = nullptr;
  double (*energy)(double r, double dp, double K, int dim) = nullptr;
  // Instead of a force, N s.
  double (*impulse)(double closing_speed, double inv_m_i, double inv_m_j) = nullptr;
};

}  // namespace taut
