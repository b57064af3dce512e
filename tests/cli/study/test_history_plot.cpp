#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <doctest/doctest.h>

#include "cli/study/curve_style.hpp"
#include "cli/study/gnuplot.hpp"
#include "cli/study/history_plot.hpp"
#include "cli/study/letters.hpp"
#include "cli/study/study.hpp"
#include "engine/methods/catalogue.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/sweep_folder.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

std::string record_with(const std::string& parameters) {
  return R"({"taut": "0.1.0", "scene": "rod", "method": "tl", "status": "finished", "until": 1, "reached": 1,)"
         R"( "verdict": "stable", "since": {}, "measures": {}, "parameters": {)" +
         parameters + "}}";
}

using NamedRuns = std::vector<std::pair<std::string, std::string>>;

HistoryPlot falling(const NamedRuns& runs, double high = 1) {
  HistoryPlot plot;
  plot.title = "A rod", plot.columns = {{"tip", "tip, m"}};
  for (const auto& [method, rest] : runs)
    plot.curves.push_back({method + (rest.empty() ? "" : ", " + rest), method, {{0, high}, {1, 0.1 * high}}});
  return plot;
}

NamedRuns speeds_of(const std::string& method, int count) {
  NamedRuns names;
  for (int k = 0; k < count; ++k) names.emplace_back(method, "speed=" + std::to_string(k + 1));
  return names;
}

std::set<std::string> looks(const std::string& script) {
  std::set<std::string> all;
  for (std::size_t at = script.find("keyentry "); at != std::string::npos;
       at = script.find("keyentry ", at + 1))
    all.insert(script.substr(at, script.find(" title ", at) - at));
  return all;
}

std::string script_of(const HistoryPlot& plot) { return history_script(plot, {"p.png"}); }

