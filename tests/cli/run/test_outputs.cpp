#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/sweep_folder.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

bool python_is_there() { return std::system("/usr/bin/python3 -c 'import tomllib' 2>/dev/null") == 0; }

std::vector<std::string> read_with_python(const TemporaryFolder& folder, const std::string& name) {
  const std::string command = "/usr/bin/python3 " TAUT_SOURCE_DIR "/tests/cli/run/read_outputs.py '" +
                              folder.str(name) + "' >'" + folder.str("read") + "'";
  CHECK(std::system(command.c_str()) == 0);
  return lines_of(folder / "read");
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("Python reads the files of a run and of a sweep") {
    if (!python_is_there()) {
      MESSAGE("skipped: there is no Python 3.11 (Debian's package python3)");
      return;
    }
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "run", {"--save-particles", "--no-render"})).code == 0);
    const auto rows = lines_of(folder / "run/history.csv").size() - 1;
    CHECK(rows > 10);
    CHECK(read_with_python(folder, "run") == Texts{"history.csv " + std::to_string(rows), "particles.pvd 5"});
    // a diverged run adds a column, max(2,3) a comma
    const Texts grid{"--grid", "speed=1,max(2,3)", "--grid", "cfl=0.5,20", "--until", "0.01"};
    REQUIRE(program(tiny_sweep(folder, "sweep", grid)).code == 0);
    CHECK(contains(text_of(folder / "sweep/results.csv"), ",\"max(2,3)\","));
    CHECK(read_with_python(folder, "sweep") == Texts{"results.csv 4"});
  }

  TEST_CASE("the verdict does not depend on the number of rows of history.csv, which can repeat indicators") {
    const TemporaryFolder folder;
    const auto record = [&](const std::string& name, const std::string& history) {
      REQUIRE(call(tiny_run(folder, name,
                            {"--no-render", "--until", "0.008", "--history", history, "--set", "speed=3"}))
                  .code == 0);
      return json_of(folder / name / "run.json");
    };
    const auto few = record("few", "1"),
               many = record("many", "1e-6");  // more often than indicators are evaluated
    CHECK(lines_of(folder / "few/history.csv").size() == 3);
    const std::vector<std::string> rows = lines_of(folder / "many/history.csv");
    CHECK(rows.size() > 280);
    const auto indicators = [](const std::string& row) { return row.substr(row.find(",2,") + 3); };
    std::set<std::string> seen;
    for (std::size_t k = 1; k < rows.size(); ++k) seen.insert(indicators(rows[k]));
    CHECK(seen.size() > 150);
    CHECK(seen.size() < 203);
    for (const char* key : {"verdict", "since", "indicators", "conservation"}) CHECK(few[key] == many[key]);
    CHECK(few["indicators"]["hourglass_error"]["at"] != few["reached"]);
  }
}
