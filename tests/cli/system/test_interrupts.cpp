#include <csignal>

#include <doctest/doctest.h>

#include "cli/system/interrupts.hpp"

using namespace taut::cli;

TEST_SUITE("unit") {
  TEST_CASE("a second hang-up, as a terminal that is closed may send, does not end the program at once") {
    const Interrupts interrupts;
    CHECK_FALSE(interrupts.asked_to_end());
    std::raise(SIGHUP);
    CHECK(interrupts.asked_to_end());
    std::raise(SIGHUP);
    CHECK(interrupts.asked_to_end());
  }

  TEST_CASE("a signal is remembered until somebody heeds the next ones") {
    {
      const Interrupts interrupts;
      std::raise(SIGTERM);
    }
    CHECK(Interrupts::asked_to_end());
    const Interrupts interrupts;
    CHECK_FALSE(Interrupts::asked());
  }

  TEST_CASE("who reads no longer does not end the program") {
    const Interrupts interrupts;
    std::raise(SIGPIPE);
    CHECK_FALSE(interrupts.asked_to_end());
  }
}
