#include <map>
#include <memory>
#include <set>
#include <sys/wait.h>
#include <thread>

#include <doctest/doctest.h>

#include "cli/system/folder_lock.hpp"
#include "tests/support/child_program.hpp"
#include "tests/support/program_runner.hpp"

using namespace taut::test;

namespace {

Outcome watched(const std::vector<std::string>& arguments, const std::string& setting) {
  const TemporaryFolder streams;
  std::string command =
      setting + " TAUT_FSYNC=on ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD='" TAUT_FILE_CALLS_LIBRARY
                "' '" TAUT_BINARY_DIR "/taut'";
  for (const std::string& argument : arguments) command += " '" + argument + "'";
  const int status = std::system((command + " >" + streams.str("out") + " 2>" + streams.str("err")).c_str());
  return {WEXITSTATUS(status), text_of(streams / "out"), text_of(streams / "err")};
}

/// Replays a log of calls to find files that a power cut could lose.
class Disk {
 public:
  explicit Disk(const fs::path& log) {
    for (const std::string& line : lines_of(log)) {
      std::istringstream text(line);
      std::string call, path, other;
      std::getline(text, call, '\t');
      std::getline(text, path, '\t');
      std::getline(text, other, '\t');
      take(call, path, other);
    }
  }

  /// By new name, for each renaming: true if all files (`itself_before`: the renamed file) were on disk before.
  std::map<std::string, std::vector<bool>> all_before, itself_before;
  std::set<std::string> lacking;  // not on disk at the end

 private:
  void take(const std::string& call, const std::string& path, const std::string& other) {
    if (call == "write") lacking.insert(path);
    if (call == "sync") lacking.erase(path);
    if (call != "rename") return;
    const fs::path to = other;
    // PNG files are written by fwrite, which is not logged
    const bool itself = !lacking.contains(path) && to.extension() != ".png";
    lacking.erase(path);
    itself_before[to.filename()].push_back(itself);
    all_before[to.filename()].push_back(itself && lacking.empty());
    if (!itself) lacking.insert(other);
    lacking.insert(to.parent_path());
  }
};

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("files needed by a checkpoint or a finished run are on disk before checkpoint.bin and run.json") {
    for (const std::string range : {"0:4", "auto"}) {  // drawn during the run, or at its end
      CAPTURE(range);
      const TemporaryFolder folder;
      const Outcome outcome = watched(tiny_run(folder, "out",
                                               {"--checkpoint-every", "0.0005", "--save-particles",
                                                "--history", "1e-4", "--range", range}),
                                      "TAUT_FILE_CALLS=" + folder.str("calls"));
      CAPTURE(outcome.err);
      REQUIRE(outcome.code == 0);
      const Disk disk(folder / "calls");
      // an empty checkpoint at the start, then one after each quarter of the run but the last
      const std::vector<bool>& checkpoints = disk.all_before.at("checkpoint.bin");
      CHECK(checkpoints.size() >= 4);
      CHECK(checkpoints == std::vector<bool>(checkpoints.size(), true));
      CHECK(disk.all_before.at("run.json").back());
      for (const auto name : {"run.json", "scene.toml"})
        for (const bool itself : disk.itself_before.at(name)) CHECK(itself);
      CHECK(disk.itself_before.contains("frame_00004.png"));
      for (const std::string& path : disk.lacking) FAIL_CHECK(path);
    }
  }

  TEST_CASE("the results of a sweep and a baseline are on disk before they get their names") {
    const TemporaryFolder folder;
    const std::string calls = "TAUT_FILE_CALLS=" + folder.str("calls"), scene = write_tiny_scene(folder);
    REQUIRE(
        watched({"sweep", scene, "--grid", "speed=1", "--out", folder.str("sweep"), "--quiet"}, calls).code ==
        0);
    REQUIRE(watched({"snapshot", scene, "--baseline", folder.str("good"), "--update", "--out",
                     folder.str("out"), "--threads", "1", "--quiet"},
                    calls)
                .code == 0);
    const Disk disk(folder / "calls");
    for (const auto name : {"results.csv", "results.json", "good"})
      for (const bool itself : disk.itself_before.at(name)) CHECK(itself);
    for (const std::string& path : disk.lacking) FAIL_CHECK(path);
  }

  TEST_CASE("on a file system without locks a run warns and continues") {
    const TemporaryFolder folder;
    const Outcome outcome = watched(tiny_run(folder, "out", {"--no-render"}), "TAUT_NO_LOCKS=1");
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.err, "out' is on a file system without locks; make sure that no other taut"));
    CHECK_FALSE(fs::exists(folder / "out/run.lock"));
  }

  TEST_CASE(
      "a run that cannot lock its temporary file fails, and removes the file only if the run created it") {
    const TemporaryFolder folder;
    const Outcome outcome = watched(tiny_run(folder, "out", {"--no-render"}), "TAUT_LOCKED=1");
    CHECK(outcome.code == 4);
    CHECK(contains(outcome.err, "run.json: cannot be written: another process has locked it for a minute"));
    CHECK_FALSE(fs::exists(folder / "out/run.json.tmp"));
    fs::create_directories(folder / "out");
    std::ofstream(folder / "out/run.json.tmp") << "of the other process";
    CHECK(watched(tiny_run(folder, "out", {"--no-render"}), "TAUT_LOCKED=1").code == 4);
    CHECK(fs::exists(folder / "out/run.json.tmp"));
  }

  TEST_CASE("a lock on a lock file that another process has just removed does not count") {
    const TemporaryFolder folder;
    std::ostringstream err;
    const auto take = [&] {
      return std::make_unique<taut::cli::FolderLock>(folder / "out", taut::cli::FolderLock::Of::run,
                                                     "taut test", err);
    };
    auto first = take();
    Outcome outcome;
    std::jthread other(
        [&] { outcome = watched(tiny_run(folder, "out"), "TAUT_GATE=" + folder.str("gate")); });
    ChildProgram::wait_for(folder / "gate");
    first.reset();
    const auto second = take();
    fs::remove(folder / "gate");
    other.join();
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "in use by `taut test`"));
    CHECK(files_in(folder / "out") == 1);
  }
}
