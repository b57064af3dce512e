#pragma once

#include <algorithm>
#include <array>

#include "engine/terms/contact_law_row.hpp"
#include "engine/terms/impulse_contact.hpp"
#include "engine/terms/lennard_jones_contact.hpp"
#include "engine/terms/penalty_contact.hpp"
#include "engine/terms/surface_contact.hpp"

namespace taut {

/// The method's own sums act between bodies, `force` at walls.
inline constexpr ContactLawRow sph_contact{
    .law = ContactLaw::sph,
    .help = "forces of the method also act between bodies, [Zhang2024]; needs searched neighbours",
    .between = ContactBetween::all_neighbors,
    .touching = 0.9,  // particles repel each other before faces meet
    .force = penalty_force,
    .energy = penalty_energy,
};

/// In the order of display.
inline constexpr std::array contact_laws{sph_contact, impulse_contact, penalty_contact, lennard_jones_contact,
                                         surface_contact};

constexpr const ContactLawRow& contact_row(ContactLaw law) {
  return *std::ranges::find(contact_laws, law, &ContactLawRow::law);
}

constexpr const TermInfo& contact_info(ContactLaw law) { return contact_row(law).term; }

}  // namespace taut
