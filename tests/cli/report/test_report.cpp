#include <doctest/doctest.h>

#include "cli/report/difference_data.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/results_file.hpp"
#include "tests/support/sweep_folder.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

nlohmann::ordered_json assigned(const std::string& script, const std::string& name) {
  const std::string before = "globalThis." + name + " = ";
  const std::size_t begin = script.find(before);
  REQUIRE(begin != std::string::npos);
  const std::size_t value = begin + before.size();
  return nlohmann::ordered_json::parse(script.substr(value, script.find(";\n", value) - value));
}

nlohmann::ordered_json report_of(const fs::path& page) {
  return assigned(text_of(page / "data.js"), "taut_report");
}

nlohmann::ordered_json run_of(const fs::path& page, int run) {
  const std::string number = std::to_string(run);
  return assigned(text_of(page / ("runs/" + number + ".js")), "taut_runs[" + number + "]");
}

std::string run_with_title(const TemporaryFolder& folder, const std::string& title) {
  write_tiny_scene(folder);
  std::string text = text_of(folder / "discs.toml");
  text.replace(text.find("Two discs"), 9, title);
  text.replace(
      text.find("[render]"), 0,
      "[[measure]]\nname = \"gap_rmse\"\nof = \"rmse\"\nprobe = \"gap\"\nunit = \"m\"\n"
      "[[reference]]\nlaw = \"neo-hookean\"\nname = \"line\"\nsolutions = { gap_rmse = \"0.002 - 4*t\" }\n");
  std::ofstream(folder / "titled.toml") << text;
  const Outcome outcome = call({"run", folder.str("titled.toml"), "--method", "oenog", "--out",
                                folder.str("run"), "--threads", "1", "--quiet"});
  REQUIRE(outcome.code == 0);
  return folder.str("run");
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("report: the page of a run has its frames, history, reference curve and record") {
    const TemporaryFolder folder;
    const std::string run = run_with_title(folder, "Two discs");
    const Outcome outcome = call({"report", run});
    REQUIRE(outcome.code == 0);
    const fs::path page = fs::path(run) / "report";
    CHECK(outcome.out == "page  " + (page / "index.html").string() + "\n");
    for (const char* file : {"index.html", "taut.css", "taut.js", "chart.js"}) CHECK(fs::exists(page / file));
    CHECK(report_of(page)["kind"] == "run");
    CHECK(report_of(page)["running"] == false);
    const auto data = run_of(page, 0);
    CHECK(data["title"] == "Two discs");
    CHECK(data["record"] == json_of(fs::path(run) / "run.json"));
    CHECK(data["scene"] == text_of(fs::path(run) / "scene.toml"));
    REQUIRE(data["frames"].size() == 5);
    CHECK(data["frames"][3]["src"] == "../frames/frame_00003.png");
    CHECK(data["frames"][3]["t"] == 0.0015);
    const std::vector<std::string> lines = lines_of(fs::path(run) / "history.csv");
    const auto& columns = data["history"]["columns"];
    CHECK(data["history"]["every"] == 1);
    CHECK(columns[0]["name"] == "t");
    CHECK(columns[0]["unit"] == "s");
    CHECK(columns[0]["values"].size() + 1 == lines.size());
    std::string row;
    for (const auto& column : columns) row += (row.empty() ? "" : ",") + column["values"][7].dump();
    CHECK(nlohmann::json::parse("[" + row + "]") == nlohmann::json::parse("[" + lines[8] + "]"));
    REQUIRE(data["references"].size() == 1);
    CHECK(data["references"][0]["column"] == "gap");
    CHECK(data["references"][0]["name"] == "line");
    CHECK(data["references"][0]["t"].back() == 0.002);
    CHECK(data["references"][0]["values"].back().get<double>() == relative(-0.006));
  }

  TEST_CASE("report: a title cannot end a script of the page, and an embedded page refers to no other file") {
    const TemporaryFolder folder;
    const std::string title = "</script><script>alert(1)</script><!-- & \u2028";
    const std::string run = run_with_title(folder, title);
    REQUIRE(call({"report", run}).code == 0);
    CHECK_FALSE(contains(text_of(folder / "run/report/runs/0.js"), "<"));
    CHECK(run_of(folder / "run/report", 0)["title"] == title);
    REQUIRE(call({"report", run, "--embed"}).code == 0);
    const std::string page = text_of(folder / "run/report.html");
    CHECK_FALSE(contains(page, "<script>alert(1)"));
    CHECK(assigned(page, "taut_runs[0]")["title"] == title);
    CHECK(assigned(page, "taut_runs[0]")["frames"][0]["src"].get<std::string>().starts_with(
        "data:image/webp;base64,UklGR"));  // "RIF" of RIFF
    for (const char* address : {"src=\"", "href=\"taut", "http://", "https://"}) {
      CAPTURE(address);
      CHECK_FALSE(contains(page.substr(0, page.find("<style>")), address));
    }
  }

  TEST_CASE("report: an older page is replaced, and other folders and files are refused") {
    const TemporaryFolder folder;
    const std::string run = run_with_title(folder, "Two discs"), out = folder.str("page");
    REQUIRE(call({"report", run, run, "--out", out}).code == 0);
    CHECK(fs::exists(folder / "page/runs/1.js"));
    CHECK(report_of(folder / "page")["kind"] == "runs");
    REQUIRE(call({"report", run, "--out", out}).code == 0);  // older pages may have had more runs
    CHECK_FALSE(fs::exists(folder / "page/runs/1.js"));
    const Outcome other = call({"report", run, "--out", run});
    CHECK(other.code == 2);
    CHECK(contains(other.err, "contains files that are not from `taut report`"));
    const Outcome file = call({"report", run, "--embed", "--out", run + "/run.json"});
    CHECK(file.code == 2);
    CHECK(contains(file.err, "is not a page of `taut report`"));
    CHECK(json_of(fs::path(run) / "run.json")["status"] == "finished");
    std::ofstream(folder / "plain") << "text";
    CHECK(call({"report", run, "--out", folder.str("plain/page")}).code == 4);
  }

  TEST_CASE("report: invalid paths and options are refused with the reason") {
    const TemporaryFolder folder;
    const std::string run = run_with_title(folder, "Two discs");
    REQUIRE(call(tiny_sweep(folder, "sweep", {"--grid", "speed=1,2"})).code == 0);
    const auto refused = [](const std::vector<std::string>& words, const std::string& part) {
      const Outcome outcome = call(words);
      CAPTURE(outcome.err);
      CHECK(outcome.code == 2);
      CHECK(contains(outcome.err, part));
    };
    refused({"report", folder.str("none")}, "neither a run folder nor the folder of a sweep");
    refused({"report", run, folder.str("sweep")}, "runs and sweeps are given");
    refused({"report", run, run, "--baseline", run}, "--baseline compares one folder");
    refused({"report", run, "--baseline", folder.str("none")}, "there are no pictures (PNG)");
    CHECK_FALSE(fs::exists(fs::path(run) / "report"));
    refused({"report", run, "--watch", "--embed"}, "give --watch or --embed");
    refused({"report", run, "--max-difference", "2"}, "--max-difference needs --baseline");
    std::ofstream(fs::path(run) / "run.json") << "{";
    refused({"report", run}, "run.json");
  }

  TEST_CASE("report: the page of a sweep has a row and a script with data for each run") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_sweep(folder, "sweep", {"--grid", "speed=1,2", "--grid", "method=enog,og"})).code == 0);
    const Outcome outcome = call({"report", folder.str("sweep"), "--json"});
    REQUIRE(outcome.code == 0);
    const auto answer = nlohmann::json::parse(outcome.out);
    CHECK(answer["answer"] == "report");
    CHECK(answer["kind"] == "sweep");
    CHECK(answer["runs"] == 4);
    CHECK(answer["page"] == folder.str("sweep/report/index.html"));
    const auto report = report_of(folder / "sweep/report");
    CHECK(report["rows"].size() == 4);
    CHECK(report["swept"][0]["label"] == "speed, m/s");
    CHECK(report["styles"].size() == 2);
    CHECK(report["scripts"][3] == "runs/3.js");
    const auto& columns = report["columns"];
    const auto at = std::find(columns.begin(), columns.end(), "set.speed") - columns.begin();
    CHECK(report["rows"][2][static_cast<std::size_t>(at)] == 2);
    CHECK(run_of(folder / "sweep/report", 3)["record"]["method"] == "og");
    CHECK(run_of(folder / "sweep/report", 0)["history"]["columns"][0]["values"].size() <= 252);
  }

  TEST_CASE("report: runs without a result have the method of their sweep") {
    const TemporaryFolder folder;
    write_results(folder / "a", "finished,,tl,0.4,10,stable,,0.3,2,4,3\nto do,,,,,,,,,,5\n", "rod", "speed");
    REQUIRE(call({"report", folder.str("a")}).code == 0);
    const auto report = report_of(folder / "a/report");
    const auto& columns = report["columns"];
    const auto at = std::find(columns.begin(), columns.end(), "method") - columns.begin();
    CHECK(report["rows"][1][static_cast<std::size_t>(at)] == "tl");
    CHECK(report["styles"].size() == 1);
  }

  TEST_CASE(
      "report: saved particles of a run in 3D are stored beside the page, with the colours and the cut of the run") {
    const TemporaryFolder folder;
    std::ofstream(folder / "ball.toml") << R"(
title = "A ball"
dim = 3
spacing = 0.004
until = 0.001
method = "oenog"
[material.rubber]
density = 1000
youngs_modulus = 1e6
poisson_ratio = 0.4
[[body]]
name = "ball"
shape = { type = "box", low = [0, 0, 0], high = [0.016, 0.008, 0.008] }
material = "rubber"
velocity = [1, 0, 0]
[render]
color = "displacement_x"
colormap = "gray"
range = [0, 0.002]
cut = "x > 0.008"
size = [160, 120]
frames = 2
)";
    const Outcome made = call({"run", folder.str("ball.toml"), "--out", folder.str("run"), "--threads", "1",
                               "--save-particles", "--quiet"});
    CAPTURE(made.err);
    REQUIRE(made.code == 0);
    REQUIRE(call({"report", folder.str("run")}).code == 0);
    const fs::path page = folder / "run/report";
    CHECK(report_of(page)["particle_scripts"][0] == "runs/0-particles.js");
    const auto data = assigned(text_of(page / "runs/0-particles.js"), "taut_particles[0]");
    CHECK(data["times"] == nlohmann::json::parse("[0.0, 0.0005, 0.001]"));
    CHECK(data["particles"] == 8);
    CHECK(data["key"]["high"] == 0.002);
    CHECK(data["low"][0].get<double>() == relative(0.002));
    CHECK(data["high"][0].get<double>() == relative(0.007, 1e-6));
    REQUIRE(data["data"].size() == 3);
    // base64 of 8 particles × (3 × 2 + 3) bytes
    for (const auto& each : data["data"]) CHECK(each.get<std::string>().size() == 96);
    const std::string first = data["data"][0], last = data["data"][2], color = first.substr(64, 4);
    for (std::size_t k = 64; k < 96; k += 4) CHECK(first.substr(k, 4) == color);
    CHECK(last.substr(64, 4) != color);
    CHECK(last.substr(0, 64) != first.substr(0, 64));
    CHECK(data["key"]["colors"][0] != data["key"]["colors"].back());
  }

  TEST_CASE("report: pictures are compared with a baseline, the most different first") {
    const TemporaryFolder folder;
    const std::string run = run_with_title(folder, "Two discs");
    fs::copy(folder / "run/frames", folder / "good # 1", fs::copy_options::recursive);
    fs::copy_file(folder / "run/frames/frame_00004.png", folder / "good # 1/frame_00002.png",
                  fs::copy_options::overwrite_existing);
    fs::remove(folder / "good # 1/frame_00001.png");
    REQUIRE(call({"report", run, "--baseline", folder.str("good # 1")}).code == 0);
    const auto report = report_of(fs::path(run) / "report");
    CHECK(report["alike"] == false);
    CHECK(report["different"] == 1);
    REQUIRE(report["pictures"].size() == 4);
    CHECK(report["pictures"][0]["name"] == "frame_00002.png");
    CHECK(report["pictures"][0]["expected"] == "../../good%20%23%201/frame_00002.png");
    CHECK(report["pictures"][0]["difference"] == "difference/frame_00002.png");
    CHECK(report["pictures"][1]["alike"] == true);
    CHECK(report["only_in_got"][0]["name"] == "frame_00001.png");
    CHECK(fs::exists(folder / "run/report/difference/frame_00002.png"));
    CHECK(call({"report", run, "--baseline", folder.str("good # 1"), "--max-difference", "101"}).code == 0);
    CHECK(report_of(fs::path(run) / "report")["different"] == 0);
  }

  TEST_CASE("report: a comparison that was interrupted is repeated") {
    const TemporaryFolder folder;
    const std::string run = run_with_title(folder, "Two discs");
    const fs::path good = folder / "good", page = fs::path(run) / "report";
    fs::copy(folder / "run/frames", good, fs::copy_options::recursive);
    fs::copy_file(folder / "run/frames/frame_00004.png", good / "frame_00002.png",
                  fs::copy_options::overwrite_existing);
    difference_data({good, run, {}}, page / "difference",
                    Links(page, false));  // ends before the page is written
    REQUIRE(fs::exists(page / "difference/frame_00002.png"));
    CHECK(contains(text_of(page / "index.html"), "unfinished"));
    const Outcome again = call({"report", run, "--baseline", good.string()});
    CAPTURE(again.err);
    REQUIRE(again.code == 0);
    CHECK(contains(text_of(page / "index.html"), "taut.js"));
  }

  TEST_CASE("report: a suite of snapshots has an index with the comparison of each entry") {
    const TemporaryFolder folder;
    write_tiny_scene(folder);
    const auto snapshot = [&](const std::string& speed, const Texts& more) {
      std::ofstream(folder / "suite.toml")
          << "title = 'Discs'\nwarn = 1\nset = { until = 1e-3, speed = " + speed +
                 " }\nrender.frames = 1\n"
                 "[[entry]]\nname = 'discs'\nscene = 'discs.toml'\n"
                 "[[entry]]\nname = 'faster'\ndiffers_from = 'discs'\nset.speed = 4\n";
      Texts words{"snapshot", "suite.toml", "--quiet", "--jobs", "1"};
      words.insert(words.end(), more.begin(), more.end());
      return program(words, folder.path()).code;
    };
    REQUIRE(snapshot("2", {"--update"}) == 0);
    REQUIRE(snapshot("3", {}) == 1);
    const fs::path out = folder / "out/snapshot-suite";
    const Outcome page = call({"report", out.string(), "--json"});
    CAPTURE(page.err);
    REQUIRE(page.code == 0);
    CHECK(nlohmann::json::parse(page.out)["kind"] == "suite");
    const auto report = report_of(out / "report");
    CHECK(report["title"] == "Discs");
    REQUIRE(report["entries"].size() == 2);
    const auto& entry = report["entries"][0];
    CHECK(entry["name"] == "discs");
    CHECK(entry["comparison"]["different"] == 2);
    CHECK(entry["comparison"]["limits"]["warn"] == 1);
    CHECK(entry["comparison"]["pictures"][0]["expected"].get<std::string>().starts_with(
        "../../../suite/discs/"));
    CHECK(fs::exists(out / "report/difference/discs/frame_00000.png"));
    CHECK(report["entries"][1]["differs_from"] == "discs");
    fs::remove_all(folder / "suite/discs");
    REQUIRE(call({"report", out.string()}).code == 0);
    CHECK(contains(report_of(out / "report")["entries"][0]["problem"], "there are no pictures"));
    const Outcome two = call({"report", out.string(), out.string()});
    CHECK(contains(two.err, "a page shows one suite"));
  }
}
