#pragma once

#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <doctest/doctest.h>

namespace taut::test {

using namespace std::chrono_literals;
inline constexpr auto patience = 60s;

class ChildProgram {
 public:
  /// `input`: file for standard input.
  explicit ChildProgram(std::vector<std::string> arguments, const std::string& input = "/dev/null") {
    arguments.insert(arguments.begin(), TAUT_BINARY_DIR "/taut");
    std::vector<char*> raw;
    for (std::string& argument : arguments) raw.push_back(argument.data());
    raw.push_back(nullptr);
    posix_spawn_file_actions_t quiet;
    ::posix_spawn_file_actions_init(&quiet);
    ::posix_spawn_file_actions_addopen(&quiet, STDIN_FILENO, input.c_str(), O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    const int error = ::posix_spawn(&process_, raw[0], &quiet, nullptr, raw.data(), environ);
    ::posix_spawn_file_actions_destroy(&quiet);
    REQUIRE(error == 0);
  }
  ~ChildProgram() {
    if (running_) ::kill(process_, SIGKILL), ::waitpid(process_, nullptr, 0);
  }
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;

  pid_t process() const { return process_; }
  void send(int signal) const { ::kill(process_, signal); }

  int exit_code() {
    int status = 0;
    wait([&] { return ::waitpid(process_, &status, WNOHANG) != 0; });
    running_ = false;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  bool has_ended() const {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid != 0;
  }
  /// Signal that ended the program, or 0.
  int ending_signal() {
    int status = 0;
    wait([&] { return ::waitpid(process_, &status, WNOHANG) != 0; });
    running_ = false;
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  }

  static void wait_for(const std::filesystem::path& file) {
    wait([&] { return std::filesystem::exists(file); });
  }

  template <class Condition>
  static void wait(Condition condition) {
    for (auto waited = 0ms; waited < patience; waited += 1ms) {
      if (condition()) return;
      std::this_thread::sleep_for(1ms);
    }
    FAIL("waited 60 s in vain for the program");
  }

 private:
  pid_t process_ = 0;
  bool running_ = true;
};

}  // namespace taut::test
