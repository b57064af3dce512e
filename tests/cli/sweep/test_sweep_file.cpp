#include <doctest/doctest.h>

#include "cli/sweep/sweep_file.hpp"
#include "engine/error.hpp"
#include "tests/support/sweep_folder.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

/// Returns the place of the '@'.
FilePlace write_sweep(const TemporaryFolder& folder, std::string text) {
  write_tiny_scene(folder);
  FilePlace place{1, 1};
  const std::size_t mark = text.find('@');
  if (mark != std::string::npos) {
    for (std::size_t i = 0; i < mark; ++i)
      place = text[i] == '\n' ? FilePlace{place.line + 1, 1} : FilePlace{place.line, place.column + 1};
    text.erase(mark, 1);
  }
  std::ofstream(folder / "sweep.toml") << text;
  return place;
}

/// Expects an error at the '@' with `part`.
void check_refused(const std::string& text, const std::string& part) {
  const TemporaryFolder folder;
  const FilePlace place = write_sweep(folder, text);
  const Outcome outcome = call({"sweep", folder.str("sweep.toml"), "--out", folder.str("out")});
  CAPTURE(text);
  CAPTURE(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.err.starts_with(folder.str("sweep.toml") + ":" + std::to_string(place.line) + ":" +
                                std::to_string(place.column) + ": "));
  CHECK(contains(outcome.err, part));
  CHECK_FALSE(fs::exists(folder / "out"));
}

std::vector<std::string> rows_of(const std::string& text) {
  const TemporaryFolder folder;
  write_sweep(folder, text);
  std::vector<std::string> rows;
  for (const GridRow& row : read_sweep(folder / "sweep.toml").rows) rows.push_back(text_of(row));
  return rows;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a sweep file contains a grid, or single rows") {
    using Texts = std::vector<std::string>;
    CHECK(rows_of("scene = 'discs.toml'\n[grid]\nspeed = '1:2:1'\nmethod = ['og', 'enog']\n") ==
          Texts{"speed=1, method=og", "speed=1, method=enog", "speed=2, method=og", "speed=2, method=enog"});
    CHECK(rows_of("scene = 'discs.toml'\ngrid = { speed = [1, 2.50], pull = '3,4', until = 1 }\n") ==
          Texts{"speed=1, pull=3, until=1", "speed=1, pull=4, until=1", "speed=2.5, pull=3, until=1",
                "speed=2.5, pull=4, until=1"});
    CHECK(rows_of("scene = 'discs.toml'\n[[row]]\nspeed = 1\n[[row]]\n'method.zeta' = 3\nspeed = '2*pi'\n") ==
          Texts{"speed=1", "method.zeta=3, speed=2*pi"});
  }

  TEST_CASE("a row beside a grid is run with each combination of the names that it does not set") {
    using Texts = std::vector<std::string>;
    const std::string grid = "scene = 'discs.toml'\n[grid]\nspeed = [1, 2]\nmethod = ['tl', 'og']\n";
    CHECK(rows_of(grid + "[[row]]\nmethod = 'tl'\ncontact = 'surface'\n") ==
          Texts{"speed=1, method=tl", "speed=1, method=og", "speed=2, method=tl", "speed=2, method=og",
                "speed=1, method=tl, contact=surface", "speed=2, method=tl, contact=surface"});
    CHECK(rows_of(grid + "[[row]]\nmethod = 'pf'\nspeed = 3\n").back() == "method=pf, speed=3");
  }

  TEST_CASE("an invalid sweep file is refused with the place") {
    const std::string head = "scene = 'discs.toml'\n";
    check_refused(head + "[grid]\nspeed = @'0:1:0.3'\n", "0.9 or 1.2");
    check_refused(head + "[grid]\nspeed = [1, 2, @1.0]\n", "twice");
    check_refused(head + "[grid]\nspeed = @true\n", "a number or a text");
    check_refused(head + "[grid]\nspeed = @[]\n", "no values");
    check_refused(head + "@[grid]\n", "empty");
    check_refused(head + "[grid]\n@method.zeta = 3\n", "\"method.zeta\"");
    check_refused(head + "[grid]\nspeed = 1\n@[[row]]\nspeed = 1\n", "twice");
    check_refused("@" + head, "[grid]");
    check_refused(head + "[[row]]\nspeed = @'[1]'\n", "speed");
    check_refused(head + "[[row]]\nspeed = @[1]\n", "a number or a text");
    check_refused(head + "[[row]]\nspeed = 1\n@[[row]]\nspeed = 1\n", "twice");
    check_refused(head + "@grids = 1\n[grid]\nspeed = 1\n", "did you mean 'grid'");
    check_refused("scene = @'disks.toml'\n[grid]\nspeed = 1\n", "disks.toml");
    check_refused(head + "[grid]\nspeed = @?\n", "TOML");
  }

  TEST_CASE("a name or a value that a run cannot have is refused with its place") {
    const std::string head = "scene = 'discs.toml'\n";
    check_refused(head + "[grid]\npull = [1, 2]\nsped = [@1, 2]\n", "did you mean 'speed'");
    check_refused(head + "[grid]\nspeed = [1, @-2]\npull = [3, 4]\n", "out of bounds");
    check_refused(head + "[grid]\nmethod = ['og', @'enogg']\nspeed = 1\n", "did you mean 'enog'");
    check_refused(head + "[grid]\nstepping = @'singel'\n", "did you mean 'single'");
    check_refused(head + "[grid]\n'method.zeta' = @3\nmethod = 'og'\n", "method.zeta");
    check_refused(head + "[grid]\nspacing = @'0'\n", "greater than 0");
    check_refused(head + "set = { pul = @1 }\n[grid]\nspeed = 1\n", "did you mean 'pull'");
  }

  TEST_CASE("the command line overrides the settings of a sweep file, but not its grid") {
    const TemporaryFolder folder;
    write_sweep(folder, "scene = 'discs.toml'\nset = { until = 1e-5, method = 'og' }\n[grid]\nspeed = 1\n");
    const std::vector<std::string> sweep{"sweep", folder.str("sweep.toml"), "--quiet", "--out",
                                         folder.str("out")};
    REQUIRE(program(sweep).code == 0);
    CHECK(json_of(folder / "out/results.json")["runs"][0]["method"] == "og");
    std::vector<std::string> other = sweep;
    other.insert(other.end(), {"--method", "enog", "--until", "2e-5"});
    REQUIRE(program(other).code == 0);
    CHECK(json_of(folder / "out/results.json")["runs"][0]["method"] == "enog");
    CHECK(json_of(folder / "out/results.json")["runs"][0]["until"] == 2e-5);
    other = sweep;
    other.insert(other.end(), {"--set", "speed=3"});
    CHECK(program(other).code == 2);
  }

  TEST_CASE("the shipped sweep files are valid") {
    int count = 0;
    for (const auto& entry : fs::directory_iterator(TAUT_SOURCE_DIR "/scenes/studies")) {
      if (entry.path().extension() != ".toml") continue;
      const TemporaryFolder folder;
      const std::string study = entry.path().stem().string();
      CAPTURE(study);
      const Outcome outcome = call({"sweep", study, "--list", "--out", folder.str("out")});
      CAPTURE(outcome.err);
      CHECK(outcome.code == 0);
      CHECK(contains(outcome.out, "0 of "));
      CHECK_FALSE(fs::exists(folder / "out"));
      ++count;
    }
    CHECK(count > 0);
  }
}
