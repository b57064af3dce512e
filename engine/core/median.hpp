#pragma once

#include <span>

namespace taut {

/// Median (the upper of two) of at least one number; reorders them.
double median(std::span<double> some);

}  // namespace taut
