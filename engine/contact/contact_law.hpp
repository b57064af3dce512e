#pragma once

#include <compare>
#include <string_view>

namespace taut {

struct ContactLaw {
  std::string_view name;

  auto operator<=>(const ContactLaw&) const = default;

  static const ContactLaw published;  // the default law of the method
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
