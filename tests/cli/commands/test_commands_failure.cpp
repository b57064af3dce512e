#include <array>
#include <csignal>
#include <cstdlib>
#include <sys/mount.h>

#include <doctest/doctest.h>

#include "render/image/png.hpp"
#include "tests/support/child_program.hpp"
#include "tests/support/program_runner.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

/// File system of 64 KiB, if mounting is permitted.
class TinyDisk {
 public:
  explicit TinyDisk(const fs::path& at) : at_(at) {
    fs::create_directories(at_);
    mounted_ = ::mount("tmpfs", at_.c_str(), "tmpfs", 0, "size=64k") == 0;
  }
  ~TinyDisk() {
    if (mounted_) ::umount(at_.c_str());
  }
  TinyDisk(const TinyDisk&) = delete;
  TinyDisk& operator=(const TinyDisk&) = delete;
  bool mounted() const { return mounted_; }

 private:
  fs::path at_;
  bool mounted_ = false;
};

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("an interrupt ends a run cleanly, with exit code 128 + signal") {
    for (const int signal : {SIGINT, SIGTERM}) {
      const TemporaryFolder folder;
      ChildProgram child(tiny_run(folder, "out", {"--until", "1000", "--frames", "1", "--history", "1000"}));
      ChildProgram::wait_for(folder / "out/frames/frame_00000.png");
      child.send(signal);
      CHECK(child.exit_code() == 128 + signal);
      const auto record = json_of(folder / "out/run.json");
      CHECK(record["status"] == "interrupted");
      CHECK(record["reached"].get<double>() < 1000);
      CHECK(lines_of(folder / "out/history.csv").size() == (record["steps"] > 0 ? 3 : 2));
      CHECK(taut::render::read_png(folder / "out/frames/frame_00000.png").width == 160);
      CHECK(files_in(folder / "out/frames") == 1);
    }
  }

  TEST_CASE("an interrupted run draws the frames kept for its automatic range") {
    const TemporaryFolder folder;
    ChildProgram child(tiny_run(
        folder, "out", {"--until", "1000", "--frames", "1", "--history", "1000", "--range", "auto"}));
    ChildProgram::wait_for(folder / "out/history.csv");
    child.send(SIGINT);
    CHECK(child.exit_code() == 130);
    CHECK(taut::render::read_png(folder / "out/frames/frame_00000.png").width == 160);
  }

  TEST_CASE("a closed terminal ends a run cleanly, and nohup prevents this") {
    const TemporaryFolder folder;
    const std::vector<std::string> endless{"--until", "1000",  "--frames", "1", "--checkpoint-every",
                                           "1000",    "--set", "speed=0"};
    ChildProgram child(tiny_run(folder, "out", endless));
    ChildProgram::wait_for(folder / "out/frames/frame_00000.png");
    child.send(SIGHUP);
    child.send(SIGHUP);
    CHECK(child.exit_code() == 129);
    CHECK(json_of(folder / "out/run.json")["status"] == "interrupted");
    CHECK(fs::file_size(folder / "out/checkpoint.bin") > 10000);
    std::signal(SIGHUP, SIG_IGN);
    ChildProgram deaf(tiny_run(folder, "deaf", endless));
    std::signal(SIGHUP, SIG_DFL);
    ChildProgram::wait_for(folder / "deaf/frames/frame_00000.png");
    deaf.send(SIGHUP);
    deaf.send(SIGINT);  // if SIGHUP counted, a second signal would end the program
    CHECK(deaf.exit_code() == 130);
    CHECK(json_of(folder / "deaf/run.json")["status"] == "interrupted");
  }

  TEST_CASE("an interrupt ends a run, and a session, between outputs that are far apart") {
    const TemporaryFolder folder;
    const std::vector<std::string> endless{"--until", "1e9",      "--history",  "1e9",
                                           "--set",   "cfl=1e-6", "--no-render"};
    ChildProgram child(tiny_run(folder, "out", endless));
    ChildProgram::wait_for(folder / "out/history.csv");
    child.send(SIGTERM);
    CHECK(child.exit_code() == 143);
    CHECK(json_of(folder / "out/run.json")["status"] == "interrupted");
    std::ofstream(folder / "script") << "save " << folder.str("before") << "\nrun until 1e9\nsave "
                                     << folder.str("after") << "\n";
    ChildProgram session({"session", folder.str("discs.toml"), "--set", "cfl=1e-6", "--threads", "1"},
                         folder.str("script"));
    ChildProgram::wait_for(folder / "before");
    session.send(SIGTERM);
    CHECK(session.exit_code() == 143);
    CHECK_FALSE(fs::exists(folder / "after"));
  }

  TEST_CASE("a key given by both an option and --set is refused, whichever comes first") {
    const TemporaryFolder folder;
    const std::string scene = write_tiny_scene(folder);
    for (const auto& [name, value, other] :
         {std::array{"spacing", "0.004", "0.002"}, {"until", "1e-5", "2e-5"}, {"method", "tl", "og"}}) {
      const std::string option = "--" + std::string(name), assigned = std::string(name) + "=" + other;
      for (const std::vector<std::string>& words :
           {std::vector<std::string>{option, value, "--set", assigned}, {"--set", assigned, option, value}}) {
        std::vector<std::string> command{"run", scene, "--no-render", "--out", folder.str("out")};
        command.insert(command.end(), words.begin(), words.end());
        const Outcome outcome = call(command);
        CHECK(outcome.code == 2);
        CHECK(contains(outcome.err, option + " and --set " + name + "=... set the same value"));
      }
    }
    CHECK_FALSE(fs::exists(folder / "out"));
  }

  TEST_CASE("time steps too small to move anything are refused with the bound") {
    const TemporaryFolder folder;
    const std::string scene = write_tiny_scene(folder), text = text_of(scene);
    std::ofstream(folder / "file.toml") << "cfl = 1e-14\n" << text;
    const std::string bound = "cfl = 1e-14 must be at least 1e-06";
    for (const auto& arguments :
         {std::vector<std::string>{"run", scene, "--set", "cfl=1e-14"},
          {"run", folder.str("file.toml")},
          {"sweep", scene, "--grid", "cfl=0.4,1e-14", "--out", folder.str("sweep")}}) {
      const Outcome outcome = call(arguments);
      CAPTURE(outcome.err);
      CHECK(outcome.code == 2);
      CHECK(contains(outcome.err, bound));
    }
    CHECK(contains(call({"run", folder.str("file.toml")}).err, "file.toml:1:"));
  }

  TEST_CASE("a second interrupt ends the program and leaves a complete run.json") {
    const TemporaryFolder folder;
    ChildProgram child(tiny_run(folder, "out", {"--until", "1000", "--frames", "1"}));
    ChildProgram::wait_for(folder / "out/frames/frame_00000.png");
    child.send(SIGINT);
    child.send(SIGTERM);
    const int code = child.exit_code();
    CHECK((code == 130 || code == 143));  // either handler can run first
    CHECK(json_of(folder / "out/run.json").contains("status"));
  }

  TEST_CASE("the message of a run that starts too fast names its initial state, not the time step") {
    const TemporaryFolder folder;
    const Outcome outcome = call(tiny_run(folder, "out", {"--set", "speed=1e6", "--no-render"}));
    CAPTURE(outcome.err);
    CHECK(outcome.code == 3);
    CHECK(contains(outcome.err, "check the initial velocity and displacement"));
    CHECK(!contains(outcome.err, "cfl"));
  }

  TEST_CASE("a run that diverges keeps its output and ends with exit code 3") {
    const TemporaryFolder folder;
    const Outcome outcome = call(tiny_run(folder, "out", {"--set", "cfl=20", "--until", "0.02"}));
    CAPTURE(outcome.err);
    CHECK(outcome.code == 3);
    CHECK(contains(outcome.err, "diverged at t = "));
    CHECK(contains(outcome.err, " s, step "));
    CHECK(contains(outcome.err, "particle"));
    CHECK(contains(outcome.out, "diverged since t = "));
    CHECK(!contains(outcome.out, "diverged, diverged"));
    const auto record = json_of(folder / "out/run.json");
    CHECK(record["status"] == "failed");
    CHECK(record["verdict"] == "diverged");
    CHECK(record["since"]["diverged"].get<double>() <= record["reached"].get<double>());
    CHECK(record["reached"].get<double>() < 0.02);
    CHECK(files_in(folder / "out/frames") >= 1);
    CHECK(lines_of(folder / "out/history.csv").size() >= 2);
  }

  TEST_CASE("a fractured run exits with 0, or with 3 if --fail-on is fractured") {
    const TemporaryFolder folder;
    const std::vector<std::string> torn{"--no-render", "--method", "og",     "--set",
                                        "pull=8000",   "--set",    "speed=0"};
    REQUIRE(call(tiny_run(folder, "out", torn)).code == 0);
    const auto record = json_of(folder / "out/run.json");
    CHECK(record["verdict"] == "fractured");
    CHECK(record["status"] == "finished");
    CHECK(record["indicators"]["pieces"].get<int>() > 2);
    CHECK(record["since"]["fractured"].get<double>() > 0);
    std::vector<std::string> strict = torn;
    strict.insert(strict.end(), {"--fail-on", "fractured"});
    const Outcome failed = call(tiny_run(folder, "out", strict));
    CHECK(failed.code == 3);
    CHECK(contains(failed.err, "exit code 3, since the verdict is fractured and --fail-on is fractured"));
    strict.back() = "diverged";
    CHECK(call(tiny_run(folder, "out", strict)).code == 0);
  }

  TEST_CASE("output that cannot be written gives exit code 4 with the path") {
    const TemporaryFolder folder;
    write_tiny_scene(folder);
    const Outcome outcome = call(tiny_run(folder, "discs.toml/out"));
    CHECK(outcome.code == 4);
    CHECK(contains(outcome.err, folder.str("discs.toml/out")));
  }

  TEST_CASE("a full disk gives exit code 4 and leaves complete files") {
    const TemporaryFolder folder;
    const TinyDisk disk(folder / "disk");
    if (!disk.mounted()) {
      MESSAGE("skipped: only root can mount a small file system");
      return;
    }
    const Outcome outcome = call(tiny_run(folder, "disk/out", {"--size", "640x480", "--frames", "100"}));
    CAPTURE(outcome.err);
    CHECK(outcome.code == 4);
    CHECK(contains(outcome.err, "No space left"));
    CHECK(json_of(folder / "disk/out/run.json").contains("status"));
    CHECK(text_of(folder / "disk/out/history.csv").back() == '\n');
    for (const auto& file : fs::directory_iterator(folder / "disk/out/frames")) {
      CHECK(file.path().extension() == ".png");
      CHECK(taut::render::read_png(file.path()).width == 640);
    }
  }

  TEST_CASE("unwritable frames or particles give exit code 4 before the older run is touched") {
    for (const std::string inner : {"frames", "particles"}) {
      CAPTURE(inner);
      const TemporaryFolder folder;
      const std::vector<std::string> again = tiny_run(folder, "out", {"--until", "1e-5", "--save-particles"});
      REQUIRE(call(again).code == 0);
      const std::string record = text_of(folder / "out/run.json");
      const TinyDisk disk(folder / ("out/" + inner));
      if (!disk.mounted()) {
        MESSAGE("skipped: only root can mount a small file system");
        return;
      }
      REQUIRE(::mount(nullptr, (folder / ("out/" + inner)).c_str(), nullptr, MS_REMOUNT | MS_RDONLY,
                      nullptr) == 0);
      const Outcome outcome = call(again);
      CAPTURE(outcome.err);
      CHECK(outcome.code == 4);
      CHECK(contains(outcome.err, "out/" + inner + ": cannot be written: Read-only file system"));
      CHECK(text_of(folder / "out/run.json") == record);
      CHECK(fs::exists(folder / "out/history.csv"));
    }
  }

  TEST_CASE("only one process can write into a run folder at a time, and other processes report it") {
    const TemporaryFolder folder;
    const std::vector<std::string> endless{
        "--until", "1000",  "--save-particles", "--checkpoint-every", "1000", "--frames",
        "1",       "--set", "speed=0"};
    ChildProgram child(tiny_run(folder, "out", endless));
    ChildProgram::wait_for(folder / "out/particles/particles_00000.vtp");
    ChildProgram::wait_for(folder / "out/history.csv");
    const std::string out = folder.str("out"), scene = text_of(folder / "out/scene.toml");
    for (const auto& arguments : {tiny_run(folder, "out"),
                                  tiny_run(folder, "frames/../out/"),
                                  {"run", "--resume", out},
                                  {"render", out},
                                  {"render", out, "--out", out + "/frames"},
                                  {"snapshot", folder.str("discs.toml"), "--baseline", folder.str("good"),
                                   "--update", "--out", out}}) {
      const Outcome outcome = call(arguments);
      CAPTURE(arguments[0]);
      CAPTURE(outcome.err);
      CHECK(outcome.code == 2);
      CHECK(
          contains(outcome.err, "in use by `taut run` (process " + std::to_string(child.process()) + " on "));
    }
    for (const std::string file : {"/checkpoint.bin", "/frames/frame_00000.png"}) {
      std::ofstream(folder / "script") << (file[1] == 'c' ? "save " : "frame ") << out << file << "\n";
      ChildProgram session({"session", folder.str("discs.toml"), "--strict"}, folder.str("script"));
      CHECK(session.exit_code() == 2);
    }
    CHECK(call({"render", out, "--out", folder.str("elsewhere"), "--quiet"}).code == 0);
    CHECK(text_of(folder / "out/scene.toml") == scene);
    child.send(SIGTERM);
    CHECK(child.exit_code() == 143);
    CHECK(json_of(folder / "out/run.json")["status"] == "interrupted");
    CHECK_FALSE(fs::exists(folder / "out/run.lock"));
    CHECK(call({"render", out, "--quiet"}).code == 0);
  }

  TEST_CASE(
      "an error during a run leaves run.json with status and reason, and an earlier error leaves nothing") {
    const TemporaryFolder folder;
    const std::string text = text_of(write_tiny_scene(folder));
    std::ofstream(folder / "nan.toml") << "gravity = [0, \"-sqrt(0.001 - t)\"]\n" << text;
    const auto run = [&](const std::string& scene) {
      return call({"run", folder.str(scene), "--out", folder.str("a/out"), "--threads", "1", "--quiet"});
    };
    const Outcome outcome = run("nan.toml");
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    const auto record = json_of(folder / "a/out/run.json");
    CHECK(record["status"] == "failed");
    CHECK(contains(outcome.err, record["reason"].get<std::string>()));
    CHECK(contains(record["reason"].get<std::string>(), "nan.toml:1:"));
    CHECK(record["reached"] > 0);
    CHECK(lines_of(folder / "a/out/history.csv").size() > 10);
    CHECK_FALSE(fs::exists(folder / "a/out/run.lock"));
    fs::remove_all(folder / "a");
    std::ofstream(folder / "bare.toml") << text << R"([[line]]
name = "beside"
body = "left"
field = "von_mises"
from = [-1, 0]
to = [1, 0]
points = 3
times = [0]
)";
    CHECK(run("bare.toml").code == 2);
    CHECK_FALSE(fs::exists(folder / "a"));
  }

  TEST_CASE("run.json of a diverged run contains the reason") {
    const TemporaryFolder folder;
    const Outcome outcome =
        call(tiny_run(folder, "out", {"--set", "cfl=20", "--until", "0.02", "--no-render"}));
    const auto reason = json_of(folder / "out/run.json")["reason"].get<std::string>();
    CHECK(contains(reason, "diverged at t = "));
    CHECK(contains(outcome.err, "taut: " + reason));
  }

  TEST_CASE("a file above the shell's size limit and a closed or full stream are errors with exit code 4") {
    const TemporaryFolder folder;
    const auto shell = [&](const std::string& before, const std::vector<std::string>& arguments,
                           const std::string& behind) {
      std::string command = before + "'" TAUT_BINARY_DIR "/taut'";
      for (const std::string& argument : arguments) command += " '" + argument + "'";
      return WEXITSTATUS(std::system((command + behind).c_str()));
    };
    const std::string quiet = " >/dev/null 2>'" + folder.str("err") + "'";
    CHECK(shell("ulimit -f 16; ", tiny_run(folder, "long", {"--until", "0.01"}), quiet) == 4);
    CHECK(contains(text_of(folder / "err"), "File too large"));
    CHECK(contains(json_of(folder / "long/run.json")["reason"].get<std::string>(), "File too large"));
    // a run must not reuse a closed stream's descriptor
    REQUIRE(call(tiny_run(folder, "out")).code == 0);
    CHECK(shell("", tiny_run(folder, "closed"), " >&- 2>/dev/null") == 4);
    for (const std::string file : {"history.csv", "scene.toml"})
      CHECK(text_of(folder / "closed" / file) == text_of(folder / "out" / file));
    CHECK(shell("", tiny_run(folder, "full"), " >/dev/full 2>/dev/null") == 4);
    CHECK(json_of(folder / "full/run.json")["status"] == "finished");
    // a pipe without a reader; SIGPIPE is no error, so no message
    const std::string pipe = "'" + folder.str("pipe") + "'";
    CHECK(shell("mkfifo " + pipe + "; exec 3<>" + pipe + " 4>" + pipe + " 3>&-; ", {"list"},
                " >&4 2>'" + folder.str("err") + "'; exit $?") == 128 + SIGPIPE);
    CHECK(text_of(folder / "err").empty());
  }
}
