#pragma once

namespace taut {

/// Plain data, so that passes for special instruction sets contain no code of core/team.hpp.
struct Threads {
  using Run = void (*)(int threads, int chunks, void (*work)(const void* of, int chunk) noexcept,
                       const void* of);

  static constexpr int most_chunks = 4000;

  int count;
  Run run;

  Threads(int count);  // NOLINT: loops take a number of threads
};

}  // namespace taut
