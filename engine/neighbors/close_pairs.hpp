#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <vector>

#include "engine/snapshot.hpp"

namespace taut {

/// |x_i − x_j|², m².
inline double squared_distance(const Snapshot& now, int i, int j) {
  const double* a = now.x.data() + static_cast<std::ptrdiff_t>(i) * now.dim;
  const double* b = now.x.data() + static_cast<std::ptrdiff_t>(j) * now.dim;
  double squared = 0;
  for (int k = 0; k < now.dim; ++k) squared += (a[k] - b[k]) * (a[k] - b[k]);
  return squared;
}

/// A particle by its body and its cell z, y, x; sorted, three cells abreast in x follow one another.
struct Place {
  std::array<long, 4> cell{};
  int particle = 0;
  auto operator<=>(const Place&) const = default;
};

inline std::vector<Place> sorted_places(const Snapshot& now, double width) {
  std::vector<Place> places(now.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    places[i] = {{now.body[i], 0, 0, 0}, static_cast<int>(i)};
    for (int a = 0; a < now.dim; ++a) {
      const double x = now.x[i * static_cast<std::size_t>(now.dim) + static_cast<std::size_t>(a)];
      places[i].cell[static_cast<std::size_t>(3 - a)] = std::lround(std::floor(x / width));
    }
  }
  std::ranges::sort(places);
  return places;
}

/// Calls visit(i, j), i < j, for every two particles of one body at most `reach` apart.
template <class Visit>
void for_each_close_pair(const Snapshot& now, double reach, Visit visit) {
  const std::vector<Place> places = sorted_places(now, reach);
  const int layers = now.dim == 3 ? 1 : 0;
  for (const auto& [cell, i] : places) {
    for (int dz = -layers; dz <= layers; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        const Place first = {{cell[0], cell[1] + dz, cell[2] + dy, cell[3] - 1}, 0};
        const std::array<long, 4> last = {cell[0], cell[1] + dz, cell[2] + dy, cell[3] + 1};
        auto place = std::ranges::lower_bound(places, first);
        for (; place != places.end() && place->cell <= last; ++place) {
          const int j = place->particle;
          if (i < j && squared_distance(now, i, j) <= reach * reach) visit(i, j);
        }
      }
    }
  }
}

}  // namespace taut
