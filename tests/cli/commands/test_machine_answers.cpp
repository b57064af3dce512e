#include <algorithm>
#include <cstdlib>

#include <doctest/doctest.h>

#include "cli/text/json.hpp"
#include "cli/text/test_report.hpp"
#include "tests/support/results_file.hpp"
#include "tests/support/sweep_folder.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

/// `measures` is JSON text.
std::string write_measured(const TemporaryFolder& folder, const std::string& name,
                           const std::string& measures, const std::string& status = "finished") {
  fs::create_directories(folder / name);
  std::ofstream(folder / name / "run.json")
      << R"({"taut": "0.1.0", "scene": "plate", "method": "tl", "status": ")" << status
      << R"(", "verdict": "stable", "measures": )" << measures << "}";
  return folder.str(name);
}

Json answer_of(const Outcome& outcome, const std::string& command) {
  CAPTURE(outcome.err);
  CAPTURE(outcome.out);
  const Json answer = parse_json(outcome.out, "standard output");
  REQUIRE(answer.is_object());
  REQUIRE(answer.find("answer"));
  CHECK(answer.find("answer")->text() == command);
  CHECK(answer.find("format")->number() == 1);
  CHECK(answer.find("taut")->is_text());
  return answer;
}

Texts keys_in(const Json& object) {
  Texts keys;
  for (const auto& [key, value] : object.members()) keys.push_back(key);
  return keys;
}

const Json& item(const Json& array, std::size_t index) { return array.items().at(index); }

bool python_is_installed() { return std::system("/usr/bin/python3 -c '' 2>/dev/null") == 0; }

nlohmann::ordered_json read_junit(const fs::path& file) {
  const TemporaryFolder folder;
  const std::string command = "/usr/bin/python3 " TAUT_SOURCE_DIR "/tests/cli/commands/read_junit.py " +
                              shell_word(file.string()) + " >" + folder.str("read");
  REQUIRE(std::system(command.c_str()) == 0);
  return json_of(folder / "read");
}

class OnGitHub {
 public:
  explicit OnGitHub(const char* value = "true") { ::setenv("GITHUB_ACTIONS", value, 1); }
  ~OnGitHub() { ::unsetenv("GITHUB_ACTIONS"); }
  OnGitHub(const OnGitHub&) = delete;
  OnGitHub& operator=(const OnGitHub&) = delete;
};

