#include "cli/system/ordered_work.hpp"

#include <exception>

namespace taut::cli {

OrderedWork::OrderedWork(int workers) {
  workers_.reserve(static_cast<std::size_t>(workers));
  try {
    for (int worker = 0; worker < workers; ++worker) workers_.emplace_back([this, worker] { work(worker); });
  } catch (const std::exception&) {  // too little memory, or too many threads: fewer workers
  }
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
    results_.try_emplace(added_);  // here, since workers must not fail to store a failure
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
    Result& result = results_.at(begun_++);
    lock.unlock();
    try {
      result.second = piece(worker);
    } catch (...) {
      result.failure = std::current_exception();
    }
    lock.lock();
    result.is_ready = true;
    do_seconds(lock);
  }
}

void OrderedWork::do_seconds(std::unique_lock<std::mutex>& lock) {
  while (!results_.empty() && results_.begin()->first == done_ && results_.begin()->second.is_ready) {
    const auto next = results_.extract(results_.begin());
    Result& result = next.mapped();
    const bool is_wanted = !failure_ && !result.failure;
    lock.unlock();
    try {
      if (is_wanted) result.second();
    } catch (...) {
      result.failure = std::current_exception();
    }
    lock.lock();
    if (!failure_) failure_ = result.failure;
    ++done_;
    changed_.notify_all();
  }
}

}  // namespace taut::cli
