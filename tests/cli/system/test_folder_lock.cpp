#include <atomic>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iostream>
#include <memory>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <doctest/doctest.h>

#include "cli/system/folder_lock.hpp"
#include "engine/error.hpp"
#include "tests/support/program_runner.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

using Of = FolderLock::Of;

/// Empty on success.
std::string refusal(const fs::path& folder, Of of) {
  std::ostringstream err;
  try {
    const FolderLock lock(folder, of, "taut test", err);
    return err.str();
  } catch (const UsageError& e) {
    return e.what();
  }
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a folder is locked once, by any path, and the message names the holder") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "run");
    fs::create_directory_symlink(folder / "run", folder / "link");
    {
      std::ostringstream err;
      const FolderLock lock(folder / "run", Of::run, "taut tést", err);
      for (const char* path : {"run", "link", "run/../run", "link/"}) {
        const std::string said = refusal(folder / path, Of::run);
        CAPTURE(said);
        CHECK(contains(said, path + std::string("' is in use by `taut tést` (process ")));
        CHECK(contains(said, " " + std::to_string(::getpid()) + " on "));
        CHECK(contains(said, ", since 20"));
        CHECK(said.ends_with("); wait until it ends, or name another folder"));
      }
    }
    CHECK(refusal(folder / "run", Of::run).empty());
    CHECK(files_in(folder / "run") == 0);
  }

  TEST_CASE("a sweep is locked as a whole or in parts") {
    const TemporaryFolder folder;
    std::ostringstream err;
    {
      const FolderLock one(folder.path(), Of::part_of_sweep, "taut sweep", err);
      const FolderLock other(folder.path(), Of::part_of_sweep, "taut sweep", err);
      CHECK(contains(refusal(folder.path(), Of::sweep), "is in use"));
    }
    const FolderLock all(folder.path(), Of::sweep, "taut sweep", err);
    CHECK(contains(refusal(folder.path(), Of::sweep), "in use by `taut sweep`"));
    CHECK(contains(refusal(folder.path(), Of::part_of_sweep), "in use by `taut sweep`"));
    CHECK(refusal(folder.path(), Of::run).empty());
  }

  TEST_CASE("the lock of a killed process does not block the next lock") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "run");
    const pid_t child = ::fork();
    if (child == 0) {
      new FolderLock(folder / "run", Of::run, "taut test", std::cerr);
      ::raise(SIGKILL);
    }
    ::waitpid(child, nullptr, 0);
    CHECK(contains(text_of(folder / "run/run.lock"), "\n" + std::to_string(child) + "\n"));
    CHECK(refusal(folder / "run", Of::run).empty());
    CHECK(files_in(folder / "run") == 0);
  }

  TEST_CASE("only one of many threads at a time locks a folder that does not exist yet") {
    const TemporaryFolder folder;
    std::atomic<int> holders = 0, most = 0, turns = 0;
    const auto come = [&] {
      for (int k = 0; k < 50; ++k) {
        try {
          std::ostringstream err;
          const FolderLock lock(folder / "a/b", Of::run, "taut test", err);
          most = std::max(most.load(), ++holders);
          std::this_thread::sleep_for(std::chrono::microseconds(20));
          --holders;
          ++turns;
        } catch (const UsageError&) {
        }
      }
    };
    {
      std::vector<std::jthread> all;
      for (int k = 0; k < 4; ++k) all.emplace_back(come);
    }
    CHECK(most == 1);
    CHECK(turns > 50);
  }

  TEST_CASE("a folder created by a lock is removed if it is empty, and an existing one stays") {
    const TemporaryFolder folder;
    std::ostringstream err;
    {
      const FolderLock lock(folder / "a/b", Of::run, "taut test", err);
      std::ofstream(folder / "a/b/run.json") << "{}";
    }
    CHECK(files_in(folder / "a/b") == 1);
    refusal(folder / "c/d", Of::run);
    CHECK_FALSE(fs::exists(folder / "c"));
    fs::create_directory(folder / "empty");
    refusal(folder / "empty", Of::run);
    CHECK(fs::exists(folder / "empty"));
  }

  TEST_CASE("a link or a pipe in place of a lock file is refused, and its target stays untouched") {
    const TemporaryFolder folder;
    std::ofstream(folder / "precious") << "precious";
    for (const char* kind : {"symbolic", "hard", "fifo"}) {
      CAPTURE(kind);
      const fs::path run = folder / kind;
      fs::create_directory(run);
      if (kind == std::string("symbolic")) fs::create_symlink(folder / "precious", run / "run.lock");
      if (kind == std::string("hard")) fs::create_hard_link(folder / "precious", run / "run.lock");
      if (kind == std::string("fifo")) REQUIRE(::mkfifo((run / "run.lock").c_str(), 0600) == 0);
      CHECK_THROWS_AS(refusal(run, Of::run), OutputError);
      CHECK(text_of(folder / "precious") == "precious");
    }
  }
}