double left_of(const std::string& script) {
  const std::string key = "set lmargin at screen ";
  REQUIRE(contains(script, key));
  return 1280 * std::stod(script.substr(script.find(key) + key.size()));
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("up to 24 lines all look different, of one method or several") {
    for (const int count : {2, 6, 9, 24}) {
      const std::string script = script_of(falling(speeds_of("oenog", count)));
      CHECK(looks(script).size() == static_cast<std::size_t>(count));
    }
    NamedRuns two = speeds_of("tl", 7);
    const NamedRuns more = speeds_of("oenog", 7);
    two.insert(two.end(), more.begin(), more.end());
    CHECK(looks(script_of(falling(two))).size() == 14);
    const std::string methods = script_of(falling({{"og", ""}, {"tl", ""}}));
    const std::string alone = script_of(falling({{"og", ""}}));
    CHECK(looks(methods).contains(*looks(alone).begin()));
  }

  TEST_CASE("in panels of several columns, each run has a colour, and each column has a dash") {
    Texts methods{"tl"};
    for (const MethodInfo& method : taut::methods())  // the first that shares the colour of tl
      if (methods.size() < 2 && method.name != "tl" &&
          curve_styles({std::string(method.name)})[0].color == curve_styles({"tl"})[0].color)
        methods.emplace_back(method.name);
    methods.emplace_back("og");
    REQUIRE(methods.size() == 3);
    for (const int count : {1, 4}) {
      NamedRuns runs;
      for (const std::string& method : methods) {
        const NamedRuns more = speeds_of(method, count);
        runs.insert(runs.end(), more.begin(), more.end());
      }
      HistoryPlot plot = falling(runs);
      plot.columns.push_back({"top", "top, m"});
      plot.panels = {{0, 1}};
      for (HistoryPlot::Curve& curve : plot.curves)
        for (auto& row : curve.rows) row.push_back(row[1]);
      CHECK(looks(script_of(plot)).size() == 2 * runs.size());
    }
  }

  TEST_CASE("with several methods, each keeps its hue, and its lines get lighter in their order") {
    const Texts methods{"tl", "og", "tl", "og", "tl", "og", "enog"};
    const std::vector<CurveStyle> styles = line_styles(methods);
    const auto channels = [](const CurveStyle& style) {
      std::array<int, 3> rgb{};
      for (std::size_t c = 0; c < 3; ++c) rgb[c] = std::stoi(style.color.substr(1 + 2 * c, 2), nullptr, 16);
      return rgb;
    };
    const auto order = [](const std::array<int, 3>& rgb) {  // of the channels, by brightness
      return std::array{rgb[0] <= rgb[1], rgb[1] <= rgb[2], rgb[0] <= rgb[2]};
    };
    for (std::size_t k = 0; k + 2 < 6; ++k) {
      const auto darker = channels(styles[k]), lighter = channels(styles[k + 2]);
      for (std::size_t c = 0; c < 3; ++c) CHECK(darker[c] <= lighter[c]);
      CHECK(darker != lighter);
      CHECK(styles[k].dash == styles[k + 2].dash);
      CHECK(order(darker) == order(channels(curve_styles({methods[k]})[0])));
    }
    CHECK(styles[6].line() == curve_styles({"enog"})[0].line());
  }

  TEST_CASE("a logarithmic axis has a note that names the columns with values that it cannot show") {
    HistoryPlot plot = falling({{"og", ""}, {"tl", ""}});
    plot.columns.push_back({"top", "top, m"});
    for (HistoryPlot::Curve& curve : plot.curves)
      for (auto& row : curve.rows) row.push_back(NAN);
    PlotLook look;
    look.log_x = look.log_y = true;
    CHECK(hidden_by_log(plot, look).empty());
    plot.curves[1].rows[1][2] = 0;
    CHECK(hidden_by_log(plot, look) == "values ≤ 0 are not drawn on logarithmic axes: top");
    plot.curves[0].rows[1][1] = plot.curves[0].rows[0][0] = -1;
    CHECK(hidden_by_log(plot, look) == "values ≤ 0 are not drawn on logarithmic axes: t, tip, top");
    look.log_x = false;
    CHECK(hidden_by_log(plot, look) == "values ≤ 0 are not drawn on logarithmic axes: tip, top");
    CHECK(hidden_by_log(plot, {}).empty());
  }

  TEST_CASE("a method has the same colour, dash and markers in every picture") {
    std::vector<std::string> all;
    for (const MethodInfo& method : methods()) all.emplace_back(method.name);
    std::set<std::string> looks;
    const std::vector<CurveStyle> together = curve_styles(all);
    for (std::size_t k = 0; k < all.size(); ++k) {
      const CurveStyle alone = curve_styles({all[k]})[0];
      CAPTURE(all[k]);
      CHECK(alone.line() == together[k].line());
      CHECK(alone.marker() == together[k].marker());
      looks.insert(alone.line());
    }
    CHECK(looks.size() == all.size());
    const auto twice = curve_styles({all[0], all[0], all[8]});
    CHECK(twice[2].line() == together[8].line());
    CHECK(twice[1].line() != twice[0].line());
  }

  TEST_CASE("the title names the method that a legend omits") {
    const std::string script = script_of(falling(speeds_of("oenog", 3)));
    CHECK(contains(script, "title 'speed=2'"));
    CHECK(contains(script, "set multiplot title 'A rod, oenog'"));
    CHECK(contains(script_of(falling({{"og", "speed=1"}, {"tl", "speed=1"}})), "title 'og, speed=1'"));
    CHECK(contains(script_of(falling({{"og", "speed=1"}})), "title 'og, speed=1'"));
    CHECK(contains(script_of(falling({{"og", ""}, {"og", "law=x"}})), "title 'og'"));
  }

  TEST_CASE("runs that differ in a constant of the method have it in their names") {
    const TemporaryFolder folder;
    const auto run = [&](const char* name, Texts words) {
      words.insert(words.begin(), {"--method", "tl", "--until", "1e-6", "--no-render"});
      REQUIRE(program(tiny_run(folder, name, words)).code == 0);
    };
    run("plain", {});
    run("wide", {"--set", "method.h=1.3"});
    REQUIRE(program({"plot", folder.str("plain"), folder.str("wide"), "--columns", "kinetic_energy", "--out",
                     folder.str("p.png")})
                .code == 0);
    const std::string script = text_of(folder / "p.gp");
    CHECK(contains(script, "title 'tl'"));
    CHECK(contains(script, "title 'tl, method.h=1.3'"));
  }

  TEST_CASE("a name too long for a legend keeps both ends") {
    const std::string shown =
        shortened("method.a_very_long_constant=0.5, another.very_long_constant=0.25, ν=0.499");
    CHECK(shown.starts_with("method.a_very_long"));
    CHECK(shown.ends_with("long_constant=0.25, ν=0.499"));
    CHECK(contains(shown, "…"));
    CHECK(shortened("short, ν=0.4") == "short, ν=0.4");
    std::string greek;
    for (int k = 0; k < 60; ++k) greek += "ν";
    CHECK(shortened(greek).size() == 2 * 45 + 3);  // 46 letters
  }

  TEST_CASE("runs of a method are ordered by rising swept values, in whatever order they are given") {
    const TemporaryFolder folder;
    StoredResults results;
    const auto add_run = [&](const std::string& method, const std::string& speed) {
      const std::string name = method + speed;
      fs::create_directory(folder / name);
      std::string record = record_with("\"speed\": " + speed);
      record.replace(record.find("\"tl\""), 4, "\"" + method + "\"");
      std::ofstream(folder / name / "run.json") << record;
      std::ofstream(folder / name / "history.csv") << "t,energy\n0,1\n1,2\n";
      results.runs.push_back(read_stored_run(folder.str(name)));
    };
    const auto names = [&] {
      Texts all;
      for (const auto& curve : make_history_plot(results, {{"energy", "energy"}}).curves)
        all.push_back(curve.name);
      return all;
    };
    for (const char* speed : {"10", "0.5", "2"}) add_run("tl", speed);
    CHECK(names() == Texts{"tl, speed=0.5", "tl, speed=2", "tl, speed=10"});
    add_run("og", "2"), add_run("og", "0.5");
    CHECK(names() == Texts{"tl, speed=0.5", "tl, speed=2", "tl, speed=10", "og, speed=0.5", "og, speed=2"});
  }

  TEST_CASE("a letter missing in every font is a box in PNG, and itself in SVG") {
    const std::string nowhere = "\xf4\x8f\xbf\xbd";  // private use
    CHECK(with_letters_of_fonts("été □ 2 µm") == "été □ 2 µm");
    CHECK(with_letters_of_fonts("a" + nowhere + nowhere + "b") == "a□□b");
    CHECK(with_letters_of_fonts("no UTF-8: \xe9\xff") == "no UTF-8: \xe9\xff");
    const TemporaryFolder folder;
    HistoryPlot plot = falling(speeds_of("oenog", 2));
    plot.title = "A rod " + nowhere;
    for (const std::string& name : {std::string("p.png"), std::string("p.svg"), "é" + nowhere + ".png"}) {
      CAPTURE(name);
      const PlotFiles files{folder / name};
      CHECK(draw_plot(files, history_script(plot, files), history_data(plot)) == 0);
      CHECK(std::filesystem::exists(files.picture));
      CHECK(contains(text_of(files.script()), name == "p.svg" ? "A rod " + nowhere : "A rod □"));
    }
  }

  TEST_CASE("an axis has room for its numbers, also for very small ones") {
    const double usual = left_of(script_of(falling(speeds_of("tl", 2))));
    CHECK(usual == Approx(109));
    CHECK(left_of(script_of(falling(speeds_of("tl", 2), -1.25e-12))) > usual + 5);  // "-1.2e-12"
    CHECK(left_of(script_of(falling(speeds_of("tl", 2), -1.25e-120))) > usual + 15);
  }

  TEST_CASE("a history in SVG has all names, in letters of 11 to 15 points") {
    const TemporaryFolder folder;
    const HistoryPlot plot = falling(speeds_of("oenog", 20));
    const PlotFiles files{folder / "p.svg"};
    REQUIRE(draw_plot(files, history_script(plot, files), history_data(plot)) == 0);
    const std::string picture = text_of(folder / "p.svg");
    for (int k = 1; k <= 20; ++k) CHECK(contains(picture, ">speed=" + std::to_string(k) + "<"));
    std::set<double> sizes;
    const std::string key = "font-size=\"";
    for (std::size_t at = picture.find(key); at != std::string::npos; at = picture.find(key, at + 1))
      sizes.insert(std::stod(picture.substr(at + key.size())));
    REQUIRE_FALSE(sizes.empty());
    CHECK(*sizes.rbegin() == Approx(20));                           // 15 points at 96 dpi
    CHECK(*sizes.begin() == Approx(11 * 96.0 / 72).epsilon(0.01));  // 11 points
  }

  TEST_CASE("a column with different units in two runs is refused, and one without a unit is drawn") {
    const TemporaryFolder folder;
    const Texts little{"--until", "1e-6", "--no-render", "--quiet", "--out"};
    const auto run = [&](Texts words, const char* name) {
      words.insert(words.end(), little.begin(), little.end());
      words.push_back(folder.str(name));
      REQUIRE(program(words).code == 0);
    };
    run({"run", write_tiny_scene(folder)}, "plane");
    run({"run", "cable-3d"}, "solid");
    const auto plot = [&](const char* column) {
      return program({"plot", folder.str("plane"), folder.str("solid"), "--columns", column, "--out",
                      folder.str("p.png")});
    };
    const Outcome energy = plot("kinetic_energy");
    CHECK(energy.code == 2);
    CHECK(contains(energy.err, "column 'kinetic_energy' is in J per m in"));
    CHECK(plot("pieces").code == 0);
  }

  TEST_CASE("values that a logarithmic axis cannot show are reported on stderr") {
    const TemporaryFolder folder;
    HistoryPlot plot = falling({{"og", ""}});
    plot.curves[0].rows[0][1] = -1;
    PlotLook look;
    for (const bool is_log : {false, true}) {
      look.log_y = is_log;
      std::ostringstream out, err;
      CHECK(draw_history(plot, {folder / "p.png"}, {out, err}, look) == 0);
      CHECK(err.str() == (is_log ? "taut: values ≤ 0 are not drawn on logarithmic axes: tip\n" : ""));
    }
  }

  TEST_CASE("a history with more lines than can be distinguished is drawn with a warning") {
    const TemporaryFolder folder;
    std::ofstream(folder / "run.json") << record_with("");
    std::ofstream(folder / "history.csv") << "t,energy\n0,1\n1,2\n";
    StoredResults results;
    results.title = "A rod";
    for (const std::size_t count : {24u, 25u}) {
      results.runs.assign(count, read_stored_run(folder.str("run.json")));
      std::ostringstream out, err;
      const HistoryPlot plot = make_history_plot(results, {{"energy", "energy"}}, {"t", "t"});
      CHECK(draw_history(plot, {folder / "p.png"}, {out, err}) == 0);
      CHECK((err.str() == "") == (count == 24));
      if (count == 25) CHECK(contains(err.str(), " has 25 lines; only 24 can be told apart"));
    }
  }
}
