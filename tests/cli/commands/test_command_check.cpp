#include <map>

#include <doctest/doctest.h>

#include "tests/support/sweep_folder.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

std::string write_record(const TemporaryFolder& folder, const std::string& name, double period,
                         const std::string& status = "finished", const std::string& verdict = "stable") {
  fs::create_directories(folder / name);
  std::ofstream(folder / name / "run.json")
      << R"({"taut": "0.1.0", "scene": "plate", "method": "tl", "status": ")" << status
      << R"(", "verdict": ")" << verdict
      << R"(", "conservation": {"energy": 1e-4}, "measures": {"period": {"value": )" << period
      << R"(, "unit": "s"}, "decay": {"value": null, "unit": "1", "why": "too short"}}})";
  return folder.str(name);
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE(
      "check exits with 1 if a value, the verdict or the status is not as expected, and with 0 otherwise") {
    const TemporaryFolder folder;
    const std::string run = write_record(folder, "run", 0.255);
    const std::map<std::string, int> checks{
        {"period=0.2545±1%", 0},
        {"period=0.2545+-1%", 0},
        {"period = 0.2545 ± 0.1 %", 1},
        {"period=0.2545±0.0006", 0},
        {"period=0.2545+/-0.0004", 1},
        {"period<0.255", 1},
        {"period<=0.255", 0},
        {"period>0.25", 0},
        {"period>0.26", 1},
        {"conservation.energy<1e-3", 0},
        {"decay=1±50%", 1},
    };
    for (const auto& [text, code] : checks) {
      const Outcome outcome = call({"check", run, "--measure", text});
      const auto& text_now = text;
      CAPTURE(text_now);
      CHECK(outcome.code == code);
      CHECK(contains(outcome.out, code == 0 ? "\nfine\n" : "1 of 2 checks failed"));
      CHECK(contains(outcome.out, "too short") == text.starts_with("decay"));
      const bool is_bound = text.find_first_of("<>") != std::string::npos;
      CHECK(contains(outcome.out, "VIOLATED") == (code == 1 && is_bound));
      CHECK(contains(outcome.out, "MOVED") == (code == 1 && !is_bound));
    }
    const std::string precise = write_record(folder, "precise", 0.25512345678);
    CHECK(contains(call({"check", precise, "--measure", "period=0.2551±1%"}).out, " 0.255123 s"));
    CHECK(call({"check", run, "--measure", "period=0.25", "--tolerance", "3%"}).code == 0);
    CHECK(call({"check", run, "--measure", "period=0.25", "--tolerance", "1%"}).code == 1);
    CHECK(call({"check", run, "--verdict", "stable"}).code == 0);
    const std::string torn = write_record(folder, "torn", 0.255, "finished", "fractured");
    CHECK(call({"check", torn, "--verdict", "stable"}).code == 1);
    CHECK(call({"check", torn, "--verdict", "fractured"}).code == 0);
    const std::string stopped = write_record(folder, "stopped", 0.255, "interrupted");
    CHECK(call({"check", stopped, "--measure", "period=0.255±1%"}).code == 1);
  }

  TEST_CASE("check against a baseline tests the verdict and each measure that has a value") {
    const TemporaryFolder folder;
    const std::string good = write_record(folder, "good", 0.255), near = write_record(folder, "near", 0.2555),
                      torn = write_record(folder, "torn", 0.255, "finished", "fractured");
    const Outcome outcome = call({"check", near, "--baseline", good + "/run.json", "--tolerance", "1%"});
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.out, "+0.196 %"));
    CHECK_FALSE(contains(outcome.out, "decay"));
    CHECK(call({"check", near, "--baseline", good, "--tolerance", "0.1%"}).code == 1);
    CHECK(call({"check", torn, "--baseline", good, "--tolerance", "1%"}).code == 1);
    CHECK(call({"check", good, "--baseline", torn, "--tolerance", "1%"}).code == 0);
  }

  TEST_CASE("an invalid check is refused with the reason") {
    const TemporaryFolder folder;
    const std::string run = write_record(folder, "run", 0.255);
    const std::string stopped = write_record(folder, "stopped", 0.255, "running");
    std::ofstream(folder / "foreign.json") << "{}";
    const std::map<Texts, std::string> wrong{
        {{run}, "nothing to check"},
        {{run, "--measure", "perod=1±1%"}, "did you mean 'period'"},
        {{run, "--measure", "period"}, "is not NAME=VALUE±TOLERANCE"},
        {{run, "--measure", "period=0.25"}, "has no tolerance"},
        {{run, "--measure", "period=0.25 s±1%"}, "'0.25s' is not a number"},
        {{run, "--measure", "period=0.25±-1%"}, "neither like 1% nor like 0.002"},
        {{run, "--measure", "period=nan±1%"}, "is not a number"},
        {{run, "--verdict", "stabel"}, "did you mean 'stable'"},
        {{run, "--", "--verdict", "stable"}, "'--verdict' follows '--', after which options are not allowed"},
        {{run, "--baseline", run}, "--baseline needs --tolerance"},
        {{run, "--baseline", stopped, "--tolerance", "1%"}, "has not finished"},
        {{folder.str("none"), "--verdict", "stable"}, "is neither a run folder nor a run.json"},
        {{folder.str("foreign.json"), "--verdict", "stable"}, "is not the run.json of a run"},
    };
    for (const auto& [arguments, message] : wrong) {
      Texts words{"check"};
      words.insert(words.end(), arguments.begin(), arguments.end());
      const Outcome outcome = call(words);
      CAPTURE(outcome.err);
      CHECK(outcome.code == 2);
      CHECK(contains(outcome.err, message));
    }
  }

  TEST_CASE(
      "an option with several values takes all words up to the next option, and --columns takes one word") {
    const TemporaryFolder folder;
    const std::string run = write_record(folder, "run", 0.255);
    const Outcome taken = call({"check", "--measure", "period<1", run, "--verdict", "stable"});
    CHECK(taken.code == 2);
    CHECK(contains(taken.err, "DIR is required: --measure takes all words that follow it"));
    CHECK(call({"check", "--verdict", "stable", run, "--measure", "period<1", "period>0"}).code == 0);
    const Outcome none = call({"sweep", "--grid", "cfl=1", "--grid", "until=1"});
    CHECK(contains(none.err, "SWEEP is required"));
    CHECK_FALSE(contains(none.err, "takes all words"));
    REQUIRE(call(tiny_run(folder, "a", {"--no-render"})).code == 0);
    CHECK(call({"plot", "--columns", "step", folder.str("a"), "--out", folder.str("p.png")}).code == 0);
  }

  TEST_CASE(
      "plot draws columns of several runs with their units, skips other files and refuses unknown columns") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "a", {"--no-render"})).code == 0);
    REQUIRE(call(tiny_run(folder, "b", {"--no-render", "--set", "speed=3"})).code == 0);
    const std::string a = folder.str("a"), b = folder.str("b");
    const Outcome both = call({"plot", a, b, "--columns", "total_energy,step", "--out", folder.str("p.png")});
    CAPTURE(both.err);
    REQUIRE(both.code == 0);
    const std::string script = text_of(folder / "p.gp"), data = text_of(folder / "p.dat");
    CHECK(contains(script, "set ylabel 'total_energy, J per m'"));
    CHECK(contains(script, "set ylabel 'step'"));
    CHECK(contains(script, "speed=3'"));
    const Texts history = lines_of(folder / "b/history.csv");
    CHECK(contains(data, "\n" + history.at(2).substr(0, history.at(2).find(',')) + " "));
    REQUIRE(
        call({"plot", a, "--columns", "kinetic_energy", "--x", "strain_energy", "--out", folder.str("x.svg")})
            .code == 0);
    CHECK(contains(text_of(folder / "x.gp"), "set xlabel 'strain_energy, J per m'"));
    CHECK(call({"plot", a, a, "--out", folder.str("twice.png")}).code == 0);
    const Outcome typo = call({"plot", a, "--columns", "total_enery", "--out", folder.str("t.png")});
    CHECK(typo.code == 2);
    CHECK(contains(typo.err, "unknown history column 'total_enery' (did you mean 'total_energy'?)"));
    CHECK(call({"plot", folder.str("none"), "--out", folder.str("t.png")}).code == 2);
    const std::string table = folder.str("results.csv");
    std::ofstream(table) << "status,scene\nfinished,tiny\n";
    const Outcome other = call({"plot", a, table, "--out", folder.str("t.png")});
    CHECK(other.code == 0);
    CHECK(contains(other.err, "taut: skipped (runs of the same folder are drawn instead): results.csv\n"));
    std::ofstream(folder / "notes.txt") << "notes\n";
    const Outcome none =
        call({"plot", folder.str("notes.txt"), folder.str("discs.toml"), "--out", folder.str("t.png")});
    CHECK(none.code == 2);
    CHECK(
        contains(none.err,
                 "none of these is a run or a sweep; name folders that `taut run` or `taut sweep` has made"));
    CHECK(call({"plot", a, "--out", folder.str("t.jpg")}).code == 2);
  }
}
