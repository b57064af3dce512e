#pragma once

#include <string_view>

#include "engine/core/machine.hpp"
#include "engine/settings.hpp"

/// Kernels are loops on plain data, compiled once per instruction set. In AVX builds a macro `taut` renames the
/// namespace, so that the linker merges no inline functions of two builds.
namespace taut {

/// Must differ from all values of Family.
enum class SharedKernels { neighbor_search = 100, history_row };

/// Kernel table of this build, or null. `Key` is a Family or SharedKernels; `method` selects within a family.
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

/// Kernel table for the machine's best instruction set up to `allowed`. `with_v4`: kernels for x86-64-v4 exist.
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
