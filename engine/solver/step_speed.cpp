#include "engine/solver/step_speed.hpp"

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

double step_speed(const Elasticity& m, double zeta, double known) {
  constexpr double round_off = 1e-9;
  if (!(m.G > known * (1 + round_off) * m.K)) return m.c0;
  return m.c0 * std::sqrt((1 + zeta * m.G / m.K) / (1 + zeta * known));
}

}  // namespace

double step_speed(const SolverInput& input, double zeta, double known) {
  double speed = 0;
  for (const int used : input.initial.material)
    speed = std::max(speed, step_speed(input.materials[used], zeta, known));
  return speed;
}

double step_speed(const SolverInput& input) { return step_speed(input, 4.0 / 3, 1.5); }

}  // namespace taut
