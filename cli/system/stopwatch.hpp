#pragma once

#include <chrono>
#include <ctime>

namespace taut::cli {

/// Seconds of wall clock since it was made.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// CPU seconds of all threads of the process since it was made.
class CpuStopwatch {
 public:
  double seconds() const { return now() - start_; }

 private:
  static double now() {
    std::timespec time{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  double start_ = now();
};

/// Adds its own lifetime to `total`, in seconds.
class Timed {
 public:
  explicit Timed(double& total) : total_(total) {}
  ~Timed() { total_ += watch_.seconds(); }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  double& total_;
  Stopwatch watch_;
};

/// Wall clock of the parts of a run, s. `write` holds all files and the sums that history.csv shows. Of
/// frames that are drawn by several threads, `render` and `write` hold the time of all these together.
struct Seconds {
  double setup = 0, solve = 0, render = 0, write = 0;
};

}  // namespace taut::cli
