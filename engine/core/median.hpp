#pragma once

#include <span>

namespace taut {

/// The middle one of some numbers, of which there is one at least; puts them in another order.
double median(std::span<double> some);

}  // namespace taut
