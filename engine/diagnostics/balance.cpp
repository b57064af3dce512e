#include "engine/diagnostics/balance.hpp"

#include "engine/core/machine.hpp"
#include "engine/diagnostics/particle_loops.hpp"

namespace taut {

Balance balance(const Snapshot& now, const Scene& scene) {
#ifdef TAUT_KNOWS_X86_64_LEVELS
  if (has_x86_64_v3()) return x86_64_v3::sums_of(now, scene);
#endif
  return sums_of(now, scene);
}

}  // namespace taut
