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

/// Helper threads that share their owner's loops. A sleeping helper delays no loop. Each thread begins with its own
/// part of a loop, so that its data stay cached.
class Team {
 public:
  static constexpr int most_threads = 1000, most_chunks = Threads::most_chunks;
  using Work = void (*)(const void* of, int chunk) noexcept;

  Team();
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  static Team& own();
  /// Calls work(of, chunk) once per chunk, in any order. A nested call runs on the calling thread.
  void run(int threads, int chunks, Work work, const void* of);
  double cpu_seconds();

 private:
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
  Work work_ = nullptr;  // null between jobs
  const void* of_ = nullptr;
  /// [chunk] number of the last job that took it.
  std::unique_ptr<std::atomic<std::uint64_t>[]> taken_;
  alignas(64) std::atomic<std::uint64_t> job_{0};
  alignas(64) std::atomic<int> left_{0};  // unfinished chunks
  alignas(64) std::atomic<int> asleep_{0};
  std::atomic<bool> ends_{false};
  std::mutex mutex_;
  std::condition_variable wake_;
};

}  // namespace taut
