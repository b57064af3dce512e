#include <filesystem>
#include <functional>

#include <doctest/doctest.h>

#include "cli/study/chart.hpp"
#include "cli/study/chart_drawing.hpp"
#include "cli/study/csv.hpp"
#include "cli/study/history_plot.hpp"
#include "cli/study/stored_results.hpp"
#include "engine/error.hpp"
#include "tests/support/results_file.hpp"
#include "tests/support/sweep_folder.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

const std::string one_row = "finished,tl,tl,0.4,10,stable,,0.32,2,4,\n";

const std::string record =
    R"({"taut": "0.1.0", "scene": "rod", "method": "tl", "status": "finished", "until": 1, "reached": 1,)"
    R"( "verdict": "stable", "since": {}, "measures": {"period": {"value": 2, "unit": "s", "error": null}}})";

std::string error_of(const std::function<void()>& reading) {
  try {
    reading();
  } catch (const taut::UsageError& error) {
    return error.what();
  }
  return "no error";
}

void write(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

std::string with(const std::string& was, const std::string& is) {
  std::string text = record;
  const std::size_t at = text.find(was);
  REQUIRE(at != std::string::npos);
  return text.replace(at, was.size(), is);
}

std::string deep(std::size_t levels) { return std::string(levels, '[') + std::string(levels, ']'); }

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a damaged or foreign run.json is refused with the file and the reason") {
    const TemporaryFolder folder;
    const std::string file = folder.str("run.json");
    write(file, record);
    CHECK(read_stored_run(file).value_of("period") == 2.0);
    struct Damage {
      std::string text, says;
    };
    for (const auto& [text, says] : {
             Damage{with("\"stable\"", "3"), "key 'verdict' is 3; it must be one of stable, "},
             {with("\"stable\"", "\"fine\""), "key 'verdict' is \"fine\"; it must be one of stable, "},
             {with("\"finished\"", "null, \"steps\": [1]"), "key 'steps' is [1]; it must be a number"},
             {with("\"finished\"", "\"over\""), "key 'status' is \"over\"; it must be one of running, "},
             {with("\"tl\"", "{}"), "key 'method' is {}; it must be a text"},
             {with("\"0.1.0\"", "1"), "key 'taut' is 1; it must be a text"},
             {with("\"since\": {}", "\"since\": {\"fractured\": \"a\"}"),
              "key 'since.fractured' is \"a\"; it must be a number"},
             {with("\"value\": 2", "\"value\": true"),
              "key 'measures.period.value' is true; it must be a number"},
             {with("{\"period\": {", "{\"period\": 3, \"p\": {"),
              "key 'measures.period' is 3; it must be an object"},
             {with("\"until\": 1", "\"until\": 1, \"until\": 2"), "has the key 'until' twice"},
             {with("\"until\": 1", "\"until\": 1e99999"), "is not JSON: "},
             {with("\"until\": 1", "\"until\": " + deep(70)), "is nested more than 64 levels deep"},
             {record.substr(0, 100), "is not JSON: "},
             {"{\"taut\": \"\xff\xfe\"}", "is not JSON: "},
             {"", "is not JSON: "},
             {"{}", "is not the run.json of a run of taut"},
             {"[]", "is not the run.json of a run of taut"},
         }) {
      const auto& text_now = text;
      CAPTURE(text_now);
      write(file, text);
      const std::string message = error_of([&] { read_stored_run(file); });
      CAPTURE(message);
      CHECK(message.starts_with("'" + file + "'"));
      CHECK(contains(message, says));
      CHECK(message.size() < 400);
    }
  }

  TEST_CASE("a run without jitter equals one with a jitter of 0") {
    const auto run = [](const std::string& jitter) {
      StoredRun one;
      one.status = "finished", one.record.method = "oenog";
      one.cells = {{"spacing", "0.002"}};
      if (!jitter.empty()) one.cells.emplace_back("set.jitter", jitter);
      return one;
    };
    CHECK(distinguishing_columns({run(""), run("0")}, "spacing").empty());
    const std::vector<std::string> told = distinguishing_columns({run(""), run("0"), run("0.05")}, "spacing");
    CHECK(told == std::vector<std::string>{"set.jitter"});
    CHECK(series_name(run(""), told) == "oenog, jitter=0");
    CHECK(series_name(run("0.05"), told) == "oenog, jitter=0.05");
  }

  TEST_CASE("a run without a result has the swept, the fixed or the only method of its sweep") {
    const TemporaryFolder folder;
    const auto last = [&](const std::string& rows) {
      return read_results({write_results(folder.path(), rows)}).runs.back().method();
    };
    CHECK(last("finished,,tl,0.4,10,stable,,0.3,2,4,\nto do,,,,,,,,,,\n") == "tl");
    CHECK(last("finished,tl,tl,0.4,10,stable,,0.3,2,4,\nto do,og,,,,,,,,,\n") == "og");
    // the default of the scene
    CHECK(last("finished,tl,tl,0.4,10,stable,,0.3,2,4,\nto do,,,,,,,,,,\n").empty());
    CHECK(StoredRun{.file = "", .cells = {{"fixed.method", "og"}}}.method() == "og");
  }

  TEST_CASE("a run.json nested too deep is refused") {
    const TemporaryFolder folder;
    write(folder / "run.json", with("\"until\": 1", "\"until\": " + deep(100000)));
    CHECK(contains(error_of([&] { read_stored_run(folder.str("run.json")); }), "64 levels deep"));
  }

  TEST_CASE("a damaged results.json is refused with the file and the reason") {
    const TemporaryFolder folder;
    const std::string table = write_results(folder.path(), one_row);
    const std::string file = folder.str("results.json");
    struct Damage {
      const char *text, *says;
    };
    for (const auto& [text, says] :
         {Damage{R"({"title": 3})", "key 'title' is 3; it must be a text"},
          {R"({"title": ["a"]})", "key 'title' is [\"a\"]; it must be a text"},
          {R"({"swept": 3})", "key 'swept' is 3; it must be an array"},
          {R"({"swept": [{"name": "v0"}, null]})", "key 'swept.1' is null; it must be an object"},
          {R"({"swept": [{"name": 1}]})", "key 'swept.0.name' is 1; it must be a text"},
          {R"({"swept": [{"unit": {}}]})", "key 'swept.0.unit' is {}; it must be a text"},
          {R"({"fixed": [1]})", "key 'fixed' is [1]; it must be an object"},
          {R"({"fixed": {"until": []}})", "key 'fixed.until' is []; it must be a number or a text"},
          {R"({"title": "a)", "is not JSON: "},
          {R"(3)", "contains 3; it must be an object"}}) {
      const auto& text_now = text;
      CAPTURE(text_now);
      write(file, text);
      const std::string message = error_of([&] { read_results({table}); });
      CAPTURE(message);
      CHECK(message.starts_with("'" + file + "'"));
      CHECK(contains(message, says));
    }
    write(file, R"({"title": "T", "swept": [{"name": "v0", "unit": "c0", "help": ""}], "fixed": {"a": 1}})");
    const StoredResults results = read_results({table});
    CHECK(results.title == "T");
    CHECK(results.label("v0") == "v0, c0");
    CHECK(results.fixed == StoredSettings{{"a", "1"}});
    fs::remove(file);
    CHECK(read_results({table}).title == "rod");
  }

  TEST_CASE("runs of sweeps with different fixed settings are distinguished") {
    const TemporaryFolder folder;
    const auto sweep = [&](const std::string& name, const std::string& error, const std::string& fixed) {
      const std::string table =
          write_results(folder / name, "finished,tl,tl,0.4,10,stable,," + error + ",2,1,\n");
      write(folder / name / "results.json", R"({"title": "", "swept": [], "fixed": {)" + fixed + "}}");
      return table;
    };
    const std::string plain = sweep("plain", "0.01", R"("until": 0.3)"),
                      law = sweep("law", "0.5", R"("until": 0.3, "law": "mooney-rivlin", "method.h": 1.2)"),
                      moved = sweep("moved", "0.7", R"("jitter": 0.1, "until": 0.3)");
    const StoredResults both = read_results({law, plain, moved});
    CHECK(both.fixed == StoredSettings{{"until", "0.3"}});
    const Chart chart = make_chart(both, {});
    REQUIRE(chart.series.size() == 3);
    CHECK(chart.series[0].name == "tl, law=mooney-rivlin, jitter=0");
    CHECK(chart.series[1].name == "tl, jitter=0");
    CHECK(chart.series[2].name == "tl, jitter=0.1");
    CHECK(chart.fixed == std::vector<std::string>{"until = 0.3"});
    CHECK(read_results({law}).fixed.size() == 3);
    CHECK(make_chart(read_results({law}), {}).series[0].name == "tl");
    fs::remove(folder / "plain/results.json");
    CHECK(read_results({law, plain}).fixed.empty());
  }

  TEST_CASE("a CSV table with more than 256 MiB or 10000 columns is refused") {
    const TemporaryFolder folder;
    write(folder / "a.csv", "");
    fs::resize_file(folder / "a.csv", std::uintmax_t{300} << 20);  // sparse
    CHECK(
        contains(error_of([&] { read_csv(folder / "a.csv"); }), "has 300 MiB; at most 256 MiB are allowed"));
    std::string wide = "t";
    for (int k = 0; k < 10000; ++k) wide += ",c";
    CHECK(contains(error_of([&] { parse_csv(wide + "\n", "a.csv"); }), "a.csv:1: more than 10000 columns"));
    CHECK(contains(error_of([&] { parse_csv("t\n" + wide + "\n", "a.csv"); }), "a.csv:2: more than 10000"));
  }

  TEST_CASE("a chart of the smallest and greatest numbers has finite axes") {
    const TemporaryFolder folder;
    const PlotFiles files{folder.str("a.svg")};
    for (const auto& [error, cost] : std::initializer_list<std::pair<const char*, const char*>>{
             {"1e308", "1e308"}, {"5e-324", "5e-324"}, {"0", "0"}, {"-1", "-1"}}) {
      const auto& error_now = error;
      CAPTURE(error_now);
      const std::string row = std::string(",stable,,") + error + ",2," + cost + ",\n";
      const StoredResults results = read_results(
          {write_results(folder.path(), "finished,tl,tl,0.4,10" + row + "finished,tl,tl,0.2,10" + row)});
      const std::string script = chart_script(make_chart(results, {}), files);
      CHECK_FALSE(contains(script, "inf"));
      CHECK_FALSE(contains(script, "nan"));
      CHECK(script.size() < 20000);
    }
  }

  TEST_CASE("a history without a number to draw is refused with file and column") {
    const TemporaryFolder folder;
    write(folder / "run.json", record);
    write(folder / "history.csv", "t,energy\n0,inf\n1,nan\n2,-1e308\nx,3\n");
    StoredResults results;
    results.runs.push_back(read_stored_run(folder.str("run.json")));
    const auto plot = [&] { make_history_plot(results, {{"energy", "energy"}}, {"t", "t"}); };
    CHECK(contains(error_of(plot), "history.csv: no row has numbers in both columns 't' and 'energy'"));
    write(folder / "history.csv", "t,energy\n0,inf\n1,3\n");
    CHECK_NOTHROW(plot());
  }

  TEST_CASE("a CSV table is read back as it was written") {
    const std::string odd = "a \"b\", c\nd";
    const auto table = taut::cli::parse_csv("x,y\r\n" + taut::cli::csv_cell(odd) + ",\n,2", "t.csv");
    CHECK(table.columns == Texts{"x", "y"});
    REQUIRE(table.rows.size() == 2);
    CHECK(table.rows[0] == Texts{odd, ""});
    CHECK(table.rows[1] == Texts{"", "2"});
    CHECK_THROWS_AS(taut::cli::parse_csv("x,y\n\"a\"b,c\n", "t.csv"), taut::UsageError);
  }

  TEST_CASE("a note names the contact law of a chart, or says that the laws differ") {
    const TemporaryFolder folder;
    const auto script_of = [&](const std::string& law) {
      const std::string file = write_results(folder / law,
                                             "finished,tl,tl,0.4,10,stable,,0.3,2,4,,penalty\n"
                                             "finished,og,og,0.4,10,stable,,0.2,2,8,," +
                                                 law + "\n",
                                             "rod", "none,contact");
      REQUIRE(call({"chart", file, "--out", folder.str("c.svg")}).code == 0);
      return text_of(folder / "c.gp");
    };
    CHECK(contains(script_of("penalty"), "all with penalty contact"));
    CHECK(contains(script_of("sph"), "; contact laws differ"));
  }

  TEST_CASE("the name of a series omits the default contact law of its method") {
    const TemporaryFolder folder;
    const std::string file = write_results(folder.path(),
                                           "finished,tl,tl,0.4,10,stable,,0.3,2,4,,surface\n"
                                           "finished,tl,tl,0.4,10,stable,,0.2,2,8,penalty,penalty\n"
                                           "finished,og,og,0.4,10,stable,,0.2,2,8,,sph\n",
                                           "rod", "contact,contact");
    Texts names;
    for (const ChartSeries& series : make_chart(read_results({file}), {}).series)
      names.push_back(series.name);
    CHECK(names == Texts{"tl", "tl, contact=penalty", "og"});
  }
}
