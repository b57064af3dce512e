#include <csignal>
#include <fstream>

#include <doctest/doctest.h>

#include "tests/support/child_program.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/relative.hpp"

using namespace taut::test;

namespace {

using Arguments = std::vector<std::string>;

Arguments resumed(const TemporaryFolder& folder, Arguments more) {
  more.insert(more.begin(), {"run", "--resume", folder.str("out"), "--threads", "1", "--quiet"});
  return more;
}

void pretend_it_took(const TemporaryFolder& folder, double seconds) {
  auto record = json_of(folder / "out/run.json");
  record["provenance"]["wall_seconds"] = seconds;
  std::ofstream(folder / "out/run.json") << record.dump(2);
}

/// Without the columns that depend on the times of judgement.
std::string motion_in(const fs::path& history) {
  std::istringstream text(text_of(history));
  std::string all, line;
  std::getline(text, line);
  const auto columns = std::count(line.begin(), line.begin() + static_cast<long>(line.find("pieces")), ',');
  for (; std::getline(text, line);) {
    std::size_t end = 0;
    for (long k = 0; k < columns; ++k) end = line.find(',', end) + 1;
    all += line.substr(0, end) + "\n";
  }
  return all;
}

}  // namespace

TEST_SUITE("restart") {
  TEST_CASE(
      "an interrupted run without --checkpoint-every leaves a checkpoint and resumes to the same bytes") {
    const TemporaryFolder folder;
    const Arguments long_run{"--until", "0.1", "--range", "auto", "--frames", "20"};
    REQUIRE(call(tiny_run(folder, "straight", long_run)).code == 0);
    ChildProgram child(tiny_run(folder, "out", long_run));
    ChildProgram::wait_for(folder / "out/history.csv");
    child.send(SIGINT);
    const int code = child.exit_code();
    if (code == 0) {
      MESSAGE("skipped: the run finished before the interrupt");
      return;
    }
    REQUIRE(code == 130);
    REQUIRE(fs::exists(folder / "out/checkpoint.bin"));
    CHECK(call(resumed(folder, {})).code == 0);
    CHECK_FALSE(fs::exists(folder / "out/checkpoint.bin"));
    CHECK(text_of(folder / "out/history.csv") == text_of(folder / "straight/history.csv"));
    CHECK(text_of(folder / "out/frames/frame_00020.png") ==
          text_of(folder / "straight/frames/frame_00020.png"));
  }

  TEST_CASE("a finished run continues to a later end, with the motion and frames of an uninterrupted run") {
    for (const std::string range : {"0:4", "auto"}) {
      CAPTURE(range);
      const TemporaryFolder folder;
      const Arguments drawn{"--range", range, "--history", "1e-5", "--save-particles"};
      const auto with = [&](Arguments more) {
        more.insert(more.end(), drawn.begin(), drawn.end());
        return more;
      };
      REQUIRE(call(tiny_run(folder, "straight", with({"--until", "0.004", "--frames", "8"}))).code == 0);
      REQUIRE(call(tiny_run(folder, "out", with({"--keep-checkpoint"}))).code == 0);
      const Outcome on = call(resumed(folder, {"--until", "0.004"}));
      CAPTURE(on.err);
      CHECK(on.code == 0);
      const auto record = json_of(folder / "out/run.json");
      CHECK(record["status"] == "finished");
      CHECK(record["until"] == 0.004);
      CHECK(record["steps"] == json_of(folder / "straight/run.json")["steps"]);
      CHECK(motion_in(folder / "out/history.csv") == motion_in(folder / "straight/history.csv"));
      CHECK(text_of(folder / "out/scene.toml") == text_of(folder / "straight/scene.toml"));
      for (const char* file : {"particles/particles_00005.vtp", "particles/particles_00008.vtp",
                               "frames/frame_00003.png", "frames/frame_00008.png"}) {
        CAPTURE(file);
        CHECK(text_of(folder / "out" / file) == text_of(folder / "straight" / file));
      }
      CHECK(call(resumed(folder, {"--until", "0.005"})).code == 0);
      CHECK(fs::exists(folder / "out/frames/frame_00010.png"));
    }
  }

  TEST_CASE("a finished run is not continued without a later end or a checkpoint, and keeps its history") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "out", {"--keep-checkpoint"})).code == 0);
    const std::string history = text_of(folder / "out/history.csv");
    const auto check = [&](const Arguments& more, const std::string& message) {
      const Outcome outcome = call(resumed(folder, more));
      CAPTURE(outcome.err);
      CHECK(outcome.code == 2);
      CHECK(contains(outcome.err, message));
      CHECK(text_of(folder / "out/history.csv") == history);
    };
    check({}, "give a later --until to continue it");
    check({"--until", "0.001"}, "give a later --until");
    check({"--until", "0.0041"}, "multiple of the time between frames, 0.0005 s, such as 0.004");
    check({"--until", "0.004", "--set", "speed=3"}, "speed=3 would change it");
    fs::remove(folder / "out/checkpoint.bin");
    check({"--until", "0.004"}, "it has no checkpoint");
  }

  TEST_CASE("the later end of a continued run is a number or an expression, as for a new run") {
    const TemporaryFolder folder;
    const auto continued = [&](const std::string& until) {
      return call(resumed(folder, {"--until", until}));
    };
    REQUIRE(call(tiny_run(folder, "out", {"--keep-checkpoint"})).code == 0);
    CHECK(contains(continued("1/500").err, "give a later --until to continue it"));
    CHECK(contains(continued("1/250*sped").err, "sped"));
    CHECK(contains(continued("1/0").err, "until = '1/0' is inf; it must be a finite number"));
    const Outcome first = continued("1/250");
    CHECK_MESSAGE(first.code == 0, first.err);
    CHECK(json_of(folder / "out/run.json")["until"] == 0.004);
    auto record = json_of(folder / "out/run.json");
    record["status"] = "interrupted";
    std::ofstream(folder / "out/run.json") << record.dump(2);
    const Outcome second = continued("0.0025*speed");
    CHECK_MESSAGE(second.code == 0, second.err);
    CHECK(json_of(folder / "out/run.json")["until"] == 0.005);
  }

  TEST_CASE("a run continues to the end of a drive and not past it") {
    const TemporaryFolder folder;
    Arguments start = tiny_run(folder, "out", {"--keep-checkpoint"});
    std::string scene = text_of(start[1]);
    scene.insert(scene.find("[[body]]\nname = \"right\""),
                 "driven = [{ where = \"x < -0.018\", velocity = [0, 0], until = 0.003 }]\n");
    std::ofstream(start[1]) << scene;
    REQUIRE(call(start).code == 0);
    REQUIRE(call(resumed(folder, {"--until", "0.003"})).code == 0);
    const std::string history = text_of(folder / "out/history.csv");
    const Outcome refused = call(resumed(folder, {"--until", "0.004"}));
    CHECK(refused.code == 2);
    CHECK(contains(refused.err,
                   "the run cannot continue past 0.003 s, where a drive of body 'left' ends; "
                   "give at most this time, or start again with --until 0.004"));
    CHECK(text_of(folder / "out/history.csv") == history);
  }
}