const std::string period = R"({"period": {"value": 0.255, "unit": "s"}})";

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("check --json lists each check with its value") {
    const TemporaryFolder folder;
    const std::string run = write_measured(folder, "run", period);
    const Outcome outcome = call({"check", run, "--measure", "period<0.25", "--verdict", "stable", "--json"});
    CHECK(outcome.code == 1);
    const Json answer = answer_of(outcome, "check");
    CHECK(keys_in(answer) == Texts{"taut", "answer", "format", "run", "passed", "checks"});
    CHECK(*answer.find("passed") == Json(false));
    CHECK(answer.find("run")->text() == run);
    const Json& checks = *answer.find("checks");
    REQUIRE(checks.items().size() == 3);
    for (const Json& each : checks.items())
      CHECK(keys_in(each) == Texts{"name", "passed", "expected", "is", "value", "difference"});
    CHECK(item(checks, 2).find("name")->text() == "period");
    CHECK(*item(checks, 2).find("passed") == Json(false));
    CHECK(*item(checks, 2).find("value") == Json(0.255));
    CHECK(*item(checks, 1).find("passed") == Json(true));
    const Outcome fine = call({"check", run, "--measure", "period>0.25", "--json"});
    CHECK(fine.code == 0);
    CHECK(*answer_of(fine, "check").find("passed") == Json(true));
  }

  TEST_CASE("diff --json and snapshot --json list each picture") {
    const TemporaryFolder folder;
    const auto snapshot = [&](const Texts& more) {
      Texts words = tiny_run(folder, "out", {"--baseline", folder.str("base"), "--json"});
      words[0] = "snapshot";
      words.insert(words.end(), more.begin(), more.end());
      return call(words);
    };
    const Outcome updated = snapshot({"--update"});
    CHECK(updated.code == 0);
    CHECK(*answer_of(updated, "snapshot").find("updated") == Json(true));
    const Outcome alike = snapshot({});
    CHECK(alike.code == 0);
    CHECK(*answer_of(alike, "snapshot").find("passed") == Json(true));
    const Outcome other = snapshot({"--set", "speed=3", "--frames", "2"});
    CHECK(other.code == 1);
    const Json answer = answer_of(other, "snapshot");
    CHECK(keys_in(answer) == Texts{"taut", "answer", "format", "run", "baseline", "updated", "pictures",
                                   "difference", "passed"});
    CHECK(*answer.find("passed") == Json(false));
    CHECK(answer.find("difference")->text() == folder.str("out/difference.png"));
    REQUIRE(answer.find("pictures")->items().size() == 5);
    CHECK(item(*answer.find("pictures"), 4).find("only_in")->text() == "a");
    const Outcome diverged = snapshot({"--set", "cfl=20", "--until", "0.02"});
    CHECK(diverged.code == 3);
    CHECK(*answer_of(diverged, "snapshot").find("passed") == Json(false));
    CHECK(contains(diverged.err, "diverged"));

    REQUIRE(snapshot({"--set", "speed=3"}).code == 1);
    const Outcome folders = call({"diff", folder.str("base"), folder.str("out"), "--json"});
    CHECK(folders.code == 1);
    const Json of_folders = answer_of(folders, "diff");
    CHECK(keys_in(of_folders) == Texts{"taut", "answer", "format", "a", "b", "passed", "pictures"});
    const Json& last = item(*of_folders.find("pictures"), 4);
    CHECK(keys_in(last) == Texts{"name", "passed", "share", "greatest", "densest", "window"});
    CHECK(last.find("name")->text() == "frame_00004.png");
    CHECK(*last.find("passed") == Json(false));
    CHECK(last.find("share")->number() > 0);
    const std::string frame = folder.str("base/frame_00000.png");
    const Outcome same = call({"diff", frame, frame, "--json"});
    CHECK(same.code == 0);
    CHECK(item(*answer_of(same, "diff").find("pictures"), 0).find("share")->number() == 0);
  }

  TEST_CASE("choose --json lists the runs that satisfy the request, cheapest first") {
    const TemporaryFolder folder;
    const std::string file = write_results(folder / "a",
                                           "finished,tl,tl,0.2,20,stable,,0.005,2,8,\n"
                                           "finished,icb,icb,0.4,10,stable,,0.008,2,30,\n",
                                           "colliding-rings");
    const auto choose = [&](const std::string& error) {
      return call({"choose", "colliding-rings", "--from", file, "--json", "--error", error});
    };
    const Outcome found = choose("1%");
    CHECK(found.code == 0);
    const Json answer = answer_of(found, "choose");
    CHECK(keys_in(answer) == Texts{"taut", "answer", "format", "scene", "measure", "unit", "error", "seconds",
                                   "granted", "runs", "references", "machines"});
    CHECK(*answer.find("granted") == Json(true));
    CHECK(*answer.find("error") == Json(0.01));
    REQUIRE(answer.find("runs")->items().size() == 2);
    const Json& best = item(*answer.find("runs"), 0);
    CHECK(keys_in(best) == Texts{"name", "method", "spacing", "cfl", "stepping", "error", "error_up_to",
                                 "finer_runs", "seconds", "folder"});
    CHECK(best.find("method")->text() == "tl");
    CHECK(best.find("spacing")->number() == 0.2);
    const Outcome far = choose("0.1%");
    CHECK(far.code == 1);
    CHECK(*answer_of(far, "choose").find("granted") == Json(false));
    CHECK(answer_of(call({"choose", "colliding-rings", "--from", file, "--json"}), "choose")
              .find("error")
              ->is_null());
  }

  TEST_CASE("map --json has a cell or null for each method and value") {
    const TemporaryFolder folder;
    const std::string file = write_results(folder / "a",
                                           "finished,og,og,0.4,10,fractured,0.003,,,4,10\n"
                                           "finished,og,og,0.4,10,stable,,,,4,2\n"
                                           "error,enog,,,,,,,,,10\n",
                                           "rod", "speed");
    const Outcome outcome = call({"map", file, "--json"});
    CHECK(outcome.code == 0);
    const Json answer = answer_of(outcome, "map");
    CHECK(keys_in(answer) ==
          Texts{"taut", "answer", "format", "title", "scene", "parameter", "label", "values", "rows"});
    CHECK(answer.find("parameter")->text() == "speed");
    CHECK(item(*answer.find("values"), 1).number() == 10);
    const Json& enog = item(*answer.find("rows"), 1);
    CHECK(enog.find("name")->text() == "enog");
    CHECK(item(*enog.find("cells"), 0).is_null());
    CHECK(item(*enog.find("cells"), 1).find("verdict")->is_null());
    CHECK(item(*enog.find("cells"), 1).find("status")->text() == "error");
    const Json& torn = item(*item(*answer.find("rows"), 0).find("cells"), 1);
    CHECK(torn.find("verdict")->text() == "fractured");
    CHECK(torn.find("since")->number() == 0.003);
    CHECK(call({"map", file, "--json", "--markdown"}).code == 2);
    const Outcome drawn = call({"map", file, "--json", "--out", folder.str("map.png")});
    CHECK(drawn.out == outcome.out);
    CHECK(fs::exists(folder / "map.png"));
  }

  TEST_CASE("sweep --json contains the runs of results.json, and --list refuses --junit") {
    const TemporaryFolder folder;
    const Texts grid{
        "--grid", "cfl=0.5,20", "--until", "0.01", "--json", "--junit", folder.str("new/junit.xml")};
    const Outcome outcome = program(tiny_sweep(folder, "out", grid));
    CHECK(outcome.code == 0);
    const Json answer = answer_of(outcome, "sweep");
    CHECK(keys_in(answer) ==
          Texts{"taut", "answer", "format", "folder", "title", "scene", "swept", "fixed", "runs", "passed"});
    CHECK(*answer.find("passed") == Json(true));
    const Json stored = parse_json(text_of(folder / "out/results.json"), "results.json");
    CHECK(*answer.find("runs") == *stored.find("runs"));
    CHECK(item(*answer.find("runs"), 1).find("verdict")->text() == "diverged");

    Texts strict = tiny_sweep(folder, "out", grid);
    strict.insert(strict.end(), {"--fail-on", "diverged"});
    const Outcome failed = program(strict);
    CHECK(failed.code == 3);
    CHECK(*answer_of(failed, "sweep").find("passed") == Json(false));
    strict.insert(strict.end(), {"--index", "0"});
    const Outcome first = program(strict);
    CHECK(first.code == 0);
    CHECK(answer_of(first, "sweep").find("runs")->items().size() == 1);
    CHECK(call(tiny_sweep(folder, "out", {"--grid", "cfl=0.5", "--list", "--junit", "x"})).code == 2);
    const Outcome list =
        program(tiny_sweep(folder, "out", {"--grid", "cfl=0.5,20", "--until", "0.01", "--list", "--json"}));
    CHECK(answer_of(list, "sweep").find("runs")->items().size() == 2);
  }

  TEST_CASE("Python reads JUnit files of checks, pictures and runs, also with control characters in names") {
    if (!python_is_installed()) {
      MESSAGE("skipped: there is no Python 3 (Debian's package python3)");
      return;
    }
    const TemporaryFolder folder;
    const std::string file = folder.str("junit.xml");
    const std::string hostile = R"({"a<b>&\"c']]>\u0001\u001b[31m\n\ufffe": {"value": )";
    const std::string good = write_measured(folder, "good", hostile + R"(1, "unit": "<&>"}})"),
                      moved = write_measured(folder, "moved", hostile + R"(2, "unit": "<&>"}})");
    CHECK(call({"check", moved, "--baseline", good, "--tolerance", "1%", "--junit", file}).code == 1);
    const auto checks = read_junit(file);
    CHECK(checks["suite"] == "taut check: " + moved);
    REQUIRE(checks["cases"].size() == 3);
    CHECK(checks["cases"][0]["name"] == "status finished");
    CHECK(checks["cases"][0]["class"] == "taut.check");
    CHECK(checks["cases"][0]["result"] == "passed");
    CHECK(checks["cases"][2]["name"] == "a<b>&\"c']]>\\x01\\x1b[31m\n\uFFFD 1 <&> ± 1 %");
    CHECK(checks["cases"][2]["result"] == "failure");
    CHECK(contains(checks["cases"][2]["text"], "expected 1 <&> ± 1 %, is 2 <&> (+100 %)"));

    const auto snapshot = [&](const Texts& more) {
      Texts words = tiny_run(folder, "out", {"--baseline", folder.str("base"), "--junit", file});
      words[0] = "snapshot";
      words.insert(words.end(), more.begin(), more.end());
      return call(words).code;
    };
    REQUIRE(snapshot({"--update"}) == 0);
    REQUIRE(snapshot({"--set", "speed=3", "--frames", "2"}) == 1);
    const auto pictures = read_junit(file);
    REQUIRE(pictures["cases"].size() == 5);
    CHECK(pictures["cases"][0]["name"] == "frame_00000.png");
    CHECK(pictures["cases"][4]["result"] == "failure");
    CHECK(contains(pictures["cases"][4]["text"], "is only in " + folder.str("base")));
    REQUIRE(snapshot({"--set", "cfl=20", "--until", "0.02"}) == 3);
    const auto diverged = read_junit(file);
    REQUIRE(diverged["cases"].size() == 1);
    CHECK(diverged["cases"][0]["result"] == "error");
    CHECK(contains(diverged["cases"][0]["text"], "diverged at t = "));

    Texts sweep = tiny_sweep(folder, "sweep", {"--grid", "cfl=0.5,20", "--until", "0.01", "--junit", file});
    sweep.insert(sweep.end(), {"--fail-on", "diverged"});
    REQUIRE(program(sweep).code == 3);
    const auto runs = read_junit(file);
    REQUIRE(runs["cases"].size() == 2);
    CHECK(runs["cases"][0]["name"] == "cfl=0.5");
    CHECK(runs["cases"][0]["result"] == "passed");
    for (const int k : {0, 1}) {
      const auto record = json_of(folder / "sweep" / (k == 0 ? "cfl=0.5" : "cfl=20") / "run.json");
      const double wall = record["provenance"]["wall_seconds"].get<double>();
      CHECK(std::abs(runs["cases"][k]["time"].get<double>() - wall) <= 0.0005);
    }
    CHECK(runs["cases"][1]["result"] == "failure");
    CHECK(contains(runs["cases"][1]["text"], "diverged since "));

    std::ofstream(file) << junit_xml(
        {"check", "\xff", {{"\xc3(\xed\xa0\x80", TestCase::Result::error, "\x80"}}});
    const auto bytes = read_junit(file);
    CHECK(contains(bytes["cases"][0]["name"], "\uFFFD("));
    CHECK(bytes["cases"][0]["text"] == "\uFFFD");
  }

  TEST_CASE("a JUnit file that cannot be written gives exit code 4 with its path, after the results") {
    const TemporaryFolder folder;
    const std::string run = write_measured(folder, "run", period);
    const std::string file = folder.str("run/run.json/junit.xml");
    const Outcome outcome = call({"check", run, "--measure", "period>0", "--junit", file});
    CHECK(outcome.code == 4);
    CHECK(contains(outcome.err, folder.str("run/run.json")));
    CHECK(contains(outcome.out, "\nfine\n"));
    fs::create_directories(folder / "junit.xml");
    CHECK(call({"check", run, "--measure", "period>0", "--junit", folder.str("junit.xml")}).code == 4);
    CHECK(files_in(folder.path()) == 2);
  }

  TEST_CASE("on GitHub at most ten failures are annotations on stderr") {
    const TemporaryFolder folder;
    const std::string run = write_measured(folder, "run", R"({"a:b,c\n%": {"value": 1, "unit": "1"}})"),
                      good = write_measured(folder, "good", R"({"a:b,c\n%": {"value": 2, "unit": "1"}})");
    const Texts words{"check", run, "--baseline", good, "--tolerance", "1%", "--json"};
    {
      const OnGitHub elsewhere("false");
      CHECK(call(words).err.empty());
    }
    const OnGitHub step;
    const Outcome outcome = call(words);
    CHECK(outcome.err ==
          "::error title=taut check%3A a%3Ab%2Cc%0A%25 2 ± 1 %25::"
          "a:b,c%0A%25: expected 2 ± 1 %25, is 1 (-50 %25)\n");
    CHECK(*answer_of(outcome, "check").find("passed") == Json(false));
    Texts many{"check", good, "--measure"};
    for (int k = 0; k < 12; ++k) many.push_back("measures.a:b,c\n%.value>" + std::to_string(10 + k));
    const Outcome all = call(many);
    CHECK(all.code == 1);
    const std::string& err = all.err;
    CHECK(std::ranges::count(err, '\n') == 10);
  }
}
