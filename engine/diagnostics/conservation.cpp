#include "engine/diagnostics/conservation.hpp"

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

double energy(const Balance& sums) { return sums.kinetic + sums.strain - sums.work + sums.damped; }

double change(const Point& now, const Point& given, const Point& start) {
  return std::hypot(now[0] - given[0] - start[0], now[1] - given[1] - start[1], now[2] - given[2] - start[2]);
}

double ratio(double change, double scale) { return change == 0 ? 0 : change / scale; }

}  // namespace

bool exchanges_momentum(const Scene& scene, const Snapshot& start) {
  const bool holds = std::ranges::any_of(start.clamped, [](unsigned char clamped) { return clamped != 0; });
  return holds || has_guides(scene) || has_drives(scene) || has_loads(scene) || scene.damping > 0;
}

void ConservationWatch::follow(const Balance& now) {
  if (!start_) start_ = now;
  linear_ = std::max(linear_, change(now.linear_momentum, now.of_walls.linear, start_->linear_momentum));
  angular_ = std::max(angular_, change(now.angular_momentum, now.of_walls.angular, start_->angular_momentum));
  linear_scale_ = std::max(linear_scale_, now.momentum_scale);
  angular_scale_ = std::max(angular_scale_, now.angular_scale);
  const double change_of_energy = energy(now) - energy(*start_);
  gained_ = std::max(gained_, change_of_energy);
  lost_ = std::max(lost_, -change_of_energy);
  energy_scale_ = std::max(energy_scale_, energy(*start_) + now.work);
}

Conservation ConservationWatch::so_far() const {
  Conservation result;
  if (!start_) return result;
  if (energy_scale_ > nothing_) {
    result.energy_gained = ratio(gained_, energy_scale_);
    result.energy_lost = ratio(lost_, energy_scale_);
    result.energy = std::max(result.energy_gained, result.energy_lost);
  }
  if (exchanges_momentum_) return result;
  result.linear_momentum = ratio(linear_, linear_scale_);
  result.angular_momentum = ratio(angular_, angular_scale_);
  return result;
}

}  // namespace taut
