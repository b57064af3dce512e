#pragma once

namespace taut {

/// The threads that share a loop, as plain data, so that a pass for a special instruction set needs no code of the team
/// (core/team.hpp).
struct Threads {
  /// work(of, chunk) once for each of `chunks` chunks, on `threads` threads.
  using Run = void (*)(int threads, int chunks, void (*work)(const void* of, int chunk) noexcept,
                       const void* of);

  /// Greatest number of chunks of a loop.
  static constexpr int most_chunks = 4000;

  int count;
  Run run;

  /// `count` threads: the calling thread and helpers of its team.
  Threads(int count);  // NOLINT: loops take a number of threads
};

}  // namespace taut
