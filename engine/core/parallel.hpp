#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

#include "engine/core/threads.hpp"

namespace taut {

/// NaN if either is NaN.
inline double greater(double a, double b) { return b <= a || a != a ? a : b; }

inline int chunks_of(int n, int threads) {
  constexpr int of_each = 4, least = 32;
  return threads == 1 ? 1 : std::clamp(n / least, 1, std::min(of_each * threads, Threads::most_chunks));
}

template <class F>
void parallel_chunks(int n, const Threads& threads, const F& f) {
  struct Loop {
    const F& f;
    int n, chunks;
    void chunk(int c) const { f(c, begin(c), begin(c + 1)); }
    int begin(int c) const { return static_cast<int>(static_cast<long>(n) * c / chunks); }
  };
  const Loop loop{f, n, chunks_of(n, threads.count)};
  if (loop.chunks == 1) return loop.chunk(0);
  threads.run(
      threads.count, loop.chunks,
      [](const void* of, int c) noexcept { static_cast<const Loop*>(of)->chunk(c); }, &loop);
}

template <class F>
void parallel_for(int n, const Threads& threads, const F& f) {
  parallel_chunks(n, threads, [&](int, int first, int last) {
    for (int i = first; i < last; ++i) f(i);
  });
}

/// Inlines all calls of f: packs stay in registers.
template <class F>
[[gnu::flatten, gnu::noinline]] void inlined_loop(const F& f, int first, int last) {
  const F own = f;  // no store can alias a local copy
  for (int i = first; i < last; ++i) own(i);
}
template <class F>
[[gnu::flatten, gnu::noinline]] double inlined_max(const F& f, int first, int last) {
  const F own = f;
  double most = 0;
  for (int i = first; i < last; ++i) most = greater(most, own(i));
  return most;
}

template <class F>
void parallel_pass(int n, const Threads& threads, const F& f) {
  parallel_chunks(n, threads, [&](int, int first, int last) { inlined_loop(f, first, last); });
}

/// Calls take(i, make(i)): `make` on `threads` threads, `take` on one, in order.
template <class Make, class Take>
void make_in_order(int n, int threads, const Make& make, const Take& take) {
  constexpr int most = 1024;
  std::vector<decltype(make(0))> made(static_cast<std::size_t>(std::clamp(n, 0, most)));
  for (int first = 0; first < n; first += most) {
    const int count = std::min(most, n - first);
    parallel_for(count, threads, [&](int k) { made[static_cast<std::size_t>(k)] = make(first + k); });
    for (int k = 0; k < count; ++k) take(first + k, std::move(made[static_cast<std::size_t>(k)]));
  }
}

/// Maximum of 0 and all f(i), NaN if any is NaN.
template <class F>
double parallel_max(int n, const Threads& threads, const F& f) {
  std::atomic<double> result = 0;
  parallel_chunks(n, threads, [&](int, int first, int last) {
    const double mine = inlined_max(f, first, last);
    for (double others = result; !result.compare_exchange_weak(others, greater(others, mine));) {
    }
  });
  return result;
}

}  // namespace taut
