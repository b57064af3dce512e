#include <csignal>
#include <sys/mount.h>

#include <doctest/doctest.h>

#include "render/image/png.hpp"
#include "tests/support/child_program.hpp"
#include "tests/support/program_runner.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

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
      ChildProgram child(tiny_run(folder, "out", {"--until", "1000", "--frames", "1", "--history", "1000"}));
      ChildProgram::wait_for(folder / "out/frames/frame_00000.png");
      child.send(signal);
      CHECK(child.exit_code() == 130);
      const auto record = json_of(folder / "out/run.json");
      CHECK(record["status"] == "interrupted");
      CHECK(record["reached"].get<double>() < 1000);
      // a header, the start, and where it stopped, unless the signal came before the first step
      CHECK(lines_of(folder / "out/history.csv").size() == (record["steps"] > 0 ? 3 : 2));
      CHECK(taut::render::read_png(folder / "out/frames/frame_00000.png").width == 160);
      CHECK(files_in(folder / "out/frames") == 1);
    }
  }

  TEST_CASE("an interrupted run draws the frames it kept for an automatic range") {
    const TemporaryFolder folder;
    ChildProgram child(tiny_run(
        folder, "out", {"--until", "1000", "--frames", "1", "--history", "1000", "--range", "auto"}));
    ChildProgram::wait_for(folder / "out/history.csv");
    child.send(SIGINT);
    CHECK(child.exit_code() == 130);
    CHECK(taut::render::read_png(folder / "out/frames/frame_00000.png").width == 160);
  }

  TEST_CASE("a second interrupt ends the program and leaves whole files") {
    const TemporaryFolder folder;
    ChildProgram child(tiny_run(folder, "out", {"--until", "1000", "--frames", "1"}));
    ChildProgram::wait_for(folder / "out/frames/frame_00000.png");
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
      CHECK(taut::render::read_png(file.path()).width == 640);
    }
  }
}
