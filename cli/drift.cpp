#include "cli/drift.hpp"

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

/// What is left of it when the work of what acts from outside is taken off.
double energy(const Balance& sums) { return sums.kinetic + sums.strain - sums.work + sums.damped; }

std::optional<double> ratio(double change, double scale) {
  return scale > 0 ? std::optional(change / scale) : std::nullopt;
}

}  // namespace

void Drift::look(const Balance& now) {
  if (!start_) start_ = now;
  linear_ = std::max(linear_, distance(now.linear_momentum, start_->linear_momentum));
  angular_ = std::max(angular_, distance(now.angular_momentum, start_->angular_momentum));
  linear_scale_ = std::max(linear_scale_, now.momentum_scale);
  angular_scale_ = std::max(angular_scale_, now.angular_scale);
  energy_ = std::max(energy_, std::abs(energy(now) - energy(*start_)));
  energy_scale_ = std::max(energy_scale_, energy(*start_) + now.work);
}

Conservation Drift::conservation(bool exchanges_momentum) const {
  Conservation result;
  if (!start_) return result;
  result.energy = ratio(energy_, energy_scale_);
  if (exchanges_momentum) return result;
  result.linear_momentum = ratio(linear_, linear_scale_);
  result.angular_momentum = ratio(angular_, angular_scale_);
  return result;
}

}  // namespace taut
