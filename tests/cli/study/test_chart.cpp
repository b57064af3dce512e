#include <cmath>
#include <map>

#include <doctest/doctest.h>

#include "cli/study/chart.hpp"
#include "engine/error.hpp"
#include "tests/support/path_variable.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/results_file.hpp"
#include "tests/support/sweep_folder.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

const std::string converging =
    "finished,tl,tl,0.4,10,stable,,0.32,2,4,\n"
    "finished,tl,tl,0.2,20,stable,,0.08,2,32,\n"
    "finished,tl,tl,0.1,40,fractured,0.5,0.5,2,256,\n"
    "finished,tl,tl,0.05,80,stable,,0.005,2,2048,\n"
    "finished,og,og,0.4,10,stable,,0.3,2,5,\n"
    "failed,og,og,0.2,10,diverged,,,2,1,\n"
    "to do,og,,,,,,,,,\n";

taut::cli::Chart chart_of(const std::string& file, const taut::cli::ChartRequest& request = {}) {
  return taut::cli::make_chart(taut::cli::read_results({file}), request);
}

void sweep_rings(const TemporaryFolder& folder) {
  const Outcome outcome =
      program({"sweep", "colliding-rings", "--grid", "method=oenog,tl", "--grid", "spacing=0.005,0.0025",
               "--until", "0.006", "--quiet", "--out", folder.str("rings")});
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
}

