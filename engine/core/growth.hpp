#pragma once

#include <algorithm>
#include <cstddef>

namespace taut {

/// Reserves room for `more` entries: first twice the need, later the total extrapolated from `done` of `all`
/// contributions, since each reallocation needs memory for two copies.
template <class List>
void make_room(List& list, std::size_t more, std::size_t done, std::size_t all) {
  constexpr std::size_t extrapolation_part = 16;
  const std::size_t needed = list.size() + more;
  if (needed <= list.capacity()) return;
  if (extrapolation_part * done < all) return list.reserve(2 * needed);
  const double each = static_cast<double>(needed) / static_cast<double>(done + 1);
  const auto in_all = static_cast<std::size_t>(1.1 * each * static_cast<double>(all));
  list.reserve(std::max(in_all, needed + needed / 8));
}

}  // namespace taut
