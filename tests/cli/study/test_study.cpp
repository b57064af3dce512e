#include <map>

#include <doctest/doctest.h>

#include "tests/support/results_file.hpp"
#include "tests/support/sweep_folder.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

std::string write_study(const TemporaryFolder& folder, const std::string& sections) {
  std::ofstream(folder / "study.toml") << "title = \"Rings\"\n"
                                          "scene = \"colliding-rings\"\n"
                                          "set = { until = 0.001 }\n"
                                          "[grid]\n"
                                          "spacing = [0.005, 0.0025]\n"
                                          "method = [\"og\", \"oenog\"]\n"
                                       << sections;
  return folder.str("study.toml");
}

Outcome sweep(const TemporaryFolder& folder, const std::string& study, const Texts& more = {}) {
  Texts words{"sweep", study, "--quiet", "--out", folder.str("out")};
  words.insert(words.end(), more.begin(), more.end());
  return program(words);
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a study draws its pictures after its runs, and does not repeat finished runs") {
    const TemporaryFolder folder;
    const std::string study = write_study(folder,
                                          "[chart]\nmeasure = [\"touch_time\"]\ncost = \"steps\"\n"
                                          "[map]\nparameter = \"spacing\"\n"
                                          "[history]\ndiameter = \"d, m\"\ntotal_energy = \"E, J\"\n");
    const Outcome first = sweep(folder, study);
    CAPTURE(first.err);
    REQUIRE(first.code == 0);
    CHECK(contains(first.out, "out/chart-touch_time.png"));
    std::map<std::string, std::string> bytes;
    for (const std::string name : {"chart-touch_time", "map", "history"})
      for (const std::string extension : {".png", ".gp", ".dat"}) {
        CAPTURE(name);
        bytes[name + extension] = text_of(folder / "out" / (name + extension));
        CHECK(bytes[name + extension].size() > 100);
      }
    const Texts history = lines_of(folder / "out/spacing=0.005_method=oenog/history.csv");
    const std::string t = history.at(5).substr(0, history.at(5).find(','));
    CHECK(contains(bytes["history.dat"], "\n" + t + " "));
    const auto before = ends(folder / "out");
    REQUIRE(before.size() == 4);
    fs::remove(folder / "out/map.png");
    REQUIRE(sweep(folder, study).code == 0);
    CHECK(ends(folder / "out") == before);
    for (const auto& [name, text] : bytes) CHECK(text_of(folder / "out" / name) == text);
  }

  TEST_CASE("a study whose runs all diverge succeeds without its chart") {
    const TemporaryFolder folder;
    std::ofstream(folder / "rod.toml") << R"(
title = "A rod"
spacing = 0.01
until = 1e-3
method = "oenog"
[parameters]
rate = { value = 1, unit = "1/s", help = "rate of stretching" }
[material.rubber]
density = 1200
youngs_modulus = 1e7
poisson_ratio = 0.4
[[body]]
name = "rod"
shape = { type = "rectangle", low = [-0.05, -0.02], high = [0.05, 0.02] }
material = "rubber"
velocity = ["rate*x", 0]
[[probe]]
name = "tip"
of = "displacement"
body = "rod"
at = [0.05, 0]
component = "x"
[[measure]]
name = "peak"
of = "maximum"
probe = "tip"
unit = "m"
[[reference]]
law = "neo-hookean"
name = "line"
solutions = { peak = "5e-5*rate" }
)";
    std::ofstream(folder / "study.toml")
        << "scene = \"rod.toml\"\n[grid]\nrate = [4e4, 1e5]\n[chart]\n[map]\n";
    const Outcome outcome = sweep(folder, folder.str("study.toml"));
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.err,
                   "chart.png is not drawn: no measure in the results of rod has an error: "
                   "all runs diverged\n"));
    CHECK_FALSE(fs::exists(folder / "out/chart.png"));
    CHECK(fs::exists(folder / "out/map.png"));
    CHECK(contains(text_of(folder / "out/tables.md"), "diverged"));
  }

  TEST_CASE("a mistake in a study is refused with the reason") {
    const TemporaryFolder folder;
    const std::map<std::string, std::string> wrong{
        {"[chart]\nmeasure = \"touch_tim\"\n", ":8:11: unknown measure 'touch_tim' (did you mean"},
        {"[chart]\nmeasure = [\"touch_time\", 3]\n", ":8:26: measure must be a text"},
        {"[chart]\nmeasure = []\n", "empty list"},
        {"[chart]\ncost = \"money\"\n", ":8:8: unknown cost 'money'"},
        {"[chart]\ncosts = \"steps\"\n", "did you mean 'cost'"},
        {"[chart]\nagainst = 3\n", ":8:11: against must be a text"},
        {"[map]\nparameter = \"spacin\"\n",
         ":8:13: unknown swept parameter 'spacin' (did you mean 'spacing'"},
        {"[chart]\nmethods = [\"oenog\", \"tl\"]\n", ":8:21: unknown method 'tl'"},
        {"[chart]\nmeasure = \"touch_time\"\nagainst = \"tl\"\n", ":9:11: unknown method 'tl'"},
        {"v0 = [0.07, 0.09]\n[chart]\nmeasure = \"touch_time\"\n",
         ":9:11: 'touch_time' has no reference with these parameters"},
        {"v0 = [0.05, 0.06]\n[map]\n", ":8:1: several parameters are swept (spacing, v0); name one of them"},
        {"[history]\n", "[history] is empty"},
        {"[history]\ntip = 3\n", ":8:7: tip must be a text"},
        {"[history]\ndiametre = \"d, m\"\n",
         ":8:1: unknown history column 'diametre' (did you mean 'diameter'"},
        {"[map]\nparameter = \"method\"\n", ":8:13: unknown swept parameter 'method'"},
        {"v0 = [0.07, 0.09]\n[chart]\n", ":8:1: no measure has a reference with these parameters"},
        {"[chart]\nmeasure = \"diameter_rmse\"\nagainst = \"og\"\n",
         ":8:11: 'diameter_rmse' is itself a difference from a reference"},
        {"[histroy]\n", "did you mean 'history'"},
    };
    for (const auto& [sections, message] : wrong) {
      const Outcome outcome = sweep(folder, write_study(folder, sections));
      CAPTURE(outcome.err);
      CHECK(outcome.code == 2);
      CHECK(contains(outcome.err, message));
    }
    std::ofstream(folder / "study.toml") << "scene = \"loaded-square\"\n[grid]\nmethod = [\"og\"]\n[chart]\n";
    CHECK(contains(sweep(folder, folder.str("study.toml"), {"--list"}).err, "no measure has a reference"));
    CHECK_FALSE(fs::exists(folder / "out"));
  }
}
