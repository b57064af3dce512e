#pragma once

#include <algorithm>
#include <chrono>

namespace taut {

/// How many threads the next step takes: all of them, or one while other work keeps the machine busy. A team
/// that waits for a thread that is not scheduled can be fifty times slower than one thread alone. Results do
/// not depend on it.
///
/// Blocks of steps are timed. One thread does the first block; when a block of the team takes longer than a
/// block of one thread, one thread goes on, so long that the trial costs a tenth of the time at most.
class TeamSize {
 public:
  explicit TeamSize(int most) : most_(most) {}

  int threads() const { return alone_ > 0 ? 1 : most_; }

  /// Before a series of steps, since only the time of steps counts.
  void resume() { last_ = seconds(); }
  /// After every step.
  void step_done() {
    if (most_ == 1) return;
    const double now = seconds();
    taken_ += now - last_;
    last_ = now;
    if (++steps_ == block) block_done();
  }

 private:
  static constexpr int block = 16;       // steps: some rebuilds are among them
  static constexpr double slower = 1.2;  // blocks of one kind differ by as much

  void block_done() {
    if (alone_ > 0) {
      block_alone_ = taken_;
      --alone_;
    } else if (taken_ > slower * block_alone_) {
      alone_ = 1 + static_cast<int>(std::min(10 * taken_ / block_alone_, 1e6));
    }
    steps_ = 0;
    taken_ = 0;
  }

  static double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  int most_;
  int alone_ = 1;           // blocks to go with one thread
  int steps_ = 0;           // of this block
  double taken_ = 0;        // s, by them
  double last_ = 0;         // s, when the last one was done
  double block_alone_ = 0;  // s, by the last block of one thread
};

}  // namespace taut
