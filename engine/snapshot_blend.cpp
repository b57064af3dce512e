#include "engine/snapshot_blend.hpp"

#include <span>

namespace taut {
namespace {

/// Equal values stay bit-identical.
void move_back(std::span<double> after, std::span<const double> before, double share) {
  for (std::size_t k = 0; k < after.size(); ++k) after[k] = before[k] + share * (after[k] - before[k]);
}

}  // namespace

Snapshot blend(const Snapshot& before, const Snapshot& after, double t) {
  Snapshot out = after;
  if (t == after.time) return out;
  const double dt = after.time - before.time, share = (t - before.time) / dt;
  // a new member must be interpolated here or left as in `after`
  auto& [dim, time, step, x0, x, v, m, rho, p, s, strain_energy, contact_energy, work, body_work, damped,
         of_walls, diameter, body, material, clamped, driven] = out;
  time = t;
  for (const auto field : {&Snapshot::x, &Snapshot::v, &Snapshot::rho, &Snapshot::p, &Snapshot::s,
                           &Snapshot::strain_energy, &Snapshot::body_work})
    move_back(out.*field, before.*field, share);
  const double bend = 0.5 * share * (1 - share) * dt;  // s
  for (std::size_t k = 0; k < x.size(); ++k) x[k] -= bend * (after.v[k] - before.v[k]);
  for (const auto sum : {&Snapshot::contact_energy, &Snapshot::work, &Snapshot::damped})
    move_back({&(out.*sum), 1}, {&(before.*sum), 1}, share);
  for (const auto part : {&Impulse::linear, &Impulse::angular})
    move_back(of_walls.*part, before.of_walls.*part, share);
  return out;
}

}  // namespace taut
