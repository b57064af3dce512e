#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <numeric>
#include <set>
#include <stdexcept>

#include <doctest/doctest.h>

#include "cli/system/ordered_work.hpp"

using namespace taut::cli;

namespace {

class Gate {
 public:
  void open() {
    is_open_ = true;
    is_open_.notify_all();
  }
  void pass() const { is_open_.wait(false); }

 private:
  std::atomic<bool> is_open_ = false;
};

std::vector<int> numbers_up_to(int count) {
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("second halves run in order, one at a time, for any number of workers") {
    for (const int workers : {0, 1, 2, 3, 8}) {
      OrderedWork work(workers);
      std::vector<int> order;
      std::atomic<int> at_once = 0;
      for (int k = 0; k < 200; ++k)
        work.add([&, k](int worker) {
          CHECK(worker >= 0);
          CHECK(worker < std::max(workers, 1));
          if (k % 7 == 0) std::this_thread::yield();
          return [&, k] {
            CHECK(++at_once == 1);
            order.push_back(k);
            --at_once;
          };
        });
      work.finish();
      CHECK(order == numbers_up_to(200));
    }
  }

  TEST_CASE("a slow piece delays the second halves of later pieces, but not their first halves") {
    OrderedWork work(2);
    Gate gate;
    std::vector<int> order;
    work.add([&](int) {
      gate.pass();
      return [&] { order.push_back(0); };
    });
    for (int k = 1; k < 4; ++k)
      work.add([&, k](int) {
        if (k == 3) gate.open();
        return [&, k] { order.push_back(k); };
      });
    work.finish();
    CHECK(order == numbers_up_to(4));
  }

  TEST_CASE("no two pieces run on one worker at once") {
    OrderedWork work(3);
    std::array<std::atomic<bool>, 3> busy{};
    for (int k = 0; k < 300; ++k)
      work.add([&](int worker) {
        auto& mine = busy[static_cast<std::size_t>(worker)];
        CHECK_FALSE(mine.exchange(true));
        std::this_thread::yield();
        mine = false;
        return [] {};
      });
    work.finish();
  }

  TEST_CASE("the number of pieces in progress is limited") {
    OrderedWork work(2);
    std::atomic<int> under_way = 0, most = 0;
    for (int k = 0; k < 100; ++k)
      work.add([&](int) {
        const int now = ++under_way;
        most = std::max(most.load(), now);
        return [&] { --under_way; };
      });
    work.finish();
    CHECK(most <= work.room());
    // `add` waits at the limit
    Gate gate;
    std::atomic<int> done = 0;
    for (int k = 0; k < work.room(); ++k)
      work.add([&](int) {
        gate.pass();
        return [&] { ++done; };
      });
    std::thread opener([&] {
      CHECK(done == 0);
      gate.open();
    });
    work.add([&](int) { return [] {}; });
    CHECK(done > 0);
    opener.join();
    work.finish();
    CHECK(done == work.room());
  }

  TEST_CASE("the first failure is thrown, and no later second half runs") {
    for (const int workers : {0, 1, 3})
      for (const bool in_second_half : {false, true}) {
        OrderedWork work(workers);
        std::vector<int> order;
        Gate gate;  // holds piece 5 until piece 7 is added
        if (workers == 0) gate.open();
        const auto fail_at = [&](int number) {
          if (number == 5 || number == 6) throw std::runtime_error("piece " + std::to_string(number));
        };
        const auto add_all = [&] {
          for (int k = 0; k < 40; ++k) {
            work.add([&, k](int) {
              if (k == 5) gate.pass();
              if (!in_second_half) fail_at(k);
              return [&, k] {
                fail_at(k);
                order.push_back(k);
              };
            });
            if (k == 7) gate.open();
          }
          work.finish();
        };
        CHECK_THROWS_WITH_AS(add_all(), "piece 5", std::runtime_error);
        if (workers > 0) CHECK_THROWS_WITH_AS(work.finish(), "piece 5", std::runtime_error);
        CHECK(order == numbers_up_to(5));
      }
  }

  TEST_CASE("destruction without `finish` waits for started pieces, and drops the others") {
    std::atomic<int> begun = 0, ended = 0;
    Gate first, gate;
    std::thread opener;
    {
      OrderedWork work(1);
      for (int k = 0; k < work.room(); ++k)
        work.add([&](int) {
          ++begun;
          first.open();
          gate.pass();
          ++ended;
          return [] {};
        });
      first.pass();
      opener = std::thread([&] { gate.open(); });
    }
    CHECK(begun > 0);
    CHECK(ended == begun);
    opener.join();
  }
}
