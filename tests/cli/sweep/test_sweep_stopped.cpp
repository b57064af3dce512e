#include <doctest/doctest.h>

#include "cli/system/folder_lock.hpp"
#include "tests/support/child_program.hpp"
#include "tests/support/sweep_folder.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

void wait_until_one_has_ended(const fs::path& folder) {
  ChildProgram::wait([&] { return contains(text_of(folder / "results.csv"), ",finished,"); });
}

void wait_until_the_short_run_has_ended(const fs::path& folder) {
  wait_until_one_has_ended(folder);
  ChildProgram::wait_for(folder / "until=1000/history.csv");
}

Texts endless_sweep(const TemporaryFolder& folder, const Texts& more = {}) {
  Texts all{"--grid", "until=1000,0.001", "--set", "speed=0", "--history", "0.001", "--jobs", "2"};
  all.insert(all.end(), more.begin(), more.end());
  return tiny_sweep(folder, "out", all);
}

std::vector<pid_t> children(const ChildProgram& sweep) {
  const std::string process = std::to_string(sweep.process());
  std::istringstream text(text_of("/proc/" + process + "/task/" + process + "/children"));
  return {std::istream_iterator<pid_t>(text), {}};
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE(
      "a sweep that is killed and restarted ends like an undisturbed one, and repeats no finished run") {
    const TemporaryFolder folder;
    const Texts grid{"--grid", "speed=1:2:0.2", "--until", "0.2", "--jobs", "2"};
    {
      ChildProgram sweep(tiny_sweep(folder, "killed", grid));
      wait_until_one_has_ended(folder / "killed");
      sweep.send(SIGKILL);
      CHECK(sweep.exit_code() == -1);
    }
    const auto before = ends(folder / "killed");
    CHECK(before.size() >= 1);
    WARN(before.size() < 6);  // else the signal came too late
    REQUIRE(program(tiny_sweep(folder, "killed", grid)).code == 0);
    const auto after = ends(folder / "killed");
    CHECK(after.size() == 6);
    for (const auto& [run, time] : before) CHECK(after.at(run) == time);
    REQUIRE(program(tiny_sweep(folder, "undisturbed", grid)).code == 0);
    CHECK(results(folder / "killed") == results(folder / "undisturbed"));
  }

  TEST_CASE("an interrupt ends the runs of a sweep cleanly, and the results record it") {
    for (const int signal : {SIGINT, SIGTERM}) {
      const TemporaryFolder folder;
      ChildProgram sweep(endless_sweep(folder));
      wait_until_the_short_run_has_ended(folder / "out");
      sweep.send(signal);
      CHECK(sweep.exit_code() == 128 + signal);
      CHECK(statuses(folder / "out") == Texts{"interrupted", "finished"});
      CHECK(json_of(folder / "out/until=1000/run.json")["status"] == "interrupted");
      CHECK(text_of(folder / "out/until=1000/history.csv").back() == '\n');
      CHECK(contains(program(endless_sweep(folder, {"--list"})).out, "to do: interrupted"));
    }
  }

  TEST_CASE("a second interrupt ends a sweep and its runs at once") {
    const TemporaryFolder folder;
    ChildProgram sweep(endless_sweep(folder));
    wait_until_the_short_run_has_ended(folder / "out");
    // a stopped run delays the end
    for (const pid_t child : children(sweep)) ::kill(child, SIGSTOP);
    sweep.send(SIGINT);
    sweep.send(SIGTERM);
    const int code = sweep.exit_code();
    CHECK((code == 130 || code == 143));  // either handler can run first
    std::ostringstream err;
    // a surviving run would hold the lock
    CHECK_NOTHROW(taut::cli::FolderLock(folder / "out", taut::cli::FolderLock::Of::sweep, "taut test", err));
    // a clean end would record "interrupted"
    CHECK(json_of(folder / "out/until=1000/run.json")["status"] == "running");
  }

  TEST_CASE("a run that crashes is an error in the results, and its sweep exits with code 70") {
    const TemporaryFolder folder;
    ChildProgram sweep(endless_sweep(folder));
    wait_until_the_short_run_has_ended(folder / "out");
    const std::vector<pid_t> running = children(sweep);
    REQUIRE(running.size() == 1);
    ::kill(running.front(), SIGSEGV);
    CHECK(sweep.exit_code() == 70);
    CHECK(statuses(folder / "out") == Texts{"error", "finished"});
    const auto run = json_of(folder / "out/results.json")["runs"][0];
    CHECK(run["message"] == "killed: Segmentation fault");
    CHECK_FALSE(run.contains("verdict"));
    CHECK(contains(program(endless_sweep(folder, {"--list"})).out, "to do"));
  }

  TEST_CASE(
      "a sweep exits with the code of its gravest error: a crash, then an unwritable file, then a wrong scene") {
    const TemporaryFolder folder;
    std::string text = text_of(write_tiny_scene(folder));
    const std::string parameters = "[parameters]\n";
    text.insert(text.find(parameters) + parameters.size(),
                "limit = { value = 1, unit = \"s\", help = \"of gravity\" }\n");
    std::ofstream(folder / "nan.toml") << "gravity = [0, \"-sqrt(limit - t)\"]\n" << text;
    fs::create_directories(folder / "out");
    std::ofstream(folder / "out/sweep.lock") << "";
    fs::create_directory(folder / "out/limit=2");
    // a lock file cannot be opened through a symlink, so this run cannot write
    fs::create_symlink("nowhere", folder / "out/limit=2/run.lock");
    const auto sweep = [&](const std::string& limits, const Texts& more = {}) {
      Texts words{"sweep", folder.str("nan.toml"), "--grid", "limit=" + limits,
                  "--out", folder.str("out"),      "--quiet"};
      words.insert(words.end(), more.begin(), more.end());
      return words;
    };
    CHECK(program(sweep("0.001")).code == 2);
    CHECK(program(sweep("0.001,2")).code == 4);
    CHECK(program(sweep("2,0.001")).code == 4);
    ChildProgram crashing(sweep("0.001,2,5000", {"--until", "1000", "--history", "0.001", "--jobs", "3"}));
    ChildProgram::wait_for(folder / "out/limit=5000/history.csv");
    ChildProgram::wait([&] { return children(crashing).size() == 1; });
    ::kill(children(crashing).front(), SIGSEGV);
    CHECK(crashing.exit_code() == 70);
    CHECK(statuses(folder / "out") == Texts{"error", "error", "error"});
  }

  TEST_CASE("a run that cannot write its files is reported, and the others continue") {
    const TemporaryFolder folder;
    const Texts sweep = tiny_sweep(folder, "out", {"--grid", "speed=1,2,3"});
    fs::create_directories(folder / "out");
    std::ofstream(folder / "out/sweep.lock") << "";
    fs::create_directory(folder / "out/speed=2");
    fs::create_symlink("nowhere", folder / "out/speed=2/run.lock");
    const Outcome outcome = program(sweep);
    CHECK(outcome.code == 4);
    CHECK(contains(outcome.err, "run 1 (speed=2): "));
    CHECK(statuses(folder / "out") == Texts{"finished", "error", "finished"});
    fs::remove(folder / "out/speed=2/run.lock");
    CHECK(program(sweep).code == 0);
    CHECK(statuses(folder / "out") == Texts{"finished", "finished", "finished"});
  }

  TEST_CASE("two sweeps cannot use one folder at once") {
    const TemporaryFolder folder;
    const ChildProgram sweep(endless_sweep(folder));
    wait_until_the_short_run_has_ended(folder / "out");
    for (const Texts& more : {Texts{}, Texts{"--index", "1"}}) {
      const Outcome second = program(endless_sweep(folder, more));
      CHECK(second.code == 2);
      CHECK(contains(second.err,
                     "is in use by `taut sweep` (process " + std::to_string(sweep.process()) + " on "));
    }
  }

  TEST_CASE("a single run of a sweep cannot start while another program runs it") {
    const TemporaryFolder folder;
    const Texts first{"--index", "0"};
    const ChildProgram sweep(endless_sweep(folder, first));
    ChildProgram::wait_for(folder / "out/until=1000/history.csv");
    const Outcome again = program(endless_sweep(folder, first));
    CHECK(again.code == 2);
    CHECK(contains(again.err, "until=1000' is in use by `taut sweep` (process "));
    CHECK(json_of(folder / "out/until=1000/run.json")["status"] == "running");
    CHECK(program(endless_sweep(folder, {"--index", "1"})).code == 0);
    CHECK(contains(program(endless_sweep(folder)).err, "out' is in use by "));
  }

  TEST_CASE("a run whose run.json is cut or garbled is named and repeated, and the others are kept") {
    const TemporaryFolder folder;
    const Texts sweep = tiny_sweep(folder, "out", {"--grid", "speed=1,2,3,4"});
    REQUIRE(program(sweep).code == 0);
    const auto expected = results(folder / "out");
    const auto before = ends(folder / "out");
    const std::string whole = text_of(folder / "out/speed=2/run.json");
    std::ofstream(folder / "out/speed=1/run.json") << "";
    std::ofstream(folder / "out/speed=2/run.json") << whole.substr(0, whole.size() / 2);
    std::ofstream(folder / "out/speed=3/run.json") << std::string(whole).replace(whole.find(",\n"), 1, ";");
    const Outcome outcome = program(sweep);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    for (const char* run : {"run 0 (speed=1): ", "run 1 (speed=2): ", "run 2 (speed=3): "})
      CHECK(contains(outcome.err, run));
    CHECK(contains(outcome.err, "speed=2/run.json is damaged; the run is repeated"));
    CHECK(results(folder / "out") == expected);
    CHECK(ends(folder / "out").at("speed=4") == before.at("speed=4"));
  }

  TEST_CASE("a run.json without a record of a run is named, and its run is repeated") {
    const TemporaryFolder folder;
    const Texts sweep = tiny_sweep(folder, "out", {"--grid", "speed=1:7:1"});
    REQUIRE(program(sweep).code == 0);
    const auto expected = results(folder / "out");
    const auto before = ends(folder / "out");
    const std::string map = program({"map", folder.str("out"), "--markdown"}).out;
    const Texts damaged{"", "{}", "[]", "null", "garbage", R"({"taut": 3})"};
    for (std::size_t k = 0; k < damaged.size(); ++k) {
      const fs::path run = folder / ("out/speed=" + std::to_string(k + 1));
      std::ofstream(run / "run.json") << damaged[k];
      std::ofstream(run / "notes.txt") << "mine";
      for (const Texts& reader : {Texts{"check", run.string(), "--verdict", "stable"},
                                  Texts{"plot", run.string(), "--out", folder.str("plot.svg")},
                                  Texts{"run", "--resume", run.string()}}) {
        const Outcome outcome = program(reader);
        CAPTURE(outcome.err);
        CHECK(outcome.code == 2);
        CHECK(outcome.err.starts_with("taut: '" + (run / "run.json").string() + "'"));
      }
    }
    CHECK(program({"map", folder.str("out"), "--markdown"}).out == map);  // reads results.csv
    const Outcome outcome = program(sweep);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    for (std::size_t k = 0; k < damaged.size(); ++k) {
      const std::string setting = "speed=" + std::to_string(k + 1);
      CHECK(contains(outcome.err, "run " + std::to_string(k) + " (" + setting +
                                      "): " + folder.str("out/" + setting + "/run.json") +
                                      " is damaged; the run is repeated\n"));
      CHECK(text_of(folder / ("out/" + setting) / "notes.txt") == "mine");
    }
    CHECK(results(folder / "out") == expected);
    CHECK(ends(folder / "out").at("speed=7") == before.at("speed=7"));
  }

  TEST_CASE("a folder with a cut run.json is used again only if run.json and all other files are from taut") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "out");
    std::ofstream(folder / "out/run.json") << "";
    std::ofstream(folder / "out/thesis.tex") << "mine";
    CHECK(call(tiny_run(folder, "out", {"--no-render"})).code == 2);
    fs::remove(folder / "out/thesis.tex");
    std::ofstream(folder / "out/run.json") << "{\"runner\": ";
    CHECK(call(tiny_run(folder, "out", {"--no-render"})).code == 2);
    std::ofstream(folder / "out/run.json") << "{\n  \"ta";
    CHECK(call(tiny_run(folder, "out", {"--no-render"})).code == 0);
  }

  TEST_CASE("a run folder whose creation was killed can be used again") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "out");
    std::ofstream(folder / "out/run.json.tmp") << "{";
    CHECK(call(tiny_run(folder, "out", {"--no-render"})).code == 0);
    fs::create_directories(folder / "other");
    std::ofstream(folder / "other/run.json.tmp") << "{";
    std::ofstream(folder / "other/mine") << "mine";
    CHECK(call(tiny_run(folder, "other", {"--no-render"})).code == 2);
  }
}