TEST_SUITE("cli") {
  TEST_CASE("a run that took more than a minute is replaced only with --force") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "out")).code == 0);
    pretend_it_took(folder, 59);
    CHECK(call(tiny_run(folder, "out")).code == 0);
    pretend_it_took(folder, 90);
    const std::string before = text_of(folder / "out/run.json");
    const Outcome refused = call(tiny_run(folder, "out"));
    CHECK(refused.code == 2);
    CHECK(contains(refused.err,
                   "took 1.5 minutes; replace it with --force, or name another folder with --out"));
    CHECK(text_of(folder / "out/run.json") == before);
    CHECK(call(tiny_run(folder, "out", {"--force"})).code == 0);
    CHECK(text_of(folder / "out/run.json") != before);
  }

  TEST_CASE("a dry run reports size and step, draws the first picture and creates no run folder") {
    const TemporaryFolder folder;
    const Outcome dry = call(tiny_run(folder, "out", {"--dry-run"}));
    CAPTURE(dry.err);
    CHECK(dry.code == 0);
    CHECK_FALSE(fs::exists(folder / "out"));
    const Outcome run = call(tiny_run(folder, "out"));
    const auto record = json_of(folder / "out/run.json");
    CHECK(contains(dry.out, record["particles"].dump() + " particles at dp = 0.002 m, about "));
    const std::string about = dry.out.substr(dry.out.find("about ") + 6);
    CHECK(std::stod(about) == relative(record["steps"].get<double>(), 0.1));
    CHECK(text_of(folder / "out-first.png") == text_of(folder / "out/frames/frame_00000.png"));
    for (const char* part : {"\n  step ", "\n  solving ", "\n  memory ", "\n  frames      5\n"})
      CHECK(contains(dry.out, part));
    CHECK(call(tiny_run(folder, "other", {"--dry-run", "--no-render"})).code == 0);
    CHECK_FALSE(fs::exists(folder / "other-first.png"));
    CHECK(
        contains(call(tiny_run(folder, "out", {"--dry-run", "--set", "speed=500"})).err, "its sound speed"));
    CHECK(call({"run", "--resume", folder.str("out"), "--dry-run"}).code == 2);
  }
}
