#pragma once

#include <string_view>

#include "engine/core/kernels_of.hpp"
#include "engine/methods/formulation.hpp"

namespace taut {

/// Tables::of<M, dim> of the method, or null.
template <class Tables, const auto&... M>
const void* table_among(int dim, std::string_view method, MethodList<M...>) {
  const void* found = nullptr;
  const auto look = [&]<const auto & Each>() {
    if (Each.name != method) return;
    if (dim == 2) found = &Tables::template of<Each, 2>;
    if (dim == 3) found = &Tables::template of<Each, 3>;
  };
  (look.template operator()<M>(), ...);
  return found;
}

}  // namespace taut
