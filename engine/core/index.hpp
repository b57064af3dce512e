#pragma once

#include <cstddef>

namespace taut {

/// i, at least 0, as what containers take.
inline std::size_t as_index(int i) { return static_cast<std::size_t>(i); }

}  // namespace taut
