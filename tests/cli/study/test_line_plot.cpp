#include <cmath>
#include <sstream>

#include <doctest/doctest.h>

#include "tests/support/relative.hpp"
#include "tests/support/sweep_folder.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

/// Flies without strain, so that fields along its lines are known.
std::string write_block(const TemporaryFolder& folder) {
  std::ofstream(folder / "block.toml") << R"(
title = "A flying block"
spacing = 0.002
until = 3e-4
method = "tl"
[parameters]
speed = { value = 2, unit = "m/s", help = "speed of the block" }
[material.rubber]
density = 1000
youngs_modulus = 1e6
poisson_ratio = 0.4
[[body]]
name = "block"
shape = { type = "rectangle", low = [0, 0], high = [0.02, 0.01] }
material = "rubber"
velocity = ["speed", 0]
[[line]]
name = "along"
body = "block"
field = "speed"
from = [0.003, 0.005]
to = [0.017, 0.005]
points = 8
times = [1e-4, 2e-4]
[[line]]
name = "across"
body = "block"
field = "speed"
from = [0.009, 0.001]
to = [0.009, 0.009]
points = 5
times = [2e-4]
[[line]]
name = "load"
body = "block"
field = "pressure"
from = [0.003, 0.005]
to = [0.017, 0.005]
points = 8
times = [2e-4]
[[measure]]
name = "along_error"
of = "line_rmse"
line = "along"
unit = "m/s"
[[measure]]
name = "across_error"
of = "line_rmse"
line = "across"
unit = "m/s"
[[reference]]
law = "neo-hookean"
name = "made up"
solutions = { along_error = "speed + 1000*t + x" }
tables = { across_error = { file = "across.csv", column = "v" } }
)";
  std::ofstream(folder / "across.csv") << "s,v\n0,3\n0.008,4\n";
  return folder.str("block.toml");
}

void run_block(const TemporaryFolder& folder, const std::string& out, const Texts& more = {}) {
  Texts words{"run",   write_block(folder), "--no-render", "--quiet", "--threads", "1",
              "--out", folder.str(out)};
  words.insert(words.end(), more.begin(), more.end());
  const Outcome outcome = call(words);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
}

Outcome plot_lines(const TemporaryFolder& folder, const Texts& more) {
  Texts words{"plot"};
  words.insert(words.end(), more.begin(), more.end());
  words.insert(words.end(), {"--out", folder.str("p.svg")});
  return call(words);
}

std::vector<double> row_of(const std::string& line) {
  std::istringstream words(line);
  std::vector<double> row;
  for (std::string word; words >> word;) row.push_back(std::stod(word));
  return row;
}

/// Block of the data file: comments, then rows of numbers.
struct Block {
  Texts comments;
  std::vector<std::vector<double>> rows;
};

