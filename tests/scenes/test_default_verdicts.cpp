#include <regex>

#include <doctest/doctest.h>

#include "cli/scene/shipped.hpp"
#include "tests/support/program_runner.hpp"

namespace of_this_file {

using namespace taut::cli;
using namespace taut::test;

namespace {

struct Documented {
  std::string verdict;
  std::string until;  // empty: the whole run
};

Documented documented(const std::string& scene) {
  static const std::regex line(
      R"(\n# Verdict with these defaults: ([a-z]+)(?: \(tested to ([0-9.e-]+) s\))?\n)");
  std::smatch match;
  const std::string text = text_of(find_scene(scene));
  REQUIRE_MESSAGE(std::regex_search(text, match, line), scene << " has no line with its verdict");
  return {match[1], match[2]};
}

void check_scenes(const std::string& source) {
  const TemporaryFolder folder;
  int scenes = 0;
  for (const std::string& name : scene_names()) {
    if (name.starts_with("gallery/") || !contains(text_of(find_scene(name)), "\nsource = \"" + source))
      continue;
    CAPTURE(name);
    const Documented end = documented(name);
    std::vector<std::string> command{"run",     name,    "--no-render",    "--quiet",
                                     "--force", "--out", folder.str("run")};
    if (!end.until.empty()) command.insert(command.end(), {"--until", end.until});
    const Outcome outcome = call(command);
    CAPTURE(outcome.err);
    CHECK(outcome.code == (end.verdict == "diverged" ? 3 : 0));
    CHECK(json_of(folder / "run/run.json")["verdict"] == end.verdict);
    ++scenes;
  }
  CHECK(scenes > 0);
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("scenes of Zhang2024 end with the verdict that their files state") { check_scenes("Zhang2024"); }
  TEST_CASE("scenes of Khayyer2024 end with the verdict that their files state") {
    check_scenes("Khayyer2024");
  }
  TEST_CASE("scenes of TranDuc2023 end with the verdict that their files state") {
    check_scenes("TranDuc2023");
  }
  TEST_CASE("scenes of Lee2016 end with the verdict that their files state") { check_scenes("Lee2016"); }
  TEST_CASE("scenes of Zhang2020 end with the verdict that their files state") { check_scenes("Zhang2020"); }
  TEST_CASE("scenes of no paper end with the verdict that their files state") {
    check_scenes("theory of elasticity");
  }
}

}  // namespace of_this_file
