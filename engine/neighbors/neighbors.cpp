#include "engine/neighbors/neighbors.hpp"

#include "engine/core/kernels_of.hpp"

namespace taut {

template <int Dim>
void NeighborSearch<Dim>::operator()(const CellGrid<Dim>& grid, const std::vector<Vec<double, Dim>>& x,
                                     double support, int threads, Neighbors& out, const int* body) {
  static const auto& kernels = best_kernels<SharedKernels::neighbor_search, SearchKernels<Dim>>(Dim);
  const int n = static_cast<int>(x.size());
  out.begin.resize(n + 1);
  out.begin[0] = 0;
  count_.resize(n);
  SearchFields<Dim> fields{grid.view(), {}, support, body};
  for (int k = 0; k < Dim; ++k) {
    x_[k].resize(n + lanes);
    fields.x[k] = x_[k].data();
  }
  parallel_for(n, threads, [&](int i) {
    for (int k = 0; k < Dim; ++k) x_[k][i] = x[i][k];
  });
  found_.resize(chunks_of(n, threads));
  parallel_chunks(n, threads, [&](int chunk, int first, int last) {
    std::vector<int>& found = found_[chunk];
    std::size_t size = 0;
    while (first < last) {
      if (const std::size_t needed = size + kernels.room_for(fields, first); found.size() < needed) {
        found.reserve(needed + needed / 8);  // resize alone might double the room
        found.resize(found.capacity());
      }
      first = kernels.find(fields, first, last, count_.data(), found.data(), found.size(), size);
    }
  });
  out.pairs = 0;
  for (int i = 0; i < n; ++i) {
    out.begin[i + 1] = out.begin[i] + (count_[i] + lanes - 1) / lanes;
    out.pairs += count_[i];
  }
  out.j.resize(static_cast<std::size_t>(lanes) * out.begin[n]);
  parallel_chunks(n, threads, [&](int chunk, int first, int last) {
    const std::ptrdiff_t from = out.begin[first], to = out.begin[last];
    std::copy_n(found_[chunk].data(), lanes * (to - from), out.j.data() + lanes * from);
  });
}

template class NeighborSearch<2>;
template class NeighborSearch<3>;

}  // namespace taut
