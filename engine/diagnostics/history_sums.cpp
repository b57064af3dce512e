#include "engine/diagnostics/history_sums.hpp"

#include <vector>

#include "engine/core/kernels_of.hpp"
#include "engine/diagnostics/history_kernels.hpp"

namespace taut {
namespace {

const HistoryKernels& kernels_for(const Snapshot& now, InstructionSet allowed) {
  return best_kernels<SharedKernels::history_row, HistoryKernels>(now.dim, "", allowed);
}

SnapshotView view(const Snapshot& now) {
  return {.size = now.size(),
          .x = now.x.data(),
          .v = now.v.data(),
          .m = now.m.data(),
          .rho = now.rho.data(),
          .p = now.p.data(),
          .s = now.s.data(),
          .strain_energy = now.strain_energy.empty() ? nullptr : now.strain_energy.data(),
          .material = now.material.data()};
}

}  // namespace

AlternatingSums alternating_sums(const AlternatingPart& part, const Snapshot& now, double spacing,
                                 InstructionSet allowed) {
  double out[6];
  kernels_for(now, allowed)
      .alternating_sums(
          {part.rows(), part.begin.data(), part.j.data(), part.first_weight.data(), part.weight.data()},
          view(now), spacing, out);
  return {{out[0], out[1], out[2]}, {out[3], out[4], out[5]}};
}

Balance sums_of(const Snapshot& now, const Scene& scene, InstructionSet allowed) {
  std::vector<StrainDivisors> divisors;
  for (const Material& material : scene.materials)
    divisors.push_back({2 * material.bulk_modulus(), 4 * material.shear_modulus()});
  double out[10];
  kernels_for(now, allowed).balance(view(now), divisors.data(), now.contact_energy, out);
  return {
      out[0],     out[1],      {out[4], out[5], out[6]}, {out[7], out[8], out[9]}, out[2], out[3], now.work,
      now.damped, now.of_walls};
}

}  // namespace taut
