#pragma once

#include <cstdint>

namespace taut {

/// Each has a specialisation of Kernel in engine/kernels/kernel.hpp.
enum class KernelName : std::uint8_t { wendland_c2, cubic_spline, sinc, gauss };

}  // namespace taut
