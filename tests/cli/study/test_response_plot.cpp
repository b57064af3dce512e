#include <algorithm>
#include <fstream>

#include <doctest/doctest.h>

#include "cli/study/map_drawing.hpp"
#include "cli/study/response_plot.hpp"
#include "engine/error.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/sweep_folder.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

const std::string header =
    "index,folder,set.thickness,set.method,set.cfl,status,scene,method,spacing,particles,steps,verdict,"
    "measures.deflection.kind,measures.deflection.value,measures.deflection.unit,"
    "measures.deflection.reference,measures.deflection.reference_name,measures.deflection.error,"
    "measures.peak_time.value,measures.peak_time.unit,threads,machine,seconds.solve\n";

struct Row {
  std::string thickness, method, cfl, verdict, deflection, reference;
};

std::vector<Row> beams() {
  return {{"0.02", "tl", "0.3", "stable", "0.002", "0.0021"},
          {"0.01", "tl", "0.3", "stable", "0.016", "0.0168"},
          {"0.01", "oenog", "0.3", "stable", "0.0165", "0.0168"},
          {"0.02", "oenog", "0.3", "fractured", "0.0019", "0.0021"}};
}

StoredResults results_of(const TemporaryFolder& folder, const std::vector<Row>& rows) {
  std::ofstream file(folder / "results.csv");
  file << header;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Row& row = rows[k];
    const bool failed = row.verdict != "stable";
    file << k << ",run" << k << ',' << row.thickness << ',' << row.method << ',' << row.cfl << ','
         << (failed ? "failed" : "finished") << ",beam," << row.method << ",0.001,100,10," << row.verdict
         << ",value," << row.deflection << ",m," << row.reference << ",beam theory,0.05,0.5,s,1,here,2\n";
  }
  file.close();
  StoredResults results = read_results({folder.str("results.csv")});
  results.units["thickness"] = "m";
  return results;
}

ResponsePlot plot_of(const std::vector<Row>& rows, const ResponseRequest& request) {
  const TemporaryFolder folder;
  return make_response_plot(results_of(folder, rows), request);
}

