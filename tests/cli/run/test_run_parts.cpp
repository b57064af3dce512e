#include <limits>
#include <map>

#include <doctest/doctest.h>

#include "cli/drawing/bounds.hpp"
#include "cli/run/baseline.hpp"
#include "cli/run/history.hpp"
#include "cli/run/record.hpp"
#include "cli/run/schedule.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/text/format.hpp"
#include "engine/diagnostics/balance.hpp"
#include "engine/diagnostics/conservation.hpp"
#include "engine/error.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/relative.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

struct StandingSimulation : Simulation {
  void advance(double t, double) override {
    state.time = t;
    ++state.steps;
  }
  std::string save() override { return {}; }
  void load(std::string_view) override {}
  void take_snapshot(Snapshot&) const override {}
  const RunState& run_state() const override { return state; }

  RunState state;
};

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE(
      "output times start at 0 and, despite rounding, include an end that is a multiple of the interval") {
    CHECK(times_in_parts(0.75, 3) == std::vector<double>{0, 0.25, 0.5, 0.75});
    CHECK(times_every(0.3, 0.1) == std::vector<double>{0, 0.1, 0.2, 0.3});  // although 0.3 / 0.1 < 3
    CHECK(times_every(0.35, 0.1).back() == Approx(0.3));
    CHECK(times_every(1, 2) == std::vector<double>{0});
  }

  TEST_CASE(
      "a baseline inside its run folder is refused, even if the folder of a relative path does not exist") {
    const fs::path run = "no-such-folder/run";
    REQUIRE_FALSE(fs::exists(run.parent_path()));
    CHECK_THROWS_WITH_AS(Baseline(fs::absolute(run) / "baseline").check(run, true),
                         doctest::Contains("the baseline is inside the run folder"), UsageError);
    CHECK_NOTHROW(Baseline(fs::absolute("no-such-folder/baseline")).check(run, true));
  }

  TEST_CASE("an agenda returns each of its times once") {
    Agenda agenda({0, 1, 2, 5});
    CHECK(agenda.reached(0).size() == 1);
    CHECK(agenda.next() == 1);
    CHECK(std::ranges::equal(agenda.reached(2.5), std::vector{1.0, 2.0}));
    CHECK(agenda.reached(2.5).empty());
    CHECK(agenda.reached(5).front() == 5);
    CHECK(agenda.next() == std::numeric_limits<double>::infinity());
  }

  TEST_CASE("the pace settles at slices that take a fifth of a second to compute") {
    Pace pace(100);
    constexpr double seconds_per_time = 3;
    for (int k = 0; k < 40; ++k) pace.took(pace.slice(), pace.slice() * seconds_per_time);
    CHECK(pace.slice() * seconds_per_time == Approx(0.2));
  }

  TEST_CASE("the range of a sequence skips values that are not finite and is symmetric for signed fields") {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    SequenceBounds bounds;
    bounds.add_values(std::vector<double>{1, nan, infinity, -2});
    bounds.add_values(std::vector<double>{3});
    CHECK(bounds.range({}) == render::Range{-2, 3});
    CHECK(bounds.range(0.0) == render::Range{-3, 3});
    SequenceBounds flat;
    flat.add_values(std::vector<double>{0, 0});
    CHECK(flat.range(0.0).low < flat.range(0.0).high);
    CHECK(SequenceBounds().range({}).low < SequenceBounds().range({}).high);
  }

  TEST_CASE("values below the round-off do not make the range of a sequence clip greater values") {
    SequenceBounds bounds;
    bounds.add_values(std::vector<double>(2000, 1e-8));
    bounds.add_values(std::vector<double>{1, 4, 10});
    CHECK(bounds.range({}).high < 1);
    CHECK(bounds.range({}, 0.01) == render::Range{1e-8, 10});
  }

  TEST_CASE("the view of a sequence contains every particle") {
    SequenceBounds bounds;
    bounds.add_positions(std::vector<double>{0, 0, 1, 2}, 2, 0.2);
    bounds.add_positions(std::vector<double>{-1, 0, 1, 1}, 2, 0.2);
    const render::View view = bounds.view();
    CHECK(view.x_min < -1.1);
    CHECK(view.x_max > 1.1);
    CHECK(view.y_min < -0.1);
    CHECK(view.y_max > 2.2);
    CHECK(view.y_max < 2.5);
    CHECK(view.x_min == Approx(-1.1 - 0.11));
    CHECK(view.x_max == Approx(1.1 + 0.11));
    CHECK(view.y_min == Approx(-0.1 - 0.11));
    CHECK(view.y_max == Approx(2.1 + 0.11));
  }

  TEST_CASE("columns are aligned by displayed width, and numbers are formatted for readers") {
    CHECK(in_columns({{"σ", "a"}, {"long", "b"}}, 0) == "σ     a\nlong  b\n");
    CHECK(clock_time(7.4) == "0:07");
    CHECK(clock_time(3723) == "1:02:03");
    CHECK(with_prefix(4.1e6) == "4.1 M");
    CHECK(exact(0.1) == "0.1");
  }

  TEST_CASE("a step that is added several times has one row in the history") {
    const TemporaryFolder folder;
    StandingSimulation simulation;
    {
      History history(folder / "history.csv", Scene());
      history.add(simulation, {}, 1, {});
      history.add(simulation, {}, 1, {});
      simulation.advance_to(1);
      history.add(simulation, {}, 1, {});
    }
    CHECK(lines_of(folder / "history.csv").size() == 3);
  }

  TEST_CASE("each sum is in the column of its name") {
    Balance sums;
    sums.kinetic = 1, sums.strain = 2, sums.linear_momentum = {3, 4, 5}, sums.angular_momentum = {6, 7, 8};
    sums.work = 9, sums.damped = 10;
    for (const int dim : {2, 3}) {
      CAPTURE(dim);
      const TemporaryFolder folder;
      Scene scene;
      scene.dim = dim;
      scene.damping = 1;
      scene.gravity[0] = [](double) { return 1.0; };
      History(folder / "history.csv", scene).add(StandingSimulation(), sums, 11, {});
      const std::vector<std::string> lines = lines_of(folder / "history.csv");
      REQUIRE(lines.size() == 2);
      std::map<std::string, std::string> row;
      std::istringstream names(lines[0]), cells(lines[1]);
      for (std::string name, cell; std::getline(names, name, ',') && std::getline(cells, cell, ',');)
        row[name] = cell;
      CHECK(row["kinetic_energy"] == "1");
      CHECK(row["strain_energy"] == "2");
      CHECK(row["total_energy"] == "3");
      CHECK(row["work"] == "9");
      CHECK(row["damped"] == "10");
      CHECK(row["pieces"] == "11");
      CHECK(row["momentum_x"] == "3");
      CHECK(row["momentum_y"] == "4");
      CHECK(row["momentum_z"] == (dim == 3 ? "5" : ""));
      CHECK(row["angular_momentum_x"] == (dim == 3 ? "6" : ""));
      CHECK(row["angular_momentum_y"] == (dim == 3 ? "7" : ""));
      CHECK(row[dim == 3 ? "angular_momentum_z" : "angular_momentum"] == "8");
    }
  }

  TEST_CASE("the speed of a run counts only the time of the solver") {
    RunRecord record;
    record.particles = 300, record.steps = 20;
    record.seconds = {.setup = 7, .solve = 4, .render = 11, .write = 13};
    CHECK(record.particle_steps_per_second() == 1500.0);
    record.steps = 0;
    record.seconds.solve = 0;
    CHECK_FALSE(record.particle_steps_per_second());
  }

  TEST_CASE("an invalid run.json is not read") {
    const TemporaryFolder folder;
    const auto read = [&](const std::string& text) {
      write_atomically(folder / "run.json", text);
      return read_record(folder / "run.json");
    };
    CHECK_FALSE(read_record(folder / "run.json"));
    for (const char* text : {"", "[1]", "{}", "{\"taut\": \"0.1.0\"", "{\"status\": \"finished\"}"})
      CHECK_FALSE(read(text));
    for (const char* wrong : {R"("status": 3)", R"("verdict": "torn")", R"("reached": "far")"}) {
      const std::string text = R"({"taut": "0.1.0", "until": 0.5, )" + std::string(wrong) + "}";
      CHECK_FALSE(read(text));
      CHECK_THROWS_AS(checked_record(folder / "run.json"), UsageError);
    }
    const auto record = read(R"({"taut": "0.1.0", "status": null, "until": 0.5})");
    REQUIRE(record);
    CHECK(record->version == "0.1.0");
    CHECK_FALSE(record->status);
    CHECK_FALSE(record->verdict);
    CHECK_FALSE(record->reached);
    CHECK(record->until == 0.5);
    CHECK(read(R"({"taut": "0.1.0", "status": "failed"})")->status == RunRecord::Status::failed);
    CHECK(read(R"({"taut": "0.1.0", "verdict": "diverged"})")->verdict == Verdict::diverged);
  }

  TEST_CASE("a file is written completely or not at all") {
    const TemporaryFolder folder;
    write_atomically(folder / "a.txt", "old");
    write_atomically(folder / "a.txt", "new");
    CHECK(text_of(folder / "a.txt") == "new");
    CHECK_FALSE(fs::exists(folder / "a.txt.tmp"));
    fs::create_directories(folder / "b/full");
    CHECK_THROWS_AS(write_atomically(folder / "b", "text"), OutputError);
    CHECK_FALSE(fs::exists(folder / "b.tmp"));
    AppendFile full("/dev/full");
    CHECK_THROWS_AS(full.append("line"), OutputError);
  }
}
