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

/// Runs work in threads: first halves in any order, second halves in the order of `add` until one fails.
class OrderedWork {
 public:
  using SecondHalf = std::function<void()>;
  /// `worker` counts from 0 and differs between concurrent pieces.
  using Piece = std::function<SecondHalf(int worker)>;

  /// Starts at most `workers` threads, fewer if the system refuses them; without any, `add` does all work.
  explicit OrderedWork(int workers);
  /// Drops pieces that have not begun; waits for the others.
  ~OrderedWork();
  OrderedWork(const OrderedWork&) = delete;
  OrderedWork& operator=(const OrderedWork&) = delete;

  /// Number of unfinished pieces at which `add` waits.
  int room() const { return 3 * static_cast<int>(workers_.size()); }
  /// Throws the first error of a piece.
  void add(Piece piece);
  /// Throws like `add`.
  void finish();

 private:
  struct Result {
    SecondHalf second;
    std::exception_ptr failure;
    bool is_ready = false;
  };

  void work(int worker);
  void do_seconds(std::unique_lock<std::mutex>& lock);
  void throw_failure() const;

  std::mutex mutex_;  // guards the members from `waiting_` to `failure_`
  std::condition_variable changed_;
  std::deque<Piece> waiting_;
  std::map<long, Result> results_;  // by number of the piece
  long added_ = 0, begun_ = 0, done_ = 0;
  bool is_closing_ = false;
  std::exception_ptr failure_;
  std::vector<std::thread> workers_;
};

}  // namespace taut::cli
