#pragma once

#include <cstdint>

namespace taut {

enum class KernelName : std::uint8_t { wendland_c2, cubic_spline, sinc, gauss };

}  // namespace taut
