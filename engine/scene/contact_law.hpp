#pragma once

#include <cstdint>
#include <string_view>

namespace taut {

/// How bodies act on each other.
enum class ContactLaw : std::uint8_t {
  published,      // the law of the method's paper
  sph,            // as particles of one body do, [Zhang2024]
  impulse,        // the approach of two particles is stopped, [Khayyer2024] Eq. 53, 54
  penalty,        // a spring of the bulk modulus, [TranDuc2023] Eq. 2.13–2.15
  lennard_jones,  // one that hardens the nearer they come, [Zhang2020] Eq. 12
  surface,        // a spring between faces where they overlap; ours
};

constexpr std::string_view name(ContactLaw law) {
  constexpr std::string_view names[] = {"published", "sph", "impulse", "penalty", "lennard-jones", "surface"};
  return names[static_cast<int>(law)];
}

}  // namespace taut
