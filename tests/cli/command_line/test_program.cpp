#include <doctest/doctest.h>

#include "tests/support/sweep_folder.hpp"

using namespace taut::cli;
using namespace taut::test;

TEST_SUITE("cli") {
  TEST_CASE("the help of --set shows one assignment and states that the option can be repeated") {
    const std::string help = call({"run", "--help"}).out;
    CHECK(contains(help, "--set NAME=VALUE"));
    CHECK_FALSE(contains(help, "NAME=VALUE ..."));
    CHECK(contains(help.substr(help.find("--set NAME=VALUE")), "can be repeated"));
  }

  TEST_CASE("an assignment without --set is refused with a hint, and another needless argument without it") {
    const Texts words{"run", "colliding-rings", "--set", "method=tl"};
    const auto error_with = [&](const std::string& last) {
      Texts all = words;
      all.push_back(last);
      return call(all).err;
    };
    CHECK(contains(error_with("method.damping=3"),
                   "'method.damping=3' is one argument too many; write --set before each NAME=VALUE"));
    CHECK(contains(error_with("fast"), "'fast' is one argument too many; remove it"));
  }

  TEST_CASE("a report of one step has a singular") {
    const TemporaryFolder folder;
    const Outcome outcome = call(tiny_run(folder, "out", {"--until", "1e-9", "--no-render"}));
    REQUIRE(outcome.code == 0);
    CHECK(contains(outcome.out, ", 1 step to t = "));
  }

  TEST_CASE("the summary of a suite with one entry has a singular") {
    const TemporaryFolder folder;
    write_tiny_scene(folder);
    const auto snapshot = [&](const char* speed, const Texts& more) {
      std::ofstream(folder / "suite.toml")
          << "set = { until = 1e-9, speed = " << speed << " }\nrender = { frames = 1 }\n"
          << "[[entry]]\nname = 'discs'\nscene = 'discs.toml'\n";
      Texts words{"snapshot", folder.str("suite.toml"), "--out", folder.str("out"), "--jobs", "1"};
      words.insert(words.end(), more.begin(), more.end());
      return program(words);
    };
    REQUIRE(snapshot("2", {"--update"}).code == 0);
    CHECK(snapshot("2", {}).out.ends_with("\nthe entry passed\n"));
    CHECK(snapshot("4", {}).out.ends_with("\nthe entry failed\n"));
  }
}
