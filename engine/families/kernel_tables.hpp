#pragma once

#include <string_view>

#include "engine/core/kernels_of.hpp"
#include "engine/methods/all_methods.hpp"

namespace taut {

/// Tables::template of<M, Dim>, the kernels of the method of this name among those of family F.
template <Family F, class Tables, const Formulation&... M>
const void* table_among(int dim, std::string_view method, MethodList<M...>) {
  const void* found = nullptr;
  const auto look = [&]<const Formulation & Each>() {
    if constexpr (Each.family == F) {
      if (Each.name != method) return;
      if (dim == 2) found = &Tables::template of<Each, 2>;
      if constexpr (greatest_dim(Each) == 3)
        if (dim == 3) found = &Tables::template of<Each, 3>;
    }
  };
  (look.template operator()<M>(), ...);
  return found;
}

}  // namespace taut
