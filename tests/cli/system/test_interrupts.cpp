#include <csignal>

#include <doctest/doctest.h>

#include "cli/system/interrupts.hpp"
#include "tests/support/files.hpp"
#include "tests/support/terminal_program.hpp"

using namespace taut::cli;
using namespace taut::test;

TEST_SUITE("unit") {
  TEST_CASE("a second SIGHUP, which a closed terminal can send, does not end the program at once") {
    const Interrupts interrupts;
    CHECK_FALSE(interrupts.must_end());
    std::raise(SIGHUP);
    CHECK(interrupts.must_end());
    std::raise(SIGHUP);
    CHECK(interrupts.must_end());
  }

  TEST_CASE("a signal is remembered until the next Interrupts object") {
    {
      const Interrupts interrupts;
      std::raise(SIGTERM);
    }
    CHECK(Interrupts::must_end());
    const Interrupts interrupts;
    CHECK_FALSE(Interrupts::interrupted());
  }

  TEST_CASE("a closed pipe does not end the program") {
    const Interrupts interrupts;
    std::raise(SIGPIPE);
    CHECK_FALSE(interrupts.must_end());
  }
}

TEST_SUITE("cli") {
  TEST_CASE("Ctrl-C during the set-up of a run ends the run and leaves at most a lock file") {
    const TemporaryFolder folder;
    // the bonds of 230 000 particles take seconds to compute
    TerminalProgram program(
        {"run", "colliding-balls", "--method", "oenog", "--spacing", "1.1e-3", "--out", folder.str("run")},
        folder.str("state"));
    program.wait_for("setting up");
    program.send(SIGINT);
    CHECK(program.exit_code() == 130);
    for (const auto& left : fs::directory_iterator(folder / "run"))
      CHECK(left.path().filename() == "run.lock");
  }
}
