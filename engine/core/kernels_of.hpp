#pragma once

#include <string_view>

#include "engine/core/isa.hpp"
#include "engine/core/machine.hpp"
#include "engine/settings.hpp"

/// Kernels: functions that run once per particle and step, compiled once per instruction set over plain data. A kernels.cpp
/// makes a table of function pointers (for a family of methods one for each method and dimension); everything else is
/// compiled once and asks for the best table of the machine.
namespace taut {

/// Kernels that are not those of a family of methods.
enum class SharedKernels { neighbor_search, history_row };

inline namespace TAUT_ISA {
/// The table of these kernels for this instruction set; null if there is none. `Key`: a Family or one of SharedKernels.
/// Specialised in its kernels.cpp. `method` selects among those of a family.
template <auto Key>
const void* kernels_of(int dim, std::string_view method);
}  // namespace TAUT_ISA

#ifdef TAUT_KNOWS_X86_64_LEVELS
namespace x86_64_v3 {
template <auto Key>
const void* kernels_of(int dim, std::string_view method);
}
namespace x86_64_v4 {
template <auto Key>
const void* kernels_of(int dim, std::string_view method);
}
#endif

/// The table for the best instruction set of this machine up to `allowed`. The builds have types of their own, with the
/// same names and layouts. `with_v4`: there are kernels for x86-64-v4, too.
template <auto Key, class Kernels, bool with_v4 = false>
const Kernels& best_kernels(int dim, std::string_view method = "",
                            InstructionSet allowed = InstructionSet::x86_64_v4) {
  const void* best = nullptr;
#ifdef TAUT_KNOWS_X86_64_LEVELS
  if constexpr (with_v4)
    if (allowed >= InstructionSet::x86_64_v4 && has_x86_64_v4())
      best = x86_64_v4::kernels_of<Key>(dim, method);
  if (!best && allowed >= InstructionSet::x86_64_v3 && has_x86_64_v3())
    best = x86_64_v3::kernels_of<Key>(dim, method);
#endif
  if (!best) best = kernels_of<Key>(dim, method);
  return *static_cast<const Kernels*>(best);
}

}  // namespace taut
