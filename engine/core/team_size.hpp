#pragma once

#include <algorithm>
#include <chrono>

namespace taut {

/// How many threads the next step takes: all of them, or one where more do not help, as while other work
/// keeps the machine busy. Results do not depend on it.
///
/// Blocks of steps are timed. One thread does the first block; then the team is tried, and stays while its
/// blocks take no longer. A block that takes longer than that of one thread ends there and then. One thread
/// goes on, so long that the trial has cost a fiftieth of the time, and twice as long after each that fails
/// again.
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
    step_took(now - last_);
    last_ = now;
  }
  /// Of a step, s.
  void step_took(double time) {
    taken_ += time;
    ++steps_;
    if (alone_ > 0) {
      if (steps_ == most_steps || (steps_ == least_steps && taken_ > long_enough)) block_alone_done();
    } else if (taken_ > block_alone_) {
      team_failed();
    } else if (steps_ == block_) {
      team_did_well();
    }
  }

 private:
  static constexpr int most_steps = 16;         // of a block: some rebuilds are among them
  static constexpr int least_steps = 4;         // of one that takes
  static constexpr double long_enough = 0.1;    // s
  static constexpr int often = 100;             // blocks of the team between two of one thread
  static constexpr double worth = 50;           // what a trial that fails may cost: 1/worth of the time
  static constexpr double most_patience = 1e3;  // blocks

  void block_alone_done() {
    block_ = steps_;
    block_alone_ = taken_;
    --alone_;
    begin_block();
  }
  void team_failed() {
    const double lost = taken_ - block_alone_ * steps_ / block_;  // s
    patience_ = std::min(2 * patience_, most_patience);
    alone_ = static_cast<int>(std::clamp(worth * lost / block_alone_, patience_, 1e6));
    well_ = 0;
    begin_block();
  }
  void team_did_well() {
    if (++well_ == often) alone_ = 1, well_ = 0;
    patience_ = 1;
    begin_block();
  }
  void begin_block() { steps_ = 0, taken_ = 0; }

  static double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  int most_;
  int alone_ = 1;           // blocks to go with one thread
  int block_ = 0;           // steps
  double block_alone_ = 0;  // s, by the last block of one thread
  int well_ = 0;            // blocks of the team since then
  double patience_ = 1;     // blocks with one thread after a trial that failed, at least
  int steps_ = 0;           // of this block
  double taken_ = 0;        // s, by them
  double last_ = 0;         // s, when the last one was done
};

}  // namespace taut
