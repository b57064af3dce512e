#include <csignal>
#include <cstdlib>
#include <sys/stat.h>

#include <doctest/doctest.h>

#include "tests/support/child_program.hpp"
#include "tests/support/path_variable.hpp"
#include "tests/support/results_file.hpp"
#include "tests/support/sweep_folder.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

const std::string one_result = "finished,tl,tl,0.4,10,stable,,0.3,2,4,\n";

void leave_run(const TemporaryFolder& folder, const std::string& run = "run") {
  REQUIRE(call(tiny_run(folder, run, {"--until", "1e-5", "--frames", "1", "--save-particles"})).code == 0);
}

/// Makes `link` a symbolic link; returns true if `work` does not change its target.
bool leaves_alone(const fs::path& link, const std::function<void()>& work) {
  const fs::path victim = link.parent_path() / "victim";
  std::ofstream(victim) << "mine";
  fs::create_symlink("victim", link);
  work();
  const bool alone = text_of(victim) == "mine";
  fs::remove(victim);
  fs::remove(link);
  return alone;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("links in the place of temporary files of a chart are not followed") {
    const TemporaryFolder folder;
    const std::string results = write_results(folder / "a", one_result);
    for (const char* name : {"chart.part.png", "chart.png.part", "chart.png.tmp", "chart.gp.tmp"}) {
      const std::string link = name;
      CAPTURE(link);
      CHECK(leaves_alone(folder / name, [&] {
        const Outcome outcome = call({"chart", results, "--out", folder.str("chart.png")});
        CHECK_MESSAGE(outcome.code == 0, outcome.err);
        CHECK_FALSE(fs::is_symlink(folder / "chart.png"));
      }));
    }
    fs::create_directory(folder / "mine");
    std::ofstream(folder / "mine/chart.png") << "mine";
    fs::create_directory_symlink("mine", folder / "chart.png.part");
    CHECK(call({"chart", results, "--out", folder.str("chart.png")}).code == 0);
    CHECK(text_of(folder / "mine/chart.png") == "mine");
    fs::rename(folder / "mine/chart.png", folder / "mine/other.png");
    fs::rename(folder / "mine", folder / "chart.png.part");
    const Outcome refused = call({"chart", results, "--out", folder.str("chart.png")});
    CHECK(refused.code == 4);
    CHECK(contains(refused.err, "chart.png.part"));
    CHECK(text_of(folder / "chart.png.part/other.png") == "mine");
  }

  TEST_CASE("scene, record, results and checkpoint files of zeros above their limits are refused") {
    const TemporaryFolder folder;
    leave_run(folder);
    const std::string results = write_results(folder / "a", one_result);
    const auto grow = [&](const std::string& name, std::uintmax_t gibibytes = 1) {
      std::ofstream(folder / name).close();
      fs::resize_file(folder / name, gibibytes << 30);
    };
    const auto refuses = [&](const std::vector<std::string>& arguments, const std::string& message) {
      const Outcome outcome = call(arguments);
      CAPTURE(outcome.err);
      CHECK(outcome.code == 2);
      CHECK(contains(outcome.err, message));
    };
    // A whole checkpoint may take half the memory. This one is larger, so only its beginning can have been read.
    grow("run/checkpoint.bin", 1024);
    refuses({"run", "--resume", folder.str("run"), "--until", "1000", "--quiet"},
            "is not a checkpoint of taut");
    grow("run/scene.toml");
    refuses({"render", folder.str("run"), "--quiet"}, "larger than 4 MiB");
    grow("run/run.json");
    const std::string message = "run.json' has 1024 MiB; at most 64 MiB are allowed";
    refuses({"check", folder.str("run"), "--verdict", "stable"}, message);
    refuses({"plot", folder.str("run"), "--out", folder.str("a.png")}, message);
    refuses(tiny_run(folder, "run"), message);
    grow("a/results.json");
    refuses({"map", results, "--out", folder.str("a.png")}, "has 1024 MiB; at most 256 MiB are allowed");
  }

  TEST_CASE("a run folder that is a link is refused unless the user names it") {
    const TemporaryFolder folder;
    leave_run(folder, "mine");
    const std::string before = text_of(folder / "mine/history.csv");
    fs::create_directories(folder / "out");
    fs::create_directories(folder / "sweep");
    fs::create_directory_symlink(folder / "mine", folder / "out/discs-enog");
    fs::create_directory_symlink(folder / "mine", folder / "sweep/speed=1");
    const Outcome swept = program(tiny_sweep(folder, "sweep", {"--grid", "speed=1,2", "--until", "1e-5"}));
    CHECK(swept.code == 2);
    CHECK(contains(swept.err, "speed=1' is a link"));
    const Outcome run = program({"run", write_tiny_scene(folder), "--quiet"}, folder.path());
    CHECK(run.code == 2);
    CHECK(contains(run.err, "'out/discs-enog' is a link"));
    CHECK(text_of(folder / "mine/history.csv") == before);
    CHECK(call(tiny_run(folder, "out/discs-enog", {"--until", "1e-4"})).code == 0);
    CHECK(text_of(folder / "mine/history.csv") != before);
  }

  TEST_CASE("a pipe in the place of a file is refused, not waited for") {
    const TemporaryFolder folder;
    leave_run(folder);
    const std::string run = folder.str("run"), frame = "run/frames/frame_00000.png";
    const std::vector<std::pair<std::string, std::vector<std::string>>> readers = {
        {"run/scene.toml", {"render", run, "--quiet"}},
        {"run/scene.toml", {"compare", run, "--out", folder.str("panel.png")}},
        {"run/scene.toml", {"plot", run, "--out", folder.str("plot.png")}},
        {"run/particles/particles_00000.vtp", {"render", run, "--quiet"}},
        {"run/run.json", {"check", run, "--verdict", "stable"}},
        {frame, {"diff", run, run}},
        {frame, {"diff", folder.str(frame), folder.str("run/frames/frame_00001.png")}},
    };
    for (const auto& [file, arguments] : readers) {
      const auto& name = file;  // clang cannot capture bindings
      CAPTURE(name);
      fs::rename(folder / file, folder / "kept");
      REQUIRE(::mkfifo((folder / file).c_str(), 0666) == 0);
      ChildProgram child(arguments);
      CHECK(child.exit_code() == 2);
      fs::rename(folder / "kept", folder / file);
    }
    REQUIRE(::mkfifo((folder / "pipe.toml").c_str(), 0666) == 0);
    std::ofstream(folder / "sweep.toml") << "scene = '" << folder.str("pipe.toml") << "'\ngrid.cfl = [0.5]\n";
    ChildProgram sweep({"sweep", folder.str("sweep.toml"), "--list"});
    CHECK(sweep.exit_code() == 2);
    ::setenv("TAUT_SCENES", folder.path().c_str(), 1);
    ChildProgram list({"list", "scenes"});
    ::unsetenv("TAUT_SCENES");
    CHECK(list.exit_code() == 0);
    ChildProgram begun(
        tiny_run(folder, "killed",
                 {"--until", "1000", "--frames", "1", "--checkpoint-every", "0.001", "--set", "speed=0"}));
    const fs::path checkpoint = folder / "killed/checkpoint.bin";
    ChildProgram::wait([&] { return fs::exists(checkpoint) && fs::file_size(checkpoint) > 10000; });
    begun.send(SIGKILL);
    begun.ending_signal();
    fs::remove(folder / "killed/history.csv");
    REQUIRE(::mkfifo((folder / "killed/history.csv").c_str(), 0666) == 0);
    ChildProgram resumed({"run", "--resume", folder.str("killed"), "--quiet"});
    CHECK(resumed.exit_code() == 4);
    std::ofstream(folder / "mine") << "mine";
    fs::remove(folder / "killed/history.csv");
    fs::create_hard_link(folder / "mine", folder / "killed/history.csv");
    CHECK(call({"run", "--resume", folder.str("killed"), "--quiet"}).code == 4);
    CHECK(text_of(folder / "mine") == "mine");
  }

  TEST_CASE("contents of foreign files cannot control the terminal") {
    const TemporaryFolder folder;
    const std::string evil = "\x1b]0;evil\x07\u009b2J\u202e";
    const auto is_clean = [&](const Outcome& outcome) {
      const std::string all = outcome.out + outcome.err;
      CAPTURE(all);
      CHECK(contains(all, "\\x1b]0;evil"));
      for (const char* mark : {"\x1b", "\x07", "\u009b", "\u202e"}) CHECK_FALSE(contains(all, mark));
    };
    const std::string results =
        write_results(folder / "a", "finished," + evil + "," + evil + ",0.4,10,stable,,0.3,2,4,\n");
    is_clean(call({"chart", results, "--out", folder.str("a.svg")}));
    is_clean(call({"chart", results, "--markdown"}));
    write_tiny_scene(folder);
    const std::string scene = text_of(folder / "discs.toml");
    const auto with = [&](const std::string& was, const std::string& is) {
      std::string text = scene;
      for (std::size_t at = 0; (at = text.find(was, at)) != std::string::npos; at += is.size())
        text.replace(at, was.size(), is);
      std::ofstream(folder / "evil.toml") << text;
      return folder.str("evil.toml");
    };
    const std::string quoted = "\\u001b]0;evil\\u0007\\u009b2J\\u202e";
    is_clean(call({"describe", with("\"enog\"", "\"" + quoted + "\"")}));
    is_clean(call({"describe", with("[render]", "[\"" + quoted + "\"]")}));
    is_clean(call({"describe", with("[material.rubber]", "[material.\"" + quoted + "\"]")}));
  }

  TEST_CASE("a file that the system fails to read gives exit code 4 and the reason") {
    const TemporaryFolder folder;
    leave_run(folder);
    fs::remove(folder / "run/run.json");
    fs::create_symlink("/proc/self/mem", folder / "run/run.json");  // a read at offset 0 fails
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"check", folder.str("run"), "--verdict", "stable"},
          {"plot", folder.str("run"), "--out", folder.str("a.png")},
          tiny_run(folder, "run")}) {
      const Outcome outcome = call(arguments);
      CAPTURE(outcome.err);
      CHECK(outcome.code == 4);
      CHECK(contains(outcome.err, "run.json: cannot be read: Input/output error"));
    }
  }

  TEST_CASE(
      "programs in the folder of a picture are not run, even if PATH contains empty or relative folders") {
    const TemporaryFolder folder;
    const std::string results = write_results(folder / "a", one_result);
    std::ofstream(folder / "gnuplot") << "#!/bin/sh\n: > stolen\n";
    fs::permissions(folder / "gnuplot", fs::perms::owner_all);
    for (const char* path : {"", ".", ":/nowhere", "./:."}) {
      const std::string entries = path;
      CAPTURE(entries);
      const OnlyPath only{fs::path(path)};
      const Outcome outcome = call({"chart", results, "--out", folder.str("a.svg")});
      CHECK(outcome.code == 4);
      CHECK(contains(outcome.err, "is not installed"));
    }
    CHECK_FALSE(fs::exists(folder / "stolen"));
  }
}
