#pragma once

#include <cstddef>

namespace taut {

/// Converts i ≥ 0 to an index of a container.
inline std::size_t as_index(int i) { return static_cast<std::size_t>(i); }

}  // namespace taut
