#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

namespace taut::cli {

/// Work beside the caller, several pieces at once. A piece has two halves: the first is done anywhere, the
/// second when its turn has come, after those of all pieces that were added before.
///
/// Where a piece fails, the second halves of those behind it are left out.
class OrderedWork {
 public:
  using SecondHalf = std::function<void()>;
  /// `worker` counts from 0: two pieces that are done at once have different ones.
  using Piece = std::function<SecondHalf(int worker)>;

  /// With 0 workers the caller does it all, in `add`.
  explicit OrderedWork(int workers);
  /// Pieces that nobody has begun are dropped.
  ~OrderedWork();
  OrderedWork(const OrderedWork&) = delete;
  OrderedWork& operator=(const OrderedWork&) = delete;

  /// Of pieces that are not done; with that many `add` waits.
  int room() const { return 3 * static_cast<int>(workers_.size()); }
  /// Throws what a piece has thrown, the first of them.
  void add(Piece piece);
  /// Waits until all is done. Throws as `add` does.
  void finish();

 private:
  void work(int worker);
  void do_seconds(std::unique_lock<std::mutex>& lock);
  void throw_failure() const;

  std::mutex mutex_;  // of all that follows
  std::condition_variable changed_;
  std::deque<Piece> waiting_;
  std::map<long, SecondHalf> seconds_;     // by the numbers of their pieces
  long added_ = 0, begun_ = 0, done_ = 0;  // pieces
  bool is_closing_ = false;
  std::exception_ptr failure_;
  std::vector<std::thread> workers_;
};

}  // namespace taut::cli
