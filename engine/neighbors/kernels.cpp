// Compiled once per instruction set.
#include "engine/neighbors/kernels.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "engine/core/kernels_of.hpp"

namespace taut {
namespace {

typedef int Indices __attribute__((vector_size(lanes * sizeof(int))));

/// Indices of the set bits.
constexpr Indices packed[] = {{},  {0},    {1},    {0, 1},    {2},    {0, 2},    {1, 2},    {0, 1, 2},
                              {3}, {0, 3}, {1, 3}, {0, 1, 3}, {2, 3}, {0, 2, 3}, {1, 2, 3}, {0, 1, 2, 3}};

template <int Dim>
Vec<double, Dim> place(const SearchFields<Dim>& f, int i) {
  Vec<double, Dim> x;
  for (int k = 0; k < Dim; ++k) x[k] = f.x[k][i];
  return x;
}

template <int Dim>
std::size_t room_for(const SearchFields<Dim>& f, int i) {
  std::size_t most = 2 * lanes;
  f.cells.for_each_row(place(f, i), [&](int begin, int end) { most += end - begin; });
  return most;
}

template <int Dim>
int find(const SearchFields<Dim>& f, int first, int last, int* count, int* found, std::size_t room,
         std::size_t& size) {
  const double support2 = f.support * f.support;
  for (int i = first; i < last; ++i) {
    if (size + room_for(f, i) > room) return i;
    const Vec<double, Dim> x_i = place(f, i);
    int* const list = found + size;
    int* to = list;
    f.cells.for_each_row(x_i, [&](int begin, int end) {
      for (int j = begin; j < end; j += lanes) {
        Vec<Pack, Dim> d;
        for (int k = 0; k < Dim; ++k) d[k] = x_i[k] - load(f.x[k] + j);
        unsigned near = lanes_where(dot(d, d) < support2);
        near &= ~(static_cast<unsigned>(i - j) < lanes ? 1U << (i - j) : 0);
        near &= (1U << std::min(end - j, lanes)) - 1;
        const Indices hits = j + packed[near];
        std::memcpy(to, &hits, sizeof(hits));
        to += std::popcount(near);
      }
    });
    if (f.body) {
      int* kept = list;
      for (const int* j = list; j < to; ++j)
        if (f.body[*j] == f.body[i]) *kept++ = *j;
      to = kept;
    }
    count[i] = static_cast<int>(to - list);
    while ((to - list) % lanes != 0) *to++ = i;
    size += to - list;
  }
  return last;
}

template <int Dim>
constexpr SearchKernels<Dim> table{.find = find<Dim>, .room_for = room_for<Dim>};

}  // namespace

template <>
const void* kernels_of<int(SharedKernels::neighbor_search)>(int dim, std::string_view) {
  return dim == 3 ? static_cast<const void*>(&table<3>) : &table<2>;
}

}  // namespace taut