std::vector<Block> blocks_of(const fs::path& file) {
  std::vector<Block> blocks;
  bool is_open = false;
  for (const std::string& line : lines_of(file)) {
    if (line.empty()) {
      is_open = false;
      continue;
    }
    if (!is_open) blocks.emplace_back();
    is_open = true;
    if (line.starts_with("# "))
      blocks.back().comments.push_back(line.substr(2));
    else
      blocks.back().rows.push_back(row_of(line));
  }
  return blocks;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("plot draws a field along a line, a curve for each run and time, with exact solutions") {
    const TemporaryFolder folder;
    run_block(folder, "a");
    run_block(folder, "b", {"--set", "speed=5"});
    const Outcome outcome = plot_lines(folder, {folder.str("b"), folder.str("a"), "--lines", "along"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(contains(outcome.out, "lines  "));
    const std::vector<Block> blocks = blocks_of(folder / "p.dat");
    REQUIRE(blocks.size() == 8);
    const Texts names{"tl, speed=2, t = 100 µs", "tl, speed=2, t = 200 µs", "tl, speed=5, t = 100 µs",
                      "tl, speed=5, t = 200 µs"};
    for (std::size_t k = 0; k < 4; ++k) {
      CAPTURE(k);
      CHECK(blocks[k].comments == Texts{names[k], "distance from the first point, m; along, m/s"});
      REQUIRE(blocks[k].rows.size() == 8);
      for (std::size_t point = 0; point < 8; ++point) {
        CHECK(blocks[k].rows[point][0] == Approx(0.002 * static_cast<double>(point)));
        CHECK(blocks[k].rows[point][1] == Approx(k < 2 ? 2 : 5));
      }
      const Block& exact = blocks[4 + k];
      CHECK(exact.comments ==
            Texts{std::string("reference of along: made up, t = ") + (k % 2 == 0 ? "0.0001 s" : "0.0002 s")});
      CHECK(exact.rows.front()[0] == 0);
      CHECK(exact.rows.front()[1] == Approx((k < 2 ? 2 : 5) + (k % 2 == 0 ? 0.1 : 0.2) + 0.003));
      CHECK(exact.rows.back()[0] == Approx(0.014));
      CHECK(exact.rows.back()[1] == Approx((k < 2 ? 2 : 5) + (k % 2 == 0 ? 0.1 : 0.2) + 0.017));
    }
    const std::string script = text_of(folder / "p.gp");
    CHECK(contains(script, "set xlabel 'distance from the first point, mm'"));
    CHECK(contains(script, "set ylabel 'along, m/s'"));
    CHECK(contains(script, "title 'reference: made up'"));

    REQUIRE(
        plot_lines(folder, {folder.str("a"), "--lines", "along", "--times", "2.0001e-4", "--x", "x"}).code ==
        0);
    const std::vector<Block> one = blocks_of(folder / "p.dat");
    REQUIRE(one.size() == 2);
    CHECK(one[0].comments == Texts{"tl", "x, m; along at t = 200 µs, m/s"});
    CHECK(one[0].rows.front()[0] == Approx(0.003));
    CHECK(one[1].rows.back()[0] == Approx(0.017));
  }

  TEST_CASE("lines of different lengths share a panel, and a reference can be a table") {
    const TemporaryFolder folder;
    run_block(folder, "a");
    REQUIRE(plot_lines(folder, {folder.str("a"), "--lines", "along+across", "--times", "2e-4"}).code == 0);
    std::vector<Block> blocks = blocks_of(folder / "p.dat");
    REQUIRE(blocks.size() == 3);
    REQUIRE(blocks[0].rows.size() == 8 + 5);
    CHECK(blocks[0].rows[7][1] == Approx(2));
    CHECK(std::isnan(blocks[0].rows[7][2]));
    CHECK(blocks[0].rows[12][0] == Approx(0.008));
    CHECK(std::isnan(blocks[0].rows[12][1]));
    CHECK(blocks[0].rows[12][2] == Approx(2));
    CHECK(blocks[2].rows == std::vector<std::vector<double>>{{0, 3}, {0.008, 4}});
    CHECK(contains(text_of(folder / "p.gp"), "title 'across at "));
    REQUIRE(plot_lines(folder, {folder.str("a"), "--lines", "across", "--x", "y"}).code == 0);
    blocks = blocks_of(folder / "p.dat");
    CHECK(blocks[1].rows[0][0] == Approx(0.001));
    CHECK(blocks[1].rows[1][0] == Approx(0.009));
  }

  TEST_CASE("plot draws a line for each run that reached its time, and names the others") {
    const TemporaryFolder folder;
    run_block(folder, "a");
    run_block(folder, "b", {"--until", "1.5e-4"});
    const Texts runs{folder.str("a"), folder.str("b"), "--lines", "along", "--times", "2e-4"};
    const Outcome outcome = plot_lines(folder, runs);
    CHECK(outcome.code == 0);
    CHECK(
        contains(outcome.err,
                 "b/' has no sample of line 'along' at 0.0002 s; the scene samples it at 0.0001, 0.0002 s"));
    CHECK_FALSE(contains(outcome.err, "a/' has no sample"));
    const Outcome none = plot_lines(folder, {folder.str("b"), "--lines", "across"});
    CHECK(none.code == 2);
    CHECK(contains(none.err, "b/' has no sample of line 'across' at 0.0002 s"));
  }

  TEST_CASE("plot refuses unknown lines, times and axes, and options that contradict --lines") {
    const TemporaryFolder folder;
    run_block(folder, "a");
    REQUIRE(call(tiny_run(folder, "discs", {"--no-render", "--until", "1e-5"})).code == 0);
    const std::string a = folder.str("a");
    const std::vector<std::pair<Texts, std::string>> wrong = {
        {{a, "--lines", "alonng"}, "unknown line 'alonng' (did you mean 'along'?)"},
        {{a, "--lines", "along", "--times", "2.5e-4"}, "a/' has no sample of line 'along' at 0.00025 s"},
        {{a, "--lines", "along", "--x", "z"}, "unknown axis of lines 'z'"},
        {{a, "--lines", "along+load"}, "'along' and 'load' have different units ('m/s', 'Pa')"},
        {{a, "--times", "2e-4"}, "--times needs --lines"},
        {{a, "--lines", "along", "--columns", "step"}, "give only one of them"},
        {{a, "--lines", "along", "--y", "along_error"}, "give only one of them"},
        {{folder.str("discs"), "--lines", "along"}, "the scene 'discs' samples no [[line]]"},
    };
    for (const auto& [words, message] : wrong) {
      const Outcome outcome = plot_lines(folder, words);
      CAPTURE(outcome.err);
      CHECK(outcome.code == 2);
      CHECK(contains(outcome.err, message));
    }
  }
}
