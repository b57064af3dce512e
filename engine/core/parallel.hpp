#pragma once

#include <vector>

#include <omp.h>

#include "engine/core/isa.hpp"

namespace taut::inline TAUT_ISA {

/// f(i) for i = 0 … n−1 on `threads` threads, static chunks.
template <class F>
void parallel_for(int n, int threads, const F& f) {
#pragma omp parallel for schedule(static) num_threads(threads)
  for (int i = 0; i < n; ++i) f(i);
}

/// Greatest f(i), or NaN if any is NaN. The same for any number of threads.
template <class F>
double parallel_max(int n, int threads, const F& f) {
  double result = 0;
#pragma omp parallel num_threads(threads)
  {
    double mine = 0;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < n; ++i) {
      const double value = f(i);
      if (!(value <= mine || mine != mine)) mine = value;  // NaN comes in and stays
    }
#pragma omp critical(taut_parallel_max)
    if (!(mine <= result || result != result)) result = mine;
  }
  return result;
}

}  // namespace taut::inline TAUT_ISA
