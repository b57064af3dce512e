#include <atomic>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "cli/system/atomic_file.hpp"
#include "cli/system/external_program.hpp"
#include "engine/error.hpp"
#include "tests/support/files.hpp"

using namespace taut;
using namespace taut::test;

TEST_SUITE("unit") {
  TEST_CASE("many writers of one file each write it completely, and leave no other file") {
    const TemporaryFolder folder;
    const fs::path path = folder / "chart.dat";
    constexpr int writers = 4, times = 200, size = 20'000;
    std::atomic<int> failed = 0, torn = 0;
    const auto whole = [&] {
      const std::string text = text_of(path);
      return text.size() == size && text.find_first_not_of(text[0]) == std::string::npos;
    };
    {
      std::vector<std::jthread> all;
      for (int writer = 0; writer < writers; ++writer)
        all.emplace_back([&, writer] {
          for (int k = 0; k < times; ++k) {
            try {
              cli::write_atomically(path, std::string(size, static_cast<char>('a' + writer)));
            } catch (const OutputError&) {
              ++failed;
            }
            if (!whole()) ++torn;
          }
        });
    }
    CHECK(failed.load() == 0);
    CHECK(torn.load() == 0);
    CHECK(files_in(folder.path()) == 1);
  }

  TEST_CASE("a pipe and a name in /dev receive the text, and are not replaced by a file") {
    const TemporaryFolder folder;
    const fs::path pipe = folder / "pipe";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    CHECK_THROWS_AS(cli::write_atomically(pipe, "unread"), OutputError);
    const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK), writer = ::open(pipe.c_str(), O_WRONLY);
    REQUIRE(writer >= 0);
    char text[8] = {};
    cli::write_atomically(pipe, "named");
    CHECK(::read(reader, text, sizeof text) == 5);
    cli::write_atomically(fmt::format("/dev/fd/{}", writer), "number");
    CHECK(::read(reader, text, sizeof text) == 6);
    CHECK(std::string(text, 6) == "number");
    ::close(reader), ::close(writer);
    CHECK(fs::is_fifo(pipe));
    CHECK(files_in(folder.path()) == 1);
  }

  TEST_CASE("a temporary file left by a killed program is replaced, and a folder in its place is an error") {
    const TemporaryFolder folder;
    const fs::path path = folder / "chart.dat";
    std::ofstream(path.string() + ".tmp") << "left";
    cli::write_atomically(path, "new");
    CHECK(text_of(path) == "new");
    CHECK(files_in(folder.path()) == 1);
    fs::create_directory(path.string() + ".tmp");
    CHECK_THROWS_AS(cli::write_atomically(path, "newer"), OutputError);
    CHECK(text_of(path) == "new");
  }

  TEST_CASE("lines appended after a cut follow the kept lines") {
    const TemporaryFolder folder;
    cli::AppendFile file(folder / "history.csv");
    file.append("kept");
    file.append("removed");
    file.cut(5);
    file.append("new");
    CHECK(text_of(folder / "history.csv") == "kept\nnew\n");
  }

  TEST_CASE("a program that is slower than its time limit is stopped") {
    const TemporaryFolder folder;
    const cli::Interrupts interrupts;
    const auto sleep = [&](const char* time, auto... limit) {
      return cli::run_process({"sleep", time}, folder.path(), interrupts, limit...);
    };
    const cli::ProcessResult slow = sleep("600", std::chrono::seconds{0});
    CHECK(slow.late);
    CHECK(slow.code == 128 + SIGKILL);
    CHECK_FALSE(sleep("0.01", std::chrono::seconds{60}).late);
  }

  TEST_CASE("many callers of a program that makes one file wait for each other") {
    const TemporaryFolder folder;
    const fs::path path = folder / "chart.txt";
    const cli::Maker shell{"sh", "a test", "dash"};
    const auto slowly = [](const fs::path& part) -> std::vector<std::string> {
      return {"-c", "echo begun > \"$0\"; sleep 0.05; echo done >> \"$0\"", part.string()};
    };
    std::vector<pid_t> children;
    for (int k = 0; k < 4; ++k) {
      children.push_back(::fork());
      if (children.back() > 0) continue;
      int code = 1;
      try {
        code = cli::make_file(shell, slowly, folder.path(), path);
      } catch (...) {
      }
      ::_exit(code);
    }
    for (const pid_t child : children) {
      int status = 0;
      ::waitpid(child, &status, 0);
      CHECK(status == 0);
    }
    CHECK(text_of(path) == "begun\ndone\n");
    CHECK(files_in(folder.path()) == 1);
  }
}
