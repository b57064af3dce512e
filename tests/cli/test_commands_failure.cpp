#include <chrono>
#include <csignal>
#include <spawn.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <thread>

#include <doctest/doctest.h>

#include "program_runner.hpp"
#include "render/image.hpp"

using namespace taut::test;

namespace {

using namespace std::chrono_literals;
constexpr auto patience = 60s;  // before a test gives up on the program; no more than a moment is ever needed

/// The program itself, in a process of its own that a signal can be sent to.
class Child {
 public:
  explicit Child(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), TAUT_BINARY_DIR "/taut");
    std::vector<char*> raw;
    for (std::string& argument : arguments) raw.push_back(argument.data());
    raw.push_back(nullptr);
    posix_spawn_file_actions_t quiet;
    ::posix_spawn_file_actions_init(&quiet);
    ::posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    const int error = ::posix_spawn(&process_, raw[0], &quiet, nullptr, raw.data(), environ);
    ::posix_spawn_file_actions_destroy(&quiet);
    REQUIRE(error == 0);
  }
  ~Child() {
    if (running_) ::kill(process_, SIGKILL), ::waitpid(process_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void send(int signal) const { ::kill(process_, signal); }

  int exit_code() {
    int status = 0;
    wait([&] { return ::waitpid(process_, &status, WNOHANG) != 0; });
    running_ = false;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  static void wait_for(const fs::path& file) {
    wait([&] { return fs::exists(file); });
  }

 private:
  template <class Condition>
  static void wait(Condition condition) {
    for (auto waited = 0ms; waited < patience; waited += 10ms) {
      if (condition()) return;
      std::this_thread::sleep_for(10ms);
    }
    FAIL("the program does not answer");
  }

  pid_t process_ = 0;
  bool running_ = true;
};

/// A file system of 64 KiB, where that can be had.
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
  TEST_CASE("an interrupt ends a run in good order with exit code 130") {
    for (const int signal : {SIGINT, SIGTERM}) {
      const TemporaryFolder folder;
      // the next output is a thousand seconds away: the interrupt must be seen in between
      Child child(tiny_run(folder, "out", {"--until", "1000", "--frames", "1", "--history", "1000"}));
      Child::wait_for(folder / "out/frames/frame_00000.png");
      child.send(signal);
      CHECK(child.exit_code() == 130);
      const auto record = json_of(folder / "out/run.json");
      CHECK(record["status"] == "interrupted");
      CHECK(record["reached"].get<double>() < 1000);
      // a header, the start, and where it stopped, unless the signal came before the first step
      CHECK(lines_of(folder / "out/history.csv").size() == (record["steps"] > 0 ? 3 : 2));
      CHECK(taut::read_png(folder / "out/frames/frame_00000.png").width == 160);
      CHECK(files_in(folder / "out/frames") == 1);
    }
  }

  TEST_CASE("an interrupted run draws the frames it kept for an automatic range") {
    const TemporaryFolder folder;
    Child child(tiny_run(folder, "out",
                         {"--until", "1000", "--frames", "1", "--history", "1000", "--range", "auto"}));
    Child::wait_for(folder / "out/history.csv");
    child.send(SIGINT);
    CHECK(child.exit_code() == 130);
    CHECK(taut::read_png(folder / "out/frames/frame_00000.png").width == 160);
  }

  TEST_CASE("a second interrupt ends the program and leaves whole files") {
    const TemporaryFolder folder;
    Child child(tiny_run(folder, "out", {"--until", "1000", "--frames", "1"}));
    Child::wait_for(folder / "out/frames/frame_00000.png");
    child.send(SIGINT);
    child.send(SIGTERM);
    CHECK(child.exit_code() == 130);
    CHECK(json_of(folder / "out/run.json").contains("status"));
  }

  TEST_CASE("a run that diverges keeps its output and ends with exit code 3") {
    const TemporaryFolder folder;
    const Outcome outcome = call(tiny_run(folder, "out", {"--set", "cfl=20", "--until", "0.02"}));
    CAPTURE(outcome.err);
    CHECK(outcome.code == 3);
    CHECK(contains(outcome.err, "diverged at t = "));
    CHECK(contains(outcome.err, " s, step "));
    CHECK(contains(outcome.err, "particle"));
    const auto record = json_of(folder / "out/run.json");
    CHECK(record["status"] == "failed");
    CHECK(record["verdict"] == "diverged");
    CHECK(record["since"]["diverged"].get<double>() <= record["reached"].get<double>());
    CHECK(record["reached"].get<double>() < 0.02);
    CHECK(files_in(folder / "out/frames") >= 1);
    CHECK(lines_of(folder / "out/history.csv").size() >= 2);
  }

  TEST_CASE("a verdict is a result unless --fail-on names it") {
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
    CHECK(call(tiny_run(folder, "out", strict)).code == 3);
    strict.back() = "diverged";
    CHECK(call(tiny_run(folder, "out", strict)).code == 0);
  }

  TEST_CASE("output that cannot be written is exit code 4 with the path") {
    const TemporaryFolder folder;
    write_tiny_scene(folder);
    const Outcome outcome = call(tiny_run(folder, "discs.toml/out"));
    CHECK(outcome.code == 4);
    CHECK(contains(outcome.err, folder.str("discs.toml/out")));
  }

  TEST_CASE("a full disk is exit code 4 and what stands there is whole") {
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
      CHECK(taut::read_png(file.path()).width == 640);
    }
  }
}
