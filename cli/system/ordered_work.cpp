#include "cli/system/ordered_work.hpp"

namespace taut::cli {

OrderedWork::OrderedWork(int workers) {
  for (int worker = 0; worker < workers; ++worker) workers_.emplace_back([this, worker] { work(worker); });
}

OrderedWork::~OrderedWork() {
  {
    const std::scoped_lock lock(mutex_);
    is_closing_ = true;
  }
  changed_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void OrderedWork::add(Piece piece) {
  if (workers_.empty()) return piece(0)();
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return added_ - done_ < room(); });
    throw_failure();
    waiting_.push_back(std::move(piece));
    ++added_;
  }
  changed_.notify_all();
}

void OrderedWork::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return added_ == done_; });
  throw_failure();
}

void OrderedWork::throw_failure() const {
  if (failure_) std::rethrow_exception(failure_);
}

void OrderedWork::work(int worker) {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return is_closing_ || !waiting_.empty(); });
    if (is_closing_) return;
    const Piece piece = std::move(waiting_.front());
    waiting_.pop_front();
    const long number = begun_++;
    lock.unlock();
    SecondHalf second;
    try {
      second = piece(worker);
    } catch (...) {
      second = [failure = std::current_exception()] { std::rethrow_exception(failure); };
    }
    lock.lock();
    seconds_.emplace(number, std::move(second));
    do_seconds(lock);
  }
}

void OrderedWork::do_seconds(std::unique_lock<std::mutex>& lock) {
  for (auto next = seconds_.begin(); next != seconds_.end() && next->first == done_;
       next = seconds_.begin()) {
    const SecondHalf second = std::move(next->second);
    seconds_.erase(next);
    const bool is_wanted = !failure_;
    lock.unlock();
    std::exception_ptr failure;
    try {
      if (is_wanted) second();
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    if (failure) failure_ = failure;
    ++done_;
    changed_.notify_all();
  }
}

}  // namespace taut::cli
