#pragma once

#include <string_view>

#include "engine/core/machine.hpp"
#include "engine/settings.hpp"

/// Kernels: the loops over particles and pairs, over plain data. A kernels.cpp makes tables of pointers to
/// them (for a family of methods one for each method and dimension) and is compiled once per instruction set; everything
/// else is compiled once and asks for the best table of the machine. In the builds for special instruction sets the macro
/// `taut` renames the namespace (engine/CMakeLists.txt), so that the linker shares none of the functions that they
/// inline.
namespace taut {

/// Kernels outside the families of methods; values from 100 on, so that none equals a Family.
enum class SharedKernels { neighbor_search = 100, history_row };

/// The table of these kernels for the instruction set of this build; null if there is none. `Key`: a Family or one of
/// SharedKernels. Specialised in its kernels.cpp. `method` selects among those of a family.
template <int Key>
const void* kernels_of(int dim, std::string_view method);

}  // namespace taut

#if defined(__x86_64__)
namespace taut_x86_64_v3 {
template <int Key>
const void* kernels_of(int dim, std::string_view method);
}
namespace taut_x86_64_v4 {
template <int Key>
const void* kernels_of(int dim, std::string_view method);
}
#endif

namespace taut {

/// The table for the best instruction set of this machine up to `allowed`. Each build has its own copy of these
/// types, with the same names and layouts. `with_v4`: there are kernels for x86-64-v4, too.
template <auto Key, class Kernels, bool with_v4 = false>
const Kernels& best_kernels(int dim, std::string_view method = "",
                            InstructionSet allowed = InstructionSet::x86_64_v4) {
  constexpr int key = static_cast<int>(Key);
  const void* best = nullptr;
#if defined(__x86_64__)
  if constexpr (with_v4)
    if (allowed >= InstructionSet::x86_64_v4 && has_x86_64_v4())
      best = taut_x86_64_v4::kernels_of<key>(dim, method);
  if (!best && allowed >= InstructionSet::x86_64_v3 && has_x86_64_v3())
    best = taut_x86_64_v3::kernels_of<key>(dim, method);
#endif
  if (!best) best = kernels_of<key>(dim, method);
  return *static_cast<const Kernels*>(best);
}

}  // namespace taut