std::vector<std::vector<std::string>> data_of(const fs::path& file) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& line : lines_of(file)) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    rows.emplace_back(std::istream_iterator<std::string>(words), std::istream_iterator<std::string>());
  }
  return rows;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a chart is refused if no run is left to compare") {
    const TemporaryFolder folder;
    REQUIRE(program(tiny_sweep(folder, "out", {"--grid", "method=enog,og"})).code == 0);
    const Outcome outcome =
        call({"chart", folder.str("out"), "--against", "enog", "--methods", "enog", "--markdown"});
    CHECK(outcome.code == 2);
    CAPTURE(outcome.err);
    CHECK(contains(outcome.err, "no run is left to compare with enog"));
  }

  TEST_CASE("orders are least-squares slopes of log error over log spacing") {
    const TemporaryFolder folder;
    const taut::cli::Chart chart = chart_of(write_results(folder.path(), converging));
    REQUIRE(chart.series.size() == 2);
    const taut::cli::ChartSeries& tl = chart.series[0];
    CHECK(tl.name == "tl");
    CHECK(*tl.order == Approx(2));
    CHECK_FALSE(chart.series[1].order.has_value());
    CHECK(chart.without_result == 1);
    CHECK(chart.references == Texts{"exact"});
    CHECK(chart.machines == Texts{"abacus, \"fast\", 1 thread"});
    REQUIRE(tl.points.size() == 4);
    CHECK_FALSE(tl.points[2].stable);
    CHECK_FALSE(chart.series[1].points[1].error.has_value());
    const std::vector<taut::cli::ChartPoint> bent{
        {.spacing = 4, .error = 16}, {.spacing = 2, .error = 2}, {.spacing = 1, .error = 1}};
    CHECK(*taut::cli::convergence_order(bent) == Approx(2));
  }

  TEST_CASE(
      "the default measure is the one with the most errors, and event times and errors with a unit come last") {
    const TemporaryFolder folder;
    const auto chosen = [&](const std::string& rows) {
      std::ofstream(folder / "results.csv")
          << "status,method,scene,particles,steps,spacing,verdict,seconds.solve,"
             "measures.touch_time.unit,measures.touch_time.reference,measures.touch_time.error,"
             "measures.rebound.unit,measures.rebound.reference,measures.rebound.error,"
             "measures.width.unit,measures.width.reference,measures.width.error,"
             "measures.period.unit,measures.period.reference,measures.period.error,"
             "measures.asymmetry.unit,measures.asymmetry.reference,measures.asymmetry.error\n"
          << rows;
      return chart_of(folder.str("results.csv")).measure;
    };
    const std::string run = "finished,tl,rod,9,9,0.2,stable,1,s,2,0.1,";
    CHECK(chosen(run + "1,0.8,,m,2,0.1,s,3,0.1,m,0,0.1\n" + run + "1,0.8,0.1,m,2,0.1,s,3,0.1,m,0,0.1\n") ==
          "width");
    CHECK(chosen(run + "1,0.8,0.1,m,2,0.1,s,3,0.1,m,0,0.1\n") == "rebound");
    CHECK(chosen(run + "1,0.8,,m,2,,s,3,0.1,m,0,0.1\n") == "period");
    CHECK(chosen(run + "1,,,m,,,s,,,m,0,0.1\n") == "touch_time");
  }

  TEST_CASE("a stable run is marked if a finer stable run of its line has a larger error") {
    const TemporaryFolder folder;
    const std::string file = write_results(folder.path(), converging +
                                                              "finished,pf,pf,0.4,10,stable,,0.2,2,5,\n"
                                                              "finished,pf,pf,0.2,10,stable,,0.3,2,9,\n"
                                                              "finished,pf,pf,0.1,10,stable,,0.1,2,9,\n");
    const taut::cli::Chart chart = chart_of(file);
    const auto marked = [&](int line) {
      std::string all;
      for (const taut::cli::ChartPoint& point : chart.series[static_cast<std::size_t>(line)].points)
        all += point.by_chance ? '1' : '0';
      return all;
    };
    CHECK(marked(0) == "0000");  // the third run, with the largest error, is fractured
    CHECK(marked(1) == "00");
    CHECK(marked(2) == "100");
    REQUIRE(call({"chart", file, "--out", folder.str("all.svg")}).code == 0);
    CHECK(contains(text_of(folder / "all.gp"), "title 'dot: finer run worse'"));
    REQUIRE(call({"chart", file, "--methods", "tl,og", "--out", folder.str("two.svg")}).code == 0);
    CHECK_FALSE(contains(text_of(folder / "two.gp"), "finer run worse"));
  }

  TEST_CASE("runs with different settings have separate lines, and the faster of two equal runs counts") {
    const TemporaryFolder folder;
    const std::string first = write_results(folder / "a",
                                            "finished,tl,tl,0.4,10,stable,,0.3,2,4,0.5\n"
                                            "finished,tl,tl,0.4,20,stable,,0.2,2,8,0.25\n",
                                            "rod", "cfl");
    const std::string second =
        write_results(folder / "b", "finished,tl,tl,0.4,10,stable,,0.3,2,3,0.5\n", "rod", "cfl");
    const taut::cli::Chart chart = taut::cli::make_chart(taut::cli::read_results({first, second}), {});
    REQUIRE(chart.series.size() == 2);
    CHECK(chart.series[0].name == "tl, cfl=0.5");
    CHECK(chart.series[1].name == "tl, cfl=0.25");
    REQUIRE(chart.series[0].points.size() == 1);
    CHECK(chart.series[0].points[0].cost == 3);
    const taut::cli::Chart steps = chart_of(first, {"bend", taut::cli::Cost::particle_steps});
    CHECK(steps.series[0].points[0].cost == 1000);
  }

  TEST_CASE("a chart shows the values of its runs, and its files are the same every time") {
    const TemporaryFolder folder;
    sweep_rings(folder);
    for (const std::string name : {"a.png", "b.svg"})
      for (const std::string again : {"one", "two"}) {
        const Outcome outcome = call({"chart", folder.str("rings"), "--measure", "least_diameter", "--out",
                                      folder.str(again + "/" + name)});
        CAPTURE(outcome.err);
        REQUIRE(outcome.code == 0);
        CHECK(contains(outcome.out, "order"));
      }
    for (const char* name : {"a.png", "a.gp", "a.dat", "b.svg", "b.gp", "b.dat"}) {
      CAPTURE(name);
      CHECK(text_of(folder / "one" / name).size() > 100);
      CHECK(text_of(folder / "one" / name) == text_of(folder / "two" / name));
    }
    CHECK(files_in(folder / "one") == 6);
    const auto rows = data_of(folder / "one/a.dat");
    REQUIRE(rows.size() == 4);
    for (const auto& row : rows) {
      REQUIRE(row.size() == 8);
      const std::string run = row[6].substr(1, row[6].size() - 2);
      const auto record = json_of(run + "/run.json");
      CHECK(std::stod(row[0]) == record["spacing"].get<double>());
      CHECK(std::stod(row[1]) == record["measures"]["least_diameter"]["error"].get<double>());
      CHECK(std::stod(row[2]) == record["seconds"]["cpu"].get<double>());
      CHECK(row[5] == record["verdict"].get<std::string>());
    }
    fs::remove(folder / "one/a.png");
    REQUIRE(std::system(("cd '" + folder.str("one") + "' && gnuplot a.gp").c_str()) == 0);
    CHECK(text_of(folder / "one/a.png") == text_of(folder / "two/a.png"));
  }

  TEST_CASE(
      "on the oscillating plate oenog converges with order 1.6, and tl at the same h with a lower order") {
    const TemporaryFolder folder;
    const auto series = [&](const std::string& method, const std::string& h) {
      const Outcome outcome = program({"sweep", "oscillating-plate", "--grid", "method=" + method, "--grid",
                                       "spacing=0.0033333333,0.0025,0.002", "--set", "method.h=" + h,
                                       "--until", "0.28", "--quiet", "--out", folder.str(method + h)});
      CAPTURE(outcome.err);
      REQUIRE(outcome.code == 0);
      const taut::cli::Chart chart = chart_of(folder.str(method + h), {"period", taut::cli::Cost::wall});
      REQUIRE(chart.series.size() == 1);
      return chart.series[0];
    };
    // with h = 1.05 dp, tl has 12 instead of 8 neighbours
    const auto oenog = series("oenog", "0.8"), tl = series("tl", "0.8"), wide_tl = series("tl", "1.05");
    CHECK(*oenog.order > 1.5);
    CHECK(*oenog.order < 1.7);
    CHECK(*tl.order > 1.15);
    CHECK(*tl.order < 1.45);
    CHECK(*wide_tl.order > 1.4);
    CHECK(*wide_tl.order < 1.75);
    REQUIRE(tl.points.size() == wide_tl.points.size());
    for (std::size_t k = 0; k < tl.points.size(); ++k)
      CHECK(tl.points[k].error.value() < 0.75 * wide_tl.points[k].error.value());
  }

  TEST_CASE("runs that sweep a parameter at its default join the line of runs without it") {
    const TemporaryFolder folder;
    const auto write = [&](const std::string& name, const std::string& head, const std::string& rows) {
      fs::create_directories(folder / name);
      std::ofstream(folder / name / "results.csv")
          << "status,method,scene,particles,steps,spacing,verdict,measures.bend.error,"
             "measures.bend.reference,seconds.solve,measures.bend.unit,parameters.v0"
          << head << "\n"
          << rows;
      return folder.str(name + "/results.csv");
    };
    const std::string plain = write(
        "plain", "",
        "finished,tl,rod,9,9,0.2,stable,0.1,2,1,m,0.06\nfinished,tl,rod,9,9,0.1,stable,0.05,2,8,m,0.06\n");
    const std::string swept = write("swept", ",set.v0",
                                    "finished,tl,rod,9,9,0.4,stable,0.2,2,0.1,m,0.06,0.06\n"
                                    "finished,tl,rod,9,9,0.4,stable,0.4,2,0.1,m,0.08,0.08\n");
    const taut::cli::Chart chart = taut::cli::make_chart(taut::cli::read_results({plain, swept}), {});
    REQUIRE(chart.series.size() == 2);
    CHECK(chart.series[0].name == "tl, v0=0.06");
    CHECK(chart.series[0].points.size() == 3);
    CHECK(chart.series[1].name == "tl, v0=0.08");
  }

  TEST_CASE("a chart with more lines than can be distinguished is refused") {
    const TemporaryFolder folder;
    std::string rows;
    for (int k = 0; k < 49; ++k)
      rows += "finished,m" + std::to_string(k) + ",m" + std::to_string(k) + ",0.4,10,stable,,0.3,2,4,\n";
    const Outcome outcome = call({"chart", write_results(folder / "a", rows), "--out", folder.str("a.png")});
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "the chart would have 49 lines"));
  }

  TEST_CASE("a chart draws error over cost, and unstable runs have open markers with a cross") {
    const TemporaryFolder folder;
    const std::string file = write_results(folder / "a", converging);
    REQUIRE(call({"chart", file, "--out", folder.str("c.svg")}).code == 0);
    const std::string script = text_of(folder / "c.gp");
    CHECK(contains(script, "set xlabel 'time to solve, s'"));
    CHECK(contains(script, "set ylabel 'error of the bend, % of the reference'"));
    CHECK(contains(script, ":2867.2]\nset yrange ["));  // 1.4 times the greatest cost
    CHECK(contains(script, "'×') with labels offset"));
    CHECK(contains(script, "set label 'og' at graph 1.01"));
    CHECK_FALSE(contains(script, "set label 'tl' at graph 1.01"));
    // cost ∝ dp⁻³, error ∝ dp²
    CHECK(contains(script, "**(-0.6666666666666666) with lines"));
    REQUIRE(call({"chart", file, "--methods", "og", "--out", folder.str("og.svg")}).code == 0);
    CHECK_FALSE(contains(text_of(folder / "og.dat"), "# tl"));
    const auto color = [](const std::string& text, const std::string& title) {
      const std::size_t at = text.rfind("linecolor '", text.find("title '" + title + "'"));
      return text.substr(at + 11, 7);
    };
    CHECK(color(script, "og") == color(text_of(folder / "og.gp"), "og"));
    CHECK(color(script, "tl") != color(script, "og"));
  }

  TEST_CASE("--stable-only excludes unstable runs, and a note mentions them") {
    const TemporaryFolder folder;
    const std::string file = write_results(folder / "a", converging);
    REQUIRE(call({"chart", file, "--stable-only", "--out", folder.str("c.svg")}).code == 0);
    const std::string script = text_of(folder / "c.gp");
    CHECK_FALSE(contains(script, "'×'"));
    CHECK(contains(script, "runs that are not stable"));
    CHECK_FALSE(contains(text_of(folder / "c.dat"), "fractured"));
    const std::string torn = write_results(folder / "b", "failed,og,og,0.4,10,fractured,,0.3,2,4,0.5\n");
    const Outcome none = call({"chart", torn, "--stable-only", "--out", folder.str("d.svg")});
    CHECK(none.code == 2);
    CHECK(contains(none.err, "none of the 1 runs is stable; leave out --stable-only"));
  }

  TEST_CASE("a chart with errors or costs of 0 is drawn, also of a single run") {
    const TemporaryFolder folder;
    for (const std::string row :
         {"finished,tl,tl,0.4,10,stable,,0,2,4,\n", "finished,tl,tl,0.4,10,stable,,0.1,2,0,\n",
          "failed,tl,tl,0.4,10,diverged,0.1,0,2,0,\n", "finished,tl,tl,0.4,10,stable,,1e-300,2,1e300,\n"}) {
      const Outcome outcome = call({"chart", write_results(folder / "a", row), "--out", folder.str("a.png")});
      CAPTURE(outcome.err);
      CHECK(outcome.code == 0);
    }
    const auto chart = chart_of(write_results(folder / "b",
                                              "finished,tl,tl,0.4,10,stable,,0,2,4,\n"
                                              "finished,tl,tl,0.2,10,stable,,0.1,2,4,\n"));
    CHECK(chart.series[0].points[0].error == 0.0);
    CHECK_FALSE(chart.series[0].order.has_value());
  }

  TEST_CASE("--against compares runs with the finest stable run of a method, and that run gets no point") {
    const TemporaryFolder folder;
    const std::string head =
        "status,method,scene,particles,steps,spacing,verdict,seconds.solve,measures.bend.value,"
        "measures.bend.unit,measures.bend.error\n";
    const auto row = [](const std::string& method, const char* spacing, const char* verdict,
                        const char* value) {
      return "finished," + method + ",rod,9,9," + spacing + "," + verdict + ",1," + value + ",m,\n";
    };
    std::ofstream(folder / "results.csv")
        << head << row("oenog", "0.002", "stable", "1.1") << row("oenog", "0.0005", "stable", "1")
        << row("oenog", "0.0001", "fractured", "9") << row("tl", "0.002", "stable", "0.7");
    const std::string file = folder.str("results.csv");
    const Outcome without = call({"chart", file, "--out", folder.str("a.png")});
    CHECK(without.code == 2);
    CHECK(contains(
        without.err,
        "; `taut chart --against METHOD` compares with the finest stable run of a method: oenog, tl"));
    const auto chart = chart_of(file, {.measure = "", .against = "oenog"});
    CHECK(chart.against == "oenog at 0.5 mm");
    REQUIRE(chart.series.size() == 2);
    REQUIRE(chart.series[0].points.size() == 2);
    CHECK(*chart.series[0].points[0].error == Approx(0.1));
    CHECK(*chart.series[1].points[0].error == Approx(0.3));
    REQUIRE(call({"chart", file, "--against", "oenog", "--out", folder.str("a.svg")}).code == 0);
    CHECK(contains(text_of(folder / "a.gp"),
                   "Compared with oenog at 0.5 mm, which is not an independent reference"));
    CHECK(contains(text_of(folder / "a.gp"), "difference of the bend from oenog at 0.5 mm, %"));
  }

  TEST_CASE("runs are compared only with a run with the same parameters") {
    const TemporaryFolder folder;
    const std::string head =
        "status,method,scene,particles,steps,spacing,verdict,seconds.solve,measures.bend.value,"
        "measures.bend.unit,set.nu\n";
    const auto row = [](const std::string& method, const char* spacing, const char* value, const char* nu) {
      return "finished," + method + ",rod,9,9," + spacing + ",stable,1," + value + ",m," + nu + "\n";
    };
    std::ofstream(folder / "results.csv")
        << head << row("oenog", "0.002", "1.1", "0.3") << row("oenog", "0.0005", "1", "0.3")
        << row("oenog", "0.001", "2", "0.4") << row("tl", "0.002", "0.7", "0.3")
        << row("tl", "0.002", "2.2", "0.4") << row("tl", "0.002", "3", "0.45");
    const auto chart = chart_of(folder.str("results.csv"), {.measure = "", .against = "oenog"});
    CHECK(chart.against == "oenog, the finest run of each nu");
    REQUIRE(chart.series.size() == 4);
    const std::map<std::string, std::optional<double>> errors{
        {"oenog, nu=0.3", 0.1}, {"tl, nu=0.3", 0.3}, {"tl, nu=0.4", 0.1}, {"tl, nu=0.45", std::nullopt}};
    for (const taut::cli::ChartSeries& series : chart.series) {
      CAPTURE(series.name);
      REQUIRE(series.points.size() == 1);
      const std::optional<double> error = errors.at(series.name);
      REQUIRE(series.points[0].error.has_value() == error.has_value());
      if (error) CHECK(*series.points[0].error == Approx(*error));
    }
  }

  TEST_CASE("a run without an error shows the reason, also for a measure without a unit") {
    const TemporaryFolder folder;
    std::ofstream(folder / "results.csv")
        << "status,method,scene,particles,steps,spacing,verdict,seconds.solve,measures.period.value,"
           "measures.period.unit,measures.period.reference,measures.period.error,measures.period.why\n"
           "finished,tl,rod,9,9,0.2,stable,1,2,,2.5,0.2,\n"
           "finished,og,rod,9,9,0.2,stable,1,3,,,,\n"
           "failed,enog,rod,9,9,0.2,diverged,1,,,,,too short\n"
           "failed,oas,rod,9,9,0.2,diverged,1,4,,,,\n"
           "finished,icb,rod,9,9,0.2,stable,1,,,,,too short\n"
           "finished,pf,rod,9,9,0.2,stable,1,,,,,there is no reference to compare with\n";
    const taut::cli::Chart chart = chart_of(folder.str("results.csv"));
    CHECK(chart.measure == "period");
    Texts why;
    for (const taut::cli::ChartSeries& series : chart.series)
      why.push_back(without_error(series.points.back()));
    CHECK(why == Texts{"", "no reference", "diverged", "no reference, diverged", "no value", "no reference"});
    const Outcome outcome = call({"chart", folder.str("results.csv"), "--out", folder.str("c.png")});
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.out, "- (no reference)"));
    CHECK(contains(text_of(folder / "c.gp"),
                   "Some or all runs have no error: og (no reference), enog (diverged)"));
  }

  TEST_CASE("a measure that is already an error cannot be compared with another run") {
    const TemporaryFolder folder;
    std::ofstream(folder / "results.csv")
        << "status,method,scene,particles,steps,spacing,verdict,seconds.solve,measures.rmse.kind,"
           "measures.rmse.value,measures.rmse.reference,measures.rmse.error,"
           "measures.peak.value,measures.peak.reference,measures.peak.error\n"
           "finished,tl,rod,9,9,0.2,stable,1,rmse,0.01,0,0.01,3,0,0.5\n"
           "finished,og,rod,9,9,0.2,stable,1,rmse,0.02,0,0.02,2,0,0\n";
    CHECK(chart_of(folder.str("results.csv"), {.measure = "peak", .against = "og"}).measure == "peak");
    CHECK(chart_of(folder.str("results.csv"), {.measure = "", .against = "og"}).measure == "peak");
    CHECK_THROWS_WITH_AS(chart_of(folder.str("results.csv"), {.measure = "rmse", .against = "og"}),
                         doctest::Contains("is already an error"), taut::UsageError);
  }

  TEST_CASE("--json and --markdown print the tables of a chart to stdout") {
    const TemporaryFolder folder;
    const std::string file = write_results(folder / "a", converging);
    const Outcome json = call({"chart", file, "--json"});
    REQUIRE(json.code == 0);
    const auto tree = nlohmann::json::parse(json.out);
    CHECK(tree["error"] == "error of bend, share of the reference");
    CHECK(tree["series"][0]["order"].get<double>() == Approx(2));
    CHECK(tree["series"][0]["runs"][2]["stable"] == false);
    CHECK(tree["series"][1]["runs"][1]["error"].is_null());
    const Outcome markdown = call({"chart", file, "--methods", "tl", "--markdown"});
    CHECK(contains(markdown.out, "| `tl` | 32 % | 8 % | 50 % (fractured) | 0.5 % | 2 | 2048 |"));
    CHECK_FALSE(contains(markdown.out, "`og`"));
    CHECK(call({"chart", file}).code == 2);
    CHECK(call({"chart", file, "--json", "--markdown"}).code == 2);
  }

  TEST_CASE("names in a chart have no special meaning to gnuplot") {
    const TemporaryFolder folder;
    const std::string file =
        write_results(folder / "a", "finished,tl,t'l_`touch x`,0.4,10,stable,,0.3,2,4,\n");
    const Outcome outcome = call({"chart", file, "--out", folder.str("it's.svg")});
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(contains(text_of(folder / "it's.svg"), "_`touch x`"));
    CHECK_FALSE(fs::exists(folder / "x"));
  }

  TEST_CASE("quotes in the title of a chart are drawn, also at its beginning or several in succession") {
    const TemporaryFolder folder;
    const std::string file = write_results(folder / "a", "finished,tl,tl,0.4,10,stable,,0.3,2,4,\n");
    for (const std::string title : {"'Soft' rings", "a ''b'' c", "''", "it's"}) {
      CAPTURE(title);
      std::ofstream(folder / "a/results.json")
          << "{\"title\": \"" << title << "\", \"swept\": [], \"fixed\": {}}";
      const Outcome outcome = call({"chart", file, "--out", folder.str("a.svg")});
      CAPTURE(outcome.err);
      CHECK(outcome.code == 0);
      std::string drawn = text_of(folder / "a.svg");
      for (std::size_t at = 0; (at = drawn.find("&#39;")) != std::string::npos;) drawn.replace(at, 5, "'");
      CHECK(contains(drawn, title));
    }
  }

  TEST_CASE("names of picture files have no special meaning to gnuplot") {
    const TemporaryFolder folder;
    const std::string file = write_results(folder / "a", "finished,tl,tl,0.4,10,stable,,0.3,2,4,\n");
    for (const std::string name : {"|touch x;", "<touch x;", "-e", "-", "'q' \"r\" \\", "x''y",
                                   "a\nsystem 'touch x'\n#\t", "`touch x`", "$(touch x) %d @x {=9 y}_z^a"}) {
      CAPTURE(name);
      const fs::path picture = folder / (name + ".svg");
      const Outcome outcome = call({"chart", file, "--out", picture.string()});
      CHECK_MESSAGE(outcome.code == 0, outcome.err);
      REQUIRE(fs::exists(picture));
      const std::string drawn = text_of(picture);
      fs::remove(picture);
      const std::string script = fs::path(picture).replace_extension(".gp").filename().string();
      REQUIRE(std::system(
                  ("cd " + shell_word(folder.path().string()) + " && gnuplot " + shell_word("./" + script))
                      .c_str()) == 0);
      CHECK(text_of(picture) == drawn);
    }
    CHECK_FALSE(fs::exists(folder / "x"));
    CHECK(files_in(folder.path()) == 1 + 3 * 9);
  }

  TEST_CASE("charts that cannot be drawn are refused with the reason") {
    const TemporaryFolder folder;
    const std::string good = write_results(folder / "good", converging);
    const std::string other = write_results(folder / "other", converging, "ring");
    const std::string bare = write_results(folder / "bare", "finished,tl,tl,0.4,10,stable,,,,4,\n");
    const std::string waiting = write_results(folder / "waiting", "to do,tl,,,,,,,,,\n");
    std::ofstream(folder / "foreign.csv") << "a,b\n1,2\n";
    std::ofstream(folder / "torn.csv") << "status,scene\nfinished\n";
    std::ofstream(folder / "open.csv") << "status,\"scene\n";
    fs::create_directories(folder / "empty");
    const std::string out = folder.str("chart.png");
    const std::map<Texts, std::string> wrong{
        {{good, other, "--out", out}, "different scenes"},
        {{good, good, "--out", out}, "given twice"},
        {{good, "--measure", "bent", "--out", out}, "did you mean 'bend'"},
        {{good, "--measure", "twist", "--out", out}, "no reference for it"},
        {{good, "--cost", "second", "--out", out}, "did you mean 'seconds'"},
        {{good, "--methods", "tl,oog", "--out", out}, "unknown method 'oog' (did you mean 'og'?)"},
        {{good, "--against", "tll", "--out", out}, "did you mean 'tl'"},
        {{good, "--out", folder.str("chart.jpg")}, "must end in .png, .svg or .pdf"},
        {{bare, "--out", out}, "no measure in the results of rod has an error"},
        {{waiting, "--out", out}, "has a result"},
        {{folder.str("foreign.csv"), "--out", out}, "it has no column status, scene"},
        {{folder.str("torn.csv"), "--out", out}, "torn.csv:2: 1 cells under 2 columns"},
        {{folder.str("open.csv"), "--out", out}, "a quote is not closed"},
        {{folder.str("none.csv"), "--out", out}, "cannot be read"},
        {{folder.str("empty"), "--out", out}, "contains no results.csv"},
    };
    for (const auto& [arguments, message] : wrong) {
      Texts words{"chart"};
      words.insert(words.end(), arguments.begin(), arguments.end());
      const Outcome outcome = call(words);
      CAPTURE(outcome.err);
      CHECK(outcome.code == 2);
      CHECK(contains(outcome.err, message));
    }
    CHECK_FALSE(fs::exists(folder / "chart.dat"));
  }

  TEST_CASE("if gnuplot is missing, data and script are kept, and the message names the package to install") {
    const TemporaryFolder folder;
    const std::string file = write_results(folder / "results", converging);
    fs::create_directories(folder / "bin");
    const OnlyPath path(folder / "bin");
    const Outcome outcome = call({"chart", file, "--out", folder.str("chart.png")});
    CHECK(outcome.code == 4);
    CHECK(contains(outcome.err, "apt-get install gnuplot-nox"));
    CHECK(fs::exists(folder / "chart.gp"));
    CHECK(fs::exists(folder / "chart.dat"));
    CHECK_FALSE(fs::exists(folder / "chart.png"));
  }
}
