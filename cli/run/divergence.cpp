#include "cli/run/divergence.hpp"

#include <cmath>

#include "cli/text/format.hpp"

namespace taut::cli {
namespace {

double speed(const Snapshot& now, std::size_t particle) {
  const auto dim = static_cast<std::size_t>(now.dim);
  double sum = 0;
  for (std::size_t k = 0; k < dim; ++k) sum += now.v[particle * dim + k] * now.v[particle * dim + k];
  return std::sqrt(sum);
}

/// The first particle whose speed is no number, else the fastest.
std::size_t worst_particle(const Snapshot& now) {
  std::size_t worst = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (!std::isfinite(speed(now, i))) return i;
    if (speed(now, i) > speed(now, worst)) worst = i;
  }
  return worst;
}

std::string when(double time, long step) {
  return "the simulation diverged at t = " + brief(time) + " s, step " + std::to_string(step) + ": ";
}

}  // namespace

std::string describe_divergence(const NumericalError& error) {
  return when(error.time, error.step) + error.what();
}

std::string describe_divergence(const Snapshot& now, const Balance& sums) {
  const std::size_t worst = worst_particle(now);
  return when(now.time, now.step) + "the energy is " + brief(sums.kinetic + sums.strain) + " J; particle " +
         std::to_string(worst) + " is the fastest, at " + brief(speed(now, worst)) + " m/s";
}

}  // namespace taut::cli
