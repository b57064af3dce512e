#include <map>

#include <doctest/doctest.h>

#include "engine/error.hpp"
#include "tests/support/sweep_folder.hpp"

using namespace taut::cli;
using namespace taut::test;

TEST_SUITE("cli") {
  TEST_CASE("a sweep runs and emits scripts without /proc") {
    const TemporaryFolder folder;
    const std::string without = "unshare -rm sh -c 'mount -t tmpfs none /proc && exec \"$@\"' sh ";
    if (std::system((without + "true 2>/dev/null").c_str()) != 0) {
      MESSAGE("skipped: no file system can be mounted here");
      return;
    }
    const auto run = [&](const Texts& more) {
      std::string command = without + TAUT_BINARY_DIR "/taut";
      for (const std::string& word : tiny_sweep(folder, "out", more)) command += " " + shell_word(word);
      return std::system((command + " >" + folder.str("said") + " 2>&1").c_str());
    };
    const Texts grid{"--grid", "speed=1,2", "--until", "1e-4"};
    CHECK_MESSAGE(run(grid) == 0, text_of(folder / "said"));
    CHECK(statuses(folder / "out") == Texts{"finished", "finished"});
    CHECK_MESSAGE(run({"--grid", "speed=1,2", "--emit", "slurm"}) == 0, text_of(folder / "said"));
    CHECK(contains(text_of(folder / "out/sweep.slurm"), "exec " TAUT_BINARY_DIR "/taut sweep "));
  }

  TEST_CASE("a sweep does not repeat a run that was drawn later by `render`") {
    const TemporaryFolder folder;
    const Texts grid{"--grid", "speed=1,2", "--set", "until=1e-4", "--save-particles"};
    REQUIRE(program(tiny_sweep(folder, "out", grid)).code == 0);
    const auto before = ends(folder / "out");
    REQUIRE(program({"render", folder.str("out/speed=1"), "--color", "pressure", "--quiet"}).code == 0);
    const Outcome again = program(tiny_sweep(folder, "out", grid));
    REQUIRE(again.code == 0);
    CHECK_FALSE(contains(again.err, "replaced"));
    CHECK(ends(folder / "out") == before);
    Texts other = grid;
    other.insert(other.end(), {"--set", "cfl=0.3"});
    const Outcome anew = program(tiny_sweep(folder, "out", other));
    REQUIRE(anew.code == 0);
    CHECK(contains(anew.err, "2 finished runs in '" + folder.str("out") + "' have other settings"));
    CHECK(ends(folder / "out") != before);
  }

  TEST_CASE("runs of an earlier grid remain with a warning, and are not in the results") {
    const TemporaryFolder folder;
    const Texts wide{"--grid", "speed=1,2,3", "--set", "until=1e-5"};
    REQUIRE(program(tiny_sweep(folder, "out", wide)).code == 0);
    const Texts narrow{"--grid", "speed=2", "--set", "until=1e-5"};
    const Outcome outcome = program(tiny_sweep(folder, "out", narrow));
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.err, "2 runs of another grid"));
    CHECK(contains(outcome.err, "speed=1, speed=3"));
    CHECK(json_of(folder / "out/results.json")["runs"].size() == 1);
  }

  TEST_CASE("a sweep creates a folder for each run, and rows in the order of the grid") {
    const TemporaryFolder folder;
    // the second of the three values takes longest
    const Outcome outcome = program(tiny_sweep(
        folder, "out", {"--grid", "until=0.001,0.004,0.002", "--grid", "method=og,enog", "--jobs", "3"}));
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.err.empty());
    CHECK(contains(outcome.out, folder.str("out/results.csv")));
    CHECK(contains(outcome.out, "touch_time, s"));
    const auto json = json_of(folder / "out/results.json");
    CHECK(json["scene"] == "discs");
    CHECK(json["swept"][0]["name"] == "until");
    REQUIRE(json["runs"].size() == 6);
    for (int k = 0; k < 6; ++k) {
      const auto& run = json["runs"][static_cast<std::size_t>(k)];
      CHECK(run["index"] == k);
      CHECK(run["set"]["method"] == (k % 2 == 0 ? "og" : "enog"));
      CHECK(run["set"]["until"] == (k < 2 ? 0.001 : k < 4 ? 0.004 : 0.002));
      CHECK(run["until"] == run["set"]["until"]);
      CHECK(run["threads"] == 1);
      const fs::path place = folder / ("out/" + run["folder"].get<std::string>());
      const auto record = json_of(place / "run.json");
      for (const char* key : {"status", "steps", "measures", "indicators", "seconds", "verdict"})
        CHECK(run[key] == record[key]);
      CHECK(files_in(place / "frames") == 0);
    }
    const Texts lines = lines_of(folder / "out/results.csv");
    REQUIRE(lines.size() == 7);
    CHECK(lines[0].starts_with("index,set.until,set.method,status,message,folder,scene,method,"));
    CHECK(contains(lines[0], ",measures.touch_time.value,measures.touch_time.unit,"));
    CHECK(lines[4].starts_with("3,0.004,enog,finished,,until=0.004_method=enog,discs,enog,"));
  }

  TEST_CASE("results are the same with 1 and 4 parallel runs") {
    const TemporaryFolder folder;
    const Texts grid{"--grid", "speed=1:3:1", "--grid", "method=og,enog", "--jobs"};
    for (const std::string jobs : {"1", "4"}) {
      Texts more = grid;
      more.push_back(jobs);
      REQUIRE(program(tiny_sweep(folder, jobs, more)).code == 0);
    }
    CHECK(results(folder / "1") == results(folder / "4"));
  }

  TEST_CASE(
      "a finished run is kept unless its settings have changed, an output is missing or --force is given") {
    const TemporaryFolder folder;
    const auto sweep = [&](Texts more) {
      more.insert(more.begin(), {"--grid", "speed=1,2"});
      const Outcome outcome = program(tiny_sweep(folder, "out", more));
      CAPTURE(outcome.err);
      REQUIRE(outcome.code == 0);
      return ends(folder / "out");
    };
    const auto first = sweep({});
    REQUIRE(first.size() == 2);
    CHECK(sweep({}) == first);
    const auto drawn = sweep({"--frames", "2"});
    CHECK(drawn.at("speed=1") > first.at("speed=1"));
    CHECK(files_in(folder / "out/speed=2/frames") == 3);
    CHECK(sweep({"--frames", "2"}) == drawn);
    fs::remove(folder / "out/speed=2/frames/frame_00002.png");
    const auto drawn_again = sweep({"--frames", "2"});
    CHECK(drawn_again.at("speed=1") == drawn.at("speed=1"));
    CHECK(drawn_again.at("speed=2") > drawn.at("speed=2"));
    CHECK(sweep({"--frames", "2", "--render", "--save-particles"}).at("speed=1") > drawn.at("speed=1"));
    CHECK(fs::exists(folder / "out/speed=1/particles/particles.pvd"));
    const auto other = sweep({"--set", "pull=1"});
    CHECK(other.at("speed=1") > drawn.at("speed=1"));
    CHECK(sweep({"--set", "pull=1", "--force"}).at("speed=2") > other.at("speed=2"));
  }

  TEST_CASE("a run without its history, or a diverged run without the requested frames, is repeated") {
    const TemporaryFolder folder;
    const auto sweep = [&](const Texts& more) {
      Texts words{"--grid", "speed=1", "--set", "cfl=2", "--set", "method.zeta=50"};
      words.insert(words.end(), more.begin(), more.end());
      const Outcome outcome = program(tiny_sweep(folder, "out", words));
      CAPTURE(outcome.err);
      REQUIRE(outcome.code == 0);
      return fs::last_write_time(folder / "out/speed=1/run.json");
    };
    const auto first = sweep({});
    REQUIRE(json_of(folder / "out/results.json")["runs"][0]["verdict"] == "diverged");
    CHECK(sweep({}) == first);
    fs::remove(folder / "out/speed=1/history.csv");
    const auto second = sweep({});
    CHECK(second > first);
    CHECK(fs::exists(folder / "out/speed=1/history.csv"));
    const auto drawn = sweep({"--render"});
    CHECK(drawn > second);
    CHECK(files_in(folder / "out/speed=1/frames") > 0);
    CHECK(sweep({"--render"}) == drawn);
  }

  TEST_CASE("spacings of a grid that are rounded to the same value give a warning") {
    const TemporaryFolder folder;
    const Outcome outcome =
        program(tiny_sweep(folder, "out", {"--grid", "spacing=0.002,0.00201,0.004", "--set", "until=1e-5"}));
    CHECK(outcome.code == 0);
    CHECK(contains(
        outcome.err,
        "the runs spacing=0.002 and spacing=0.00201 are the same: both spacings are rounded to 0.002 m"));
    CHECK_FALSE(contains(outcome.err, "0.004"));
    const Outcome rings = program({"sweep", "colliding-rings", "--grid", "spacing=0.002,0.0021", "--set",
                                   "until=1e-6", "--out", folder.str("rings"), "--quiet"});
    CHECK(contains(rings.err, "the runs spacing=0.002 and spacing=0.0021 are the same"));
  }

  TEST_CASE("a sweep moved with its scene and references has nothing to do") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "here/tables");
    std::ofstream(folder / "here/tables/gap.csv") << "t,gap\n0,0.002\n0.002,0\n";
    std::ofstream(folder / "here/discs.toml")
        << text_of(write_tiny_scene(folder)) << reference_of_gap("tables/gap.csv");
    const auto sweep = [&](const std::string& place) {
      const Outcome outcome = program({"sweep", folder.str(place + "/discs.toml"), "--grid", "speed=1,2",
                                       "--out", folder.str(place + "/out"), "--quiet"});
      CAPTURE(outcome.err);
      REQUIRE(outcome.code == 0);
      return ends(folder / (place + "/out"));
    };
    const auto before = sweep("here");
    CHECK(before.size() == 2);
    fs::rename(folder / "here", folder / "there");
    CHECK(sweep("there") == before);
    const Texts again{"run", folder.str("there/out/speed=1/scene.toml"), "--out", folder.str("again"),
                      "--quiet"};
    CHECK(call(again).code == 0);
  }

  TEST_CASE("a larger grid in the same folder runs only the new runs") {
    const TemporaryFolder folder;
    REQUIRE(program(tiny_sweep(folder, "out", {"--grid", "speed=1,3"})).code == 0);
    const auto before = ends(folder / "out");
    const Outcome list = program(tiny_sweep(folder, "out", {"--grid", "speed=1:3:1", "--list"}));
    CHECK(contains(list.out, "1    speed=2  speed=2  to do\n"));
    CHECK(contains(list.out, "2    speed=3  speed=3  done\n"));
    CHECK(contains(list.out, "2 of 3 runs are done"));
    REQUIRE(program(tiny_sweep(folder, "out", {"--grid", "speed=1:3:1"})).code == 0);
    CHECK(statuses(folder / "out") == Texts{"finished", "finished", "finished"});
    CHECK(ends(folder / "out").at("speed=3") == before.at("speed=3"));
  }

  TEST_CASE("a run that diverges or fractures is a row, and the sweep continues") {
    const TemporaryFolder folder;
    const Texts sweep =
        tiny_sweep(folder, "out",
                   {"--grid", "pull=0,8000", "--grid", "cfl=0.5,20", "--method", "og", "--until", "0.02"});
    const Outcome outcome = program(sweep);
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    const auto runs = json_of(folder / "out/results.json")["runs"];
    CHECK(runs[0]["verdict"] == "hourglass");
    CHECK(runs[1]["verdict"] == "diverged");
    CHECK(runs[1]["status"] == "failed");
    CHECK(runs[1]["since"]["diverged"].get<double>() > 0);
    CHECK(runs[2]["verdict"] == "fractured");
    CHECK(contains(program(sweep).out, "diverged since"));
    CHECK(contains(program({sweep.begin(), sweep.end()}).out, "fractured since"));
    Texts strict = sweep;
    strict.insert(strict.end(), {"--fail-on", "diverged"});
    CHECK(program(strict).code == 3);
    const fs::path diverged = folder / "out/pull=0_cfl=20/run.json";
    const auto time = fs::last_write_time(diverged);
    CHECK(program(sweep).code == 0);
    CHECK(fs::last_write_time(diverged) == time);
  }

  TEST_CASE("wrong names, values and options of a sweep are refused before anything runs") {
    const TemporaryFolder folder;
    const std::map<Texts, std::string> wrong{
        {{"--grid", "sped=1,2"}, "did you mean 'speed'"},
        {{"--grid", "speed=1,-1"}, "out of bounds"},
        {{"--grid", "speed=1", "--grid", "method=og,enogg"}, "did you mean 'enog'"},
        {{"--grid", "method=enog,og", "--grid", "method.zeta=3"}, "(in the run method=og, method.zeta=3)"},
        {{"--grid", "speed=1", "--grid", "speed=2"}, "twice"},
        {{"--grid", "speed=1", "--set", "speed=2"}, "swept"},
        {{"--grid", "until=1", "--until", "2"}, "swept"},
        {{"--grid", "speed"}, "NAME=VALUE"},
        {{"--grid", "speed=1,2", "--index", "2"}, "from 0 to 1"},
        {{"--grid", "speed=1", "--emit", "slrum"}, "did you mean 'slurm'"},
        {{"--grid", "speed=1", "--fail-on", "torn"}, "unknown verdict"},
        {{"--grid", "speed=1", "--jobs", "0"}, "at least 1"},
        {{"--grid", "speed=1", "--jobs", "100000"}, "--jobs is 100000; at most "},
        {{}, "--grid"},
    };
    for (const auto& [more, message] : wrong) {
      const Outcome outcome = program(tiny_sweep(folder, "out", more));
      CAPTURE(outcome.err);
      CHECK(outcome.code == 2);
      CHECK(contains(outcome.err, message));
    }
    CHECK_FALSE(fs::exists(folder / "out/speed=1"));
  }

  TEST_CASE("a folder with foreign results is refused") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "out");
    std::ofstream(folder / "out/results.csv") << "mine";
    CHECK(program(tiny_sweep(folder, "out", {"--grid", "speed=1"})).code == 2);
    CHECK(text_of(folder / "out/results.csv") == "mine");
    REQUIRE(call(tiny_run(folder, "run", {"--no-render"})).code == 0);
    CHECK(program(tiny_sweep(folder, "run", {"--grid", "speed=1"})).code == 2);
    CHECK(program(tiny_sweep(folder, "discs.toml", {"--grid", "speed=1"})).code == 2);
    CHECK(program(tiny_sweep(folder, "discs.toml/out", {"--grid", "speed=1"})).code == 4);
  }

  TEST_CASE(
      "a sweep with --index does a single run and writes no results, and a sweep without --index writes them") {
    const TemporaryFolder folder;
    Texts grid{"--grid", "speed=1,2,3"};
    REQUIRE(program(tiny_sweep(folder, "whole", grid)).code == 0);
    for (const std::string index : {"2", "0"}) {
      Texts one = grid;
      one.insert(one.end(), {"--index", index});
      const Outcome outcome = program(tiny_sweep(folder, "single", one));
      CHECK(outcome.code == 0);
      CHECK(contains(outcome.out, "run " + index + " (speed="));
      CHECK_FALSE(fs::exists(folder / "single/results.csv"));
    }
    const auto before = ends(folder / "single");
    CHECK(before.size() == 2);
    REQUIRE(program(tiny_sweep(folder, "single", grid)).code == 0);
    CHECK(ends(folder / "single").at("speed=3") == before.at("speed=3"));
    CHECK(results(folder / "single") == results(folder / "whole"));
  }
}
