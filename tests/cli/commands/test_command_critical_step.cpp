#include <doctest/doctest.h>

#include "tests/support/program_runner.hpp"
#include "tests/support/relative.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

Outcome search(const TemporaryFolder& folder, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"critical-step", write_tiny_scene(folder), "--threads", "1"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return call(arguments);
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE(
      "critical-step: the answer has the step in s, its ratio to the default step, and theoretical limits") {
    const TemporaryFolder folder;
    const std::vector<std::string> quick{"--method", "tl-small-strain", "--steps",
                                         "50",       "--tolerance",     "0.01"};
    const Outcome text = search(folder, quick);
    CHECK(text.code == 0);
    for (const char* part : {"discs with tl-small-strain", "largest stable step", " s",
                             "over the default step", "[Zhang2020] Eq. 15b", "von Neumann", "trials"})
      CHECK(contains(text.out, part));
    CHECK(contains(text.err, "critical step"));

    std::vector<std::string> as_json = quick;
    as_json.insert(as_json.end(), {"--json", "--quiet"});
    const Outcome json = search(folder, as_json);
    CHECK(json.err.empty());
    const auto result = nlohmann::ordered_json::parse(json.out);
    CHECK(result["unit"] == "s");
    const double found = result["critical_step"], unstable = result["unstable_step"];
    CHECK(found < unstable);
    CHECK(unstable < found / (1 - 0.0101));
    CHECK(result["over_default"].get<double>() == Approx(found / result["default_step"].get<double>()));
    CHECK(result["limits"].size() == 2);

    // the verdict allows twice the received energy, the search 100 times
    const double cfl = 0.4 * result["over_default"].get<double>();
    const auto run = [&](double share) {
      return call(tiny_run(
          folder, "out",
          {"--method", "tl-small-strain", "--no-render", "--set", "cfl=" + std::to_string(share * cfl)}));
    };
    CHECK(run(0.6).code == 0);
    CHECK(run(1.5).code == 3);
  }

  TEST_CASE("critical-step: invalid arguments are refused with exit code 2 before the first trial") {
    const TemporaryFolder folder;
    const std::vector<std::vector<std::string>> cases{
        {"--steps", "0"},         {"--steps", "2.5"},   {"--tolerance", "-1"},
        {"--tolerance", "1e-17"}, {"--tolerance", "5"}, {"--method", "tll"},
        {"--set", "pul=1"},       {"--spacing", "0.2"}, {"--cfll", "1"}};
    for (const auto& arguments : cases) {
      CAPTURE(arguments.front());
      const Outcome outcome = search(folder, arguments);
      CHECK(outcome.code == 2);
      CHECK(outcome.out.empty());
      CHECK(!outcome.err.empty());
    }
    CHECK(contains(search(folder, {"--method", "tll"}).err, "'tl'"));
    CHECK(call({"critical-step"}).code == 2);
    CHECK(contains(call({"critical-step", "--help"}).out, "taut critical-step colliding-rings"));
  }

  TEST_CASE("critical-step: a failure of the first step is reported with its time, with exit code 3") {
    const TemporaryFolder folder;
    const Outcome outcome = search(folder, {"--set", "pull=1e6"});
    CHECK(outcome.code == 3);
    CHECK(contains(outcome.err, "taut: the simulation diverged at t = 0 s, step 0: particle "));
  }
}
