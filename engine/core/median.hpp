#pragma once

#include <span>

namespace taut {

/// Upper median of at least one number; reorders them.
double median(std::span<double> some);

}  // namespace taut
