#pragma once

#include <compare>
#include <string_view>

namespace taut {

/// A law of contact, given by its name in scene files. terms/contact_laws.hpp lists the laws.
struct ContactLaw {
  std::string_view name;

  auto operator<=>(const ContactLaw&) const = default;

  // laws that code names
  static const ContactLaw published;  // of the method's paper
  static const ContactLaw sph, impulse, penalty, lennard_jones, surface;
};

inline constexpr ContactLaw ContactLaw::published{"published"};
inline constexpr ContactLaw ContactLaw::sph{"sph"};
inline constexpr ContactLaw ContactLaw::impulse{"impulse"};
inline constexpr ContactLaw ContactLaw::penalty{"penalty"};
inline constexpr ContactLaw ContactLaw::lennard_jones{"lennard-jones"};
inline constexpr ContactLaw ContactLaw::surface{"surface"};

constexpr std::string_view name(ContactLaw law) { return law.name; }

}  // namespace taut