std::string error_of(const std::vector<Row>& rows, const ResponseRequest& request) {
  try {
    plot_of(rows, request);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

Texts names_of(const ResponsePlot::Panel& panel) {
  Texts names;
  for (const ResponsePlot::Line& line : panel.lines) names.push_back(line.name);
  return names;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a plot of measures over a parameter has a line per method, and the reference once") {
    const ResponsePlot plot = plot_of(beams(), {"thickness", {"deflection"}, {"method"}});
    REQUIRE(plot.panels.size() == 1);
    const auto& lines = plot.panels[0].lines;
    REQUIRE(names_of(plot.panels[0]) == Texts{"tl", "oenog", "reference: beam theory"});
    CHECK(lines[0].points[0].x == 0.01);
    CHECK(lines[0].points[1].y == 0.002);
    CHECK(lines[1].points[0].stable);
    CHECK_FALSE(lines[1].points[1].stable);
    CHECK(lines[2].is_reference);
    CHECK(lines[2].points.size() == 2);
    CHECK(plot.without_value == 0);
    // by default, `by` is the method and all settings that differ, and `x` is the only swept parameter
    const ResponsePlot same = plot_of(beams(), {"", {"deflection"}});
    CHECK(same.x.name == "thickness");
    CHECK(names_of(same.panels[0]) == names_of(plot.panels[0]));
  }

  TEST_CASE("references that differ between lines are drawn for each line") {
    std::vector<Row> rows = beams();
    rows[2].reference = "0.017";
    const ResponsePlot plot = plot_of(rows, {"thickness", {"deflection"}, {"method"}});
    CHECK(names_of(plot.panels[0]) ==
          Texts{"tl", "oenog", "reference: beam theory, oenog", "reference: beam theory, tl"});
  }

  TEST_CASE(
      "two runs with the same x on one line are refused, and the message names the setting that differs") {
    std::vector<Row> rows = beams();
    rows.push_back({"0.01", "tl", "0.2", "stable", "0.0161", "0.0168"});
    const std::string error = error_of(rows, {"thickness", {"deflection"}, {"method"}});
    CHECK(contains(error, "line 'tl' would have two values at thickness = 0.01"));
    CHECK(contains(error, "differ in cfl; draw a line for each with --by method,cfl"));
    const ResponsePlot both = plot_of(rows, {"thickness", {"deflection"}, {"method", "cfl"}});
    CHECK(names_of(both.panels[0])[0] == "tl, cfl=0.3");
    CHECK(both.panels[0].lines.size() == 4);
    rows.back().cfl = "0.3";
    CHECK(contains(error_of(rows, {"thickness", {"deflection"}, {"method"}}), "have the same settings"));
  }

  TEST_CASE("a plot of measures names the nearest column, and refuses columns that it cannot draw") {
    CHECK(contains(error_of(beams(), {"thicknes", {"deflection"}}), "(did you mean 'thickness'?)"));
    CHECK(contains(error_of(beams(), {"thickness", {"deflexion"}}),
                   "unknown column or measure 'deflexion' (did you mean 'deflection'?)"));
    CHECK(contains(error_of(beams(), {"thickness", {"deflection"}, {"methd"}}), "did you mean 'method'?"));
    CHECK(contains(error_of(beams(), {"method", {"deflection"}}), "'method' is not a number in any run"));
    CHECK(contains(error_of(beams(), {"thickness", {"verdict"}}), "no run has a number for both"));
    CHECK(contains(error_of(beams(), {"thickness", {"deflection+peak_time"}}),
                   "have different units ('m', 's'); draw each in its own panel: --y deflection,peak_time"));
    CHECK(plot_of(beams(), {"thickness", {"deflection", "peak_time"}}).panels.size() == 2);
  }

  TEST_CASE("axes of measures have SI prefixes, and unstable runs have open markers") {
    const ResponsePlot plot = plot_of(beams(), {"thickness", {"deflection", "deflection.error"}, {"method"}});
    const std::string script = response_script(plot, {"p.png"}, {});
    CHECK(contains(script, "set xlabel 'thickness, mm'"));
    CHECK(contains(script, "set ylabel 'deflection, mm'"));
    CHECK(contains(script, "set ylabel 'deflection (error), %'"));
    CHECK(contains(script, "($1*1000):($2*1000) with linespoints"));
    CHECK(contains(script, "title 'open: not stable'"));
    CHECK(
        contains(response_data(plot), "# thickness, m; deflection, m; stable\n0.01 0.016 1\n0.02 0.002 1\n"));
    CHECK(contains(response_data(plot), "0.01 5 1\n"));
    PlotLook look;
    look.log_x = look.log_y = true;
    CHECK(contains(response_script(plot, {"p.png"}, look), "set logscale xy\n"));
    std::vector<Row> below = beams();
    for (Row& row : below) row.deflection = "-1", row.reference = "";
    CHECK_THROWS_WITH_AS(response_script(plot_of(below, {"thickness", {"deflection"}}), {"p.png"}, look),
                         doctest::Contains("no value at the y axis is positive"), UsageError);
  }

  TEST_CASE("with --width, texts of a plot are 7 points high in PNG and PDF") {
    PlotLookOptions typed;
    typed.width = "85mm";
    const PlotLook png = plot_look(typed, {"p.png"}), pdf = plot_look(typed, {"p.pdf"});
    CHECK(png.width * png.scale == Approx(85 / 25.4 * 300).epsilon(0.002));
    CHECK(11 * png.scale == Approx(7 * 300 / 96.0));
    CHECK(pdf.width == png.width);
    CHECK(11 * pdf.scale == Approx(7));
    const std::string script =
        response_script(plot_of(beams(), {"thickness", {"deflection"}}), {"p.pdf"}, pdf);
    CHECK(contains(script, "set terminal pdfcairo noenhanced size 3.34"));
    typed.width = "85";
    CHECK_THROWS_WITH_AS(plot_look(typed, {"p.png"}),
                         doctest::Contains("--width is '85'; it must be a length"), UsageError);
    typed = {};
    typed.log = "z";
    CHECK_THROWS_AS(plot_look(typed, {"p.png"}), UsageError);
    typed = {};
    typed.title = "none", typed.size = "640x480";
    CHECK(plot_look(typed, {"p.png"}).title == "");
    CHECK(plot_look(typed, {"p.png"}).height == 480);
    typed.width = "85mm", typed.size = "100x2000";
    CHECK_THROWS_WITH_AS(plot_look(typed, {"p.png"}), doctest::Contains("would be 20079 pixels high"),
                         UsageError);
    typed.width = "850mm", typed.size = {};
    CHECK_THROWS_WITH_AS(plot_look(typed, {"p.png"}), doctest::Contains("would be 10039 pixels wide"),
                         UsageError);
  }

  TEST_CASE("a map of a measure shows values, unit, and a cross for unstable runs") {
    const TemporaryFolder folder;
    const StoredResults results = results_of(folder, beams());
    const StabilityMap map = make_map(results, {"thickness", "deflection"});
    CHECK(contains(map_table(map), "0.0019 m (fractured)"));
    const std::string script = map_script(map, {"m.png"}), data = map_data(map);
    CHECK(contains(script, "set cblabel 'deflection, mm'"));
    CHECK(contains(script, "×: not stable"));
    CHECK(contains(data, "\"1.9 ×\""));
    CHECK(contains(data, "\"16.5\""));
    const std::string json = to_json(map).dump(2);
    CHECK(contains(json, "\"measure\": \"deflection\""));
    CHECK(contains(json, "\"value\": 0.0165"));
    CHECK_FALSE(contains(to_json(make_map(results, {"thickness"})).dump(2), "\"value\""));
    CHECK_THROWS_WITH_AS(make_map(results, {"thickness", "deflectoin"}),
                         doctest::Contains("did you mean 'deflection'"), UsageError);
  }

  TEST_CASE("plot DIR/* of a sweep draws its runs and names the files that it skips") {
    const TemporaryFolder folder;
    REQUIRE(program(tiny_sweep(folder, "sweep", {"--grid", "speed=2,3,4", "--until", "5e-4"})).code == 0);
    Texts words{"plot"};
    for (const auto& entry : fs::directory_iterator(folder / "sweep")) words.push_back(entry.path().string());
    Texts measures = words;
    for (const char* word : {"--x", "speed", "--y", "total_energy", "--out"}) measures.emplace_back(word);
    words.insert(words.end(), {"--out", folder.str("p.png")});
    const Outcome histories = call(words);
    CAPTURE(histories.err);
    CHECK(histories.code == 0);
    CHECK(contains(histories.err, "taut: skipped (neither a run nor a sweep): "));
    CHECK(
        contains(histories.err, "taut: skipped (runs of the same folder are drawn instead): results.csv\n"));
    CHECK(contains(text_of(folder / "p.gp"), "title 'speed=3'"));
    const Texts sweep{"plot", folder.str("sweep"), "--out", folder.str("s.png")};
    CHECK(call(sweep).code == 0);
    CHECK(text_of(folder / "s.dat") == text_of(folder / "p.dat"));
    const Outcome of_sweep =
        call({"plot", folder.str("sweep"), "--y", "particles", "--out", folder.str("a.svg")});
    CAPTURE(of_sweep.err);
    CHECK(of_sweep.code == 0);
    CHECK(contains(text_of(folder / "a.gp"), "set xlabel 'speed, m/s'"));
    measures.push_back(folder.str("b.png"));
    CHECK(contains(call(measures).err, "unknown column or measure 'total_energy'"));
    CHECK(contains(call({"plot", folder.str("sweep"), "--by", "method", "--out", folder.str("c.png")}).err,
                   "--by needs --y"));
  }
}
