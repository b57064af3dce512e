#include <map>
#include <set>

#include <doctest/doctest.h>

#include "cli/study/stability_map.hpp"
#include "tests/support/results_file.hpp"
#include "tests/support/sweep_folder.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

const std::string speeds =
    "finished,og,og,0.4,10,fractured,0.003,,,4,10\n"
    "finished,og,og,0.4,10,stable,,,,4,2\n"
    "error,enog,,,,,,,,,10\n"
    "finished,enog,enog,0.4,10,stable,,,,4,2\n"
    "failed,enog,enog,0.4,10,diverged,,,,4,3\n";

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE(
      "a map has a cell for each run, with its verdict and the verdict's start time, by rising values") {
    const TemporaryFolder folder;
    const std::string file = write_results(folder / "a", speeds, "rod", "speed");
    const taut::cli::StabilityMap map = taut::cli::make_map(taut::cli::read_results({file}), {});
    CHECK(map.label == "speed");
    REQUIRE(map.values == Texts{"2", "3", "10"});
    REQUIRE(map.rows == Texts{"og", "enog"});
    CHECK(map.cells[0][0]->verdict == "stable");
    CHECK_FALSE(map.cells[0][1].has_value());
    CHECK(map.cells[0][2]->verdict == "fractured");
    CHECK(*map.cells[0][2]->since == 0.003);
    CHECK(map.cells[1][1]->verdict == "diverged");
    CHECK(map.cells[1][2]->verdict.empty());
    CHECK(map.cells[1][2]->status == "error");
    const Outcome outcome = call({"map", file, "--out", folder.str("map.png")});
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.out, "og     stable  -         fractured 0.003 s\n"));
    CHECK(contains(outcome.out, "enog   stable  diverged  error\n"));
    CHECK(contains(text_of(folder / "map.dat"), "\n3 1 0.003 \"10\" \"og\" \"3\"\n"));
    CHECK(fs::exists(folder / "map.png"));
  }

  TEST_CASE(
      "a verdict that no run has is left out of the data of a map, so that gnuplot's block indices match") {
    const TemporaryFolder folder;
    const std::string file = write_results(folder / "a", speeds, "rod", "speed");  // no hourglass
    REQUIRE(call({"map", file, "--out", folder.str("map.png")}).code == 0);
    const std::string data = text_of(folder / "map.dat"), script = text_of(folder / "map.gp");
    CHECK_FALSE(contains(data, "hourglass"));
    std::size_t blocks = 0;
    for (const std::string name : {"stable", "fractured", "diverged", "no result"}) {
      CAPTURE(name);
      const std::string index = "index " + std::to_string(blocks++) + " ";
      const std::size_t at = script.find("title '" + name + "'");
      REQUIRE(at != std::string::npos);
      CHECK(script.rfind(index, at) != std::string::npos);
      CHECK(script.rfind(index, at) > script.rfind('\n', at));
    }
  }

  TEST_CASE("a map has texts only where they fit, and room for long names of methods") {
    const auto script_of = [](int columns, const std::string& method) {
      const TemporaryFolder folder;
      std::string lines;
      for (int k = 0; k < columns; ++k)
        lines += "finished," + method + "," + method + ",0.4,10,fractured,0.00345,,,4," +
                 std::to_string(0.0001 * (1000 + k)) + "\n";
      const std::string file = write_results(folder / "a", lines, "rod", "speed");
      const Outcome outcome = call({"map", file, "--out", folder.str("map.png")});
      CHECK(outcome.code == 0);
      return text_of(folder / "map.gp");
    };
    const auto count_of = [](const std::string& text, const std::string& part) {
      int count = 0;
      for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
      return count;
    };
    const auto number_after = [](const std::string& text, const std::string& part) {
      REQUIRE(contains(text, part));
      return std::stod(text.substr(text.find(part) + part.size()));
    };
    const std::string few = script_of(8, "og");
    CHECK(contains(few, "with labels font ',10'"));
    CHECK(count_of(few, "'0.100") == 8);
    const std::string more = script_of(30, "og");
    CHECK(number_after(more, "with labels font ',") < 10);
    CHECK(count_of(more, "'0.10") < 20);
    CHECK(count_of(more, "'0.10") > 5);
    const std::string many = script_of(200, "og");
    CHECK_FALSE(contains(many, "with labels"));
    CHECK(contains(many, "the start of each verdict is in map.dat"));
    const std::string name(40, 'm');
    const double pixels = 1280 * number_after(script_of(8, name), "set lmargin at screen ");
    CHECK(pixels > 40 * 8 + 30);  // letters of 8 pixels and a marker
    CHECK(1280 * number_after(few, "set lmargin at screen ") < 100);
  }

  TEST_CASE("runs without a result are in the rows of the finished runs") {
    const TemporaryFolder folder;
    std::ofstream(folder / "results.csv")
        << "status,set.speed,set.spacing,scene,method,spacing,particles,steps,verdict,seconds.solve\n"
           "finished,3,0.0012,rod,tl,0.0012121212121212121,9,9,stable,1\n"  // fitted to the first body
           "to do,5,0.0012,,,,,,,\n"
           "finished,3,0.0007,rod,tl,0.0007,9,9,stable,1\n"
           "to do,5,0.0007,,,,,,,\n";
    const auto map = make_map(read_results({folder.str("results.csv")}), {"speed"});
    CHECK(map.rows == Texts{"tl, spacing=0.0012", "tl, spacing=0.0007"});
    CHECK(map.cells[0][1]->status == "to do");
  }

  TEST_CASE("every verdict has a colour of its own") {
    const TemporaryFolder folder;
    std::string lines;
    for (const std::string verdict : {"stable", "hourglass", "penetrated", "fractured", "diverged"})
      lines += "finished,og,og,0.4,10," + verdict + ",,,,4," + std::to_string(lines.size()) + "\n";
    const std::string file = write_results(folder / "a", lines + "error,og,,,,,,,,,1000\n", "rod", "speed");
    const Outcome outcome = call({"map", file, "--out", folder.str("map.png")});
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.out, "penetrated"));
    const std::string script = text_of(folder / "map.gp");
    CHECK(contains(script, "title 'penetrated'"));
    const std::string mark = "fillcolor '";
    std::set<std::string> colors;
    for (std::size_t at = script.find(mark); at != std::string::npos; at = script.find(mark, at + 1))
      colors.insert(script.substr(at + mark.size(), 7));
    CHECK(colors.size() == 6);  // one is for runs without verdict
  }

  TEST_CASE("a map of an unknown, ambiguous or missing parameter, or in an unknown format, is refused") {
    const TemporaryFolder folder;
    const std::string file = write_results(folder / "a", speeds, "rod", "speed");
    const std::string other = write_results(folder / "b", speeds, "rod", "cfl");
    const std::string none = write_results(folder / "c", "finished,og,og,0.4,10,stable,,,,4,\n");
    const std::string out = folder.str("map.png");
    const std::map<Texts, std::string> wrong{
        {{file, "--parameter", "sped", "--out", out}, "did you mean 'speed'"},
        {{file, other, "--out", out}, "name one with --parameter"},
        {{none, "--out", out}, "only the method was swept"},
        {{file, "--out", folder.str("map.jpg")}, "must end in .png, .svg or .pdf"},
    };
    for (const auto& [arguments, message] : wrong) {
      Texts words{"map"};
      words.insert(words.end(), arguments.begin(), arguments.end());
      const Outcome outcome = call(words);
      CAPTURE(outcome.err);
      CHECK(outcome.code == 2);
      CHECK(contains(outcome.err, message));
    }
  }
}
