#include "cli/run/schedule.hpp"

#include <cmath>
#include <limits>

namespace taut::cli {

std::vector<double> times_in_parts(double until, int parts) {
  std::vector<double> times;
  for (int k = 0; k < parts; ++k) times.push_back(until * k / parts);
  times.push_back(until);
  return times;
}

std::vector<double> times_every(double until, double interval) {
  // tolerates rounding of the interval
  const double count = std::floor(until / interval * (1 + 1e-12));
  std::vector<double> times;
  for (long k = 0; k <= static_cast<long>(count); ++k)
    times.push_back(std::fmin(static_cast<double>(k) * interval, until));
  return times;
}

double Agenda::next() const {
  return done_ < times_.size() ? times_[done_] : std::numeric_limits<double>::infinity();
}

void Agenda::skip_to(double now) {
  done_ = 0;
  reached(now);
}

std::span<const double> Agenda::reached(double now) {
  const std::size_t first = done_;
  while (done_ < times_.size() && times_[done_] <= now) ++done_;
  return std::span(times_).subspan(first, done_ - first);
}

}  // namespace taut::cli
