#pragma once

#include <cstddef>

namespace taut {

inline std::size_t as_index(int i) { return static_cast<std::size_t>(i); }

}  // namespace taut
