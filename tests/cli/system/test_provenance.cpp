#include <fstream>
#include <regex>
#include <set>

#include <doctest/doctest.h>

#include "tests/support/sweep_folder.hpp"

using namespace taut::test;

namespace {

Texts in_threads(const TemporaryFolder& folder, const std::string& number) {
  Texts arguments = tiny_run(folder, "threads-" + number, {"--no-render"});
  *(std::ranges::find(arguments, "--threads") + 1) = number;
  return arguments;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("run.json records the build, the command and the process in provenance") {
    const TemporaryFolder folder;
    const Texts arguments = in_threads(folder, "1");
    REQUIRE(program(arguments, folder / "").code == 0);
    const auto provenance = json_of(folder / "threads-1/run.json")["provenance"];
    Texts command = provenance["command"];
    CHECK(command.front().ends_with("/taut"));
    command.erase(command.begin());
    CHECK(command == arguments);
    CHECK(fs::equivalent(provenance["working_folder"].get<std::string>(), folder / ""));
    std::string host;
    std::ifstream("/proc/sys/kernel/hostname") >> host;
    CHECK(provenance["host"] == host);
    CHECK(std::regex_match(provenance["start"].get<std::string>(),
                           std::regex(R"(20\d\d-\d\d-\d\dT\d\d:\d\d:\d\dZ)")));
    CHECK(provenance["wall_seconds"].get<double>() > 0);
    CHECK(provenance["cpu_seconds"].get<double>() > 0);
    const std::string version = program({"--version"}).out;
    CHECK(contains(version, "(" + provenance["commit"].get<std::string>() + ")\n"));
    CHECK(contains(version, "  " + provenance["compiler"].get<std::string>() + "\n"));
    CHECK(contains(version, "  " + provenance["instruction_set"].get<std::string>() + "\n"));
    for (const auto& [library, number] : provenance["libraries"].items())
      CHECK(contains(version, " " + library + " " + number.get<std::string>()));
    for (const auto& [file, number] : provenance["formats"].items())
      CHECK(contains(version, " " + file + " " + std::to_string(number.get<int>())));
    CHECK(provenance["formats"]["run.json"] == json_of(folder / "threads-1/run.json")["format"]);
  }

  TEST_CASE("runs with one and two threads differ in run.json only in the keys that PROMISES.md excludes") {
    const TemporaryFolder folder;
    for (const std::string number : {"1", "2"}) REQUIRE(program(in_threads(folder, number)).code == 0);
    const auto one = json_of(folder / "threads-1/run.json"), two = json_of(folder / "threads-2/run.json");
    const std::set<std::string> may_differ{"threads", "machine", "seconds", "particle_steps_per_second",
                                           "provenance"};
    for (const auto& [key, value] : one.items()) {
      CAPTURE(key);
      CHECK((may_differ.contains(key) || value == two[key]));
    }
    CHECK(one["provenance"] != two["provenance"]);
  }

  TEST_CASE("results of a sweep have a format number and no column of provenance") {
    const TemporaryFolder folder;
    REQUIRE(program(tiny_sweep(folder, "out", {"--grid", "speed=1"})).code == 0);
    CHECK(json_of(folder / "out/results.json")["format"] == 1);
    const std::string columns = lines_of(folder / "out/results.csv").front();
    CHECK_FALSE(contains(columns, "provenance"));
    CHECK_FALSE(contains(columns, "format"));
  }
}
