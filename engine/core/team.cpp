#include "engine/core/team.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <pthread.h>
#include <sched.h>

namespace taut {
namespace {

using Clock = std::chrono::steady_clock;
// time that a helper spins before it sleeps
constexpr std::chrono::microseconds patience{100};
constexpr int spins = 50;

double time_on(clockid_t clock) {
  std::timespec time{};
  ::clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

std::uint64_t Team::Job::word() const {
  return number << 24 | static_cast<std::uint64_t>(threads) << 12 | static_cast<std::uint64_t>(chunks);
}
Team::Job Team::Job::of(std::uint64_t word) {
  return {word >> 24, static_cast<int>(word >> 12 & 0xfff), static_cast<int>(word & 0xfff)};
}

Team::Team() : taken_(new std::atomic<std::uint64_t>[most_chunks] {}) {}

Team::~Team() {
  ends_ = true;
  run(static_cast<int>(helpers_.size()) + 1, 0, nullptr, nullptr);
  for (std::thread& helper : helpers_) helper.join();
}

Threads::Threads(int threads)
    : count(threads),
      run([](int n, int chunks, Team::Work work, const void* of) { Team::own().run(n, chunks, work, of); }) {}

Team& Team::own() {
  thread_local Team team;
  return team;
}

double Team::cpu_seconds() {
  double total = time_on(CLOCK_THREAD_CPUTIME_ID);
  for (std::thread& helper : helpers_)
    if (clockid_t clock = 0; ::pthread_getcpuclockid(helper.native_handle(), &clock) == 0)
      total += time_on(clock);
  return total;
}

void Team::run(int threads, int chunks, Work work, const void* of) {
  if (work_) {  // nested loop
    for (int c = 0; c < chunks; ++c) work(of, c);
    return;
  }
  threads = std::min(threads, most_threads);
  while (static_cast<int>(helpers_.size()) < threads - 1)
    helpers_.emplace_back([this, member = static_cast<int>(helpers_.size()) + 1] { help(member); });
  work_ = work;
  of_ = of;
  left_.store(chunks, std::memory_order_relaxed);
  const Job job{++jobs_, threads, chunks};
  job_ = job.word();
  if (asleep_ > 0) {
    const std::lock_guard lock(mutex_);
    wake_.notify_all();
  }
  take_part(job, 0);
  int looked = 0;
  while (left_.load(std::memory_order_acquire) > 0) {
    if (looked < spins)
      ++looked, pause();
    else
      ::sched_yield();
  }
  work_ = nullptr;
}

void Team::take_part(const Job& job, int member) {
  int chunk = static_cast<int>(static_cast<long>(job.chunks) * member / job.threads);
  for (int k = 0; k < job.chunks; ++k, chunk = chunk + 1 < job.chunks ? chunk + 1 : 0) {
    std::uint64_t last = taken_[chunk].load(std::memory_order_relaxed);
    if (last >= job.number || !taken_[chunk].compare_exchange_strong(last, job.number)) continue;
    work_(of_, chunk);
    left_.fetch_sub(1, std::memory_order_release);
  }
}

void Team::help(int member) {
  for (std::uint64_t word = 0;;) {
    word = wait_for_other_than(word);
    if (ends_) return;
    if (const Job job = Job::of(word); member < job.threads) take_part(job, member);
  }
}

std::uint64_t Team::wait_for_other_than(std::uint64_t word) {
  const Clock::time_point begin = Clock::now();
  do {
    for (int k = 0; k < spins; ++k, pause())
      if (const std::uint64_t now = job_.load(std::memory_order_acquire); now != word) return now;
  } while (Clock::now() - begin < patience);
  std::unique_lock lock(mutex_);
  ++asleep_;  // before the check of job_: the owner sets job_ first, then reads asleep_
  wake_.wait(lock, [&] { return job_ != word; });
  --asleep_;
  return job_;
}

}  // namespace taut
