#pragma once

#include <algorithm>
#include <chrono>

namespace taut {

/// Chooses all threads for the next step, or one if more do not help. Compares blocks of steps on all threads with a
/// block on one thread. After a slower block, one thread continues, longer after repeated failures.
class TeamSize {
 public:
  explicit TeamSize(int most) : most_(most) {}

  int threads() const { return single_blocks_ > 0 ? 1 : most_; }

  /// Call before a series of steps.
  void resume() { last_ = seconds(); }
  void step_done() {
    if (most_ == 1) return;
    const double now = seconds();
    step_took(now - last_);
    last_ = now;
  }
  void step_took(double time) {
    taken_ += time;
    ++steps_;
    if (single_blocks_ > 0) {
      if (steps_ == most_steps || (steps_ == least_steps && taken_ > long_enough)) block_alone_done();
    } else if (taken_ > block_alone_) {
      team_failed();
    } else if (steps_ == block_) {
      team_did_well();
    }
  }

 private:
  static constexpr int most_steps = 16;         // per block
  static constexpr int least_steps = 4;         // per long block
  static constexpr double long_enough = 0.1;    // s
  static constexpr int often = 100;             // blocks on all threads between two on one thread
  static constexpr double worth = 50;           // a failed trial may cost 1/worth of the time
  static constexpr double most_patience = 1e3;  // blocks

  void block_alone_done() {
    block_ = steps_;
    block_alone_ = taken_;
    --single_blocks_;
    begin_block();
  }
  void team_failed() {
    const double lost = taken_ - block_alone_ * steps_ / block_;  // s
    patience_ = std::min(2 * patience_, most_patience);
    single_blocks_ = static_cast<int>(std::clamp(worth * lost / block_alone_, patience_, 1e6));
    team_blocks_ = 0;
    begin_block();
  }
  void team_did_well() {
    if (++team_blocks_ == often) single_blocks_ = 1, team_blocks_ = 0;
    patience_ = 1;
    begin_block();
  }
  void begin_block() { steps_ = 0, taken_ = 0; }

  static double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  int most_;
  int single_blocks_ = 1;
  int block_ = 0;
  double block_alone_ = 0;  // s
  int team_blocks_ = 0;
  double patience_ = 1;
  int steps_ = 0;
  double taken_ = 0;  // s
  double last_ = 0;   // s
};

}  // namespace taut
