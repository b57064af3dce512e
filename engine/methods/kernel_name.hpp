#pragma once

namespace taut {

enum class KernelName : unsigned char { wendland_c2, sinc, gauss };

}  // namespace taut
