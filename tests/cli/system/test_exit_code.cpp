#include <csignal>
#include <functional>
#include <new>
#include <stdexcept>

#include <doctest/doctest.h>

#include "cli/system/exit_code.hpp"
#include "engine/error.hpp"
#include "tests/support/program_runner.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

TEST_SUITE("cli") {
  TEST_CASE("errors have their exit codes, and messages without terminal controls") {
    const auto code_of = [](const std::function<int()>& action) {
      std::ostringstream err;
      return guarded(action, err);
    };
    CHECK(code_of([] { return exit_different; }) == 1);
    CHECK(code_of([] { return exit_not_granted; }) == 1);
    CHECK(code_of([]() -> int { throw UsageError("wrong"); }) == 2);
    CHECK(code_of([]() -> int { throw SceneError("a.toml", 1, 1, "key", "wrong"); }) == 2);
    CHECK(code_of([]() -> int { throw std::bad_alloc(); }) == 2);
    CHECK(code_of([]() -> int { throw NumericalError(1, 0.5, 2, "v", "not finite"); }) == 3);
    CHECK(code_of([]() -> int { throw OutputError("a.png", "full"); }) == 4);
    CHECK(code_of([]() -> int { throw std::logic_error("impossible"); }) == 70);
    CHECK(code_of([]() -> int { throw 1; }) == 70);
    CHECK(exit_by_signal(SIGINT) == 130);
    CHECK(exit_by_signal(SIGTERM) == 143);
    CHECK(exit_by_signal(SIGHUP) == 129);
    std::ostringstream err;
    guarded([]() -> int { throw std::logic_error("impossible"); }, err);
    CHECK(err.str() == "taut: impossible (this is a bug of taut)\n");
    err.str("");
    guarded([]() -> int { throw UsageError("a\x1b[2J\nb\u009b \u202ec \u2066d é Δ"); }, err);
    CHECK(err.str() == "taut: a\\x1b[2J\nb\\xc2\\x9b \\xe2\\x80\\xaec \\xe2\\x81\\xa6d é Δ\n");
    err.str("");
    const auto no_folder = std::make_error_code(std::errc::no_such_file_or_directory);
    guarded([&]() -> int { throw std::filesystem::filesystem_error("", no_folder); }, err);
    CHECK(err.str() == "taut: the current folder: No such file or directory\n");
    const std::string help = call({"--help"}).out;
    for (const std::string code : {"0 ", "1 ", "2 ", "3 ", "4 ", "70 ", "130 "})
      CHECK(contains(help, "\n  " + code));
  }
}
