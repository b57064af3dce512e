#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "engine/core/threads.hpp"

namespace taut {

/// Threads that help the one that owns them with loops, chunk by chunk. The owner works too, and waits only
/// for chunks that others have begun: a helper that the machine does not run at the moment, or that is not
/// awake yet, holds up nobody. (The end of an OpenMP region waits for all its threads, which on a busy
/// machine takes a slice of the scheduler's time, milliseconds, for a loop of ten microseconds.)
///
/// Each has chunks of its own, the same ones in every loop over as many, so that what it works on stays in
/// its cache; who is done goes on with those of the others.
class Team {
 public:
  static constexpr int most_threads = 1000, most_chunks = Threads::most_chunks;
  using Work = void (*)(const void* of, int chunk) noexcept;

  Team();
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  /// That of the calling thread. Its helpers start when they are needed first.
  static Team& own();
  /// work(of, chunk) once for each chunk, on at most `threads` threads, in any order; on this one alone if
  /// that is within such a loop of its own.
  void run(int threads, int chunks, Work work, const void* of);

 private:
  /// What is to be done, in one word: which job it is, counted up, for how many threads, of how many chunks.
  struct Job {
    std::uint64_t number;
    int threads, chunks;
    std::uint64_t word() const;
    static Job of(std::uint64_t word);
  };

  void help(int member);
  void take_part(const Job& job, int member);
  std::uint64_t wait_for_other_than(std::uint64_t word);

  std::vector<std::thread> helpers_;
  std::uint64_t jobs_ = 0;
  Work work_ = nullptr;  // of the job; null in between
  const void* of_ = nullptr;
  /// [chunk] the last job whose chunk somebody took. A helper that is late finds all of its job taken.
  std::unique_ptr<std::atomic<std::uint64_t>[]> taken_;
  alignas(64) std::atomic<std::uint64_t> job_{0};
  alignas(64) std::atomic<int> left_{0};  // chunks that are not done
  alignas(64) std::atomic<int> asleep_{0};
  std::atomic<bool> ends_{false};
  std::mutex mutex_;
  std::condition_variable wake_;
};

}  // namespace taut
