#pragma once

#include <csignal>
#include <poll.h>
#include <pty.h>
#include <string>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>
#include <vector>

#include <doctest/doctest.h>

namespace taut::test {

/// Runs taut on a pseudo-terminal of 80 × 24 characters.
class TerminalProgram {
 public:
  /// `state`: folder for history and other state.
  TerminalProgram(std::vector<std::string> arguments, const std::string& state) {
    arguments.insert(arguments.begin(), TAUT_BINARY_DIR "/taut");
    std::vector<std::string> variables{"TERM=xterm-256color", "COLORTERM=truecolor", "LC_ALL=C.UTF-8",
                                       "MESA_SHADER_CACHE_DISABLE=true", "XDG_STATE_HOME=" + state};
    const std::vector<char*> argv = pointers(arguments), environment = pointers(variables);
    const winsize size{24, 80, 0, 0};
    process_ = ::forkpty(&terminal_, nullptr, nullptr, &size);
    REQUIRE(process_ >= 0);
    if (process_ > 0) return;
    ::execve(argv[0], argv.data(), environment.data());
    ::_exit(127);
  }
  ~TerminalProgram() {
    if (running_) ::kill(process_, SIGKILL), ::waitpid(process_, nullptr, 0);
    ::close(terminal_);
  }
  TerminalProgram(const TerminalProgram&) = delete;
  TerminalProgram& operator=(const TerminalProgram&) = delete;

  void send(int signal) const { ::kill(process_, signal); }
  void type(const std::string& keys) const {
    REQUIRE(::write(terminal_, keys.data(), keys.size()) == static_cast<ssize_t>(keys.size()));
  }
  /// Returns the output up to the end of `text`.
  std::string wait_for(const std::string& text) {
    while (shown_.find(text) == std::string::npos) {
      CAPTURE(shown_);
      CAPTURE(text);
      REQUIRE(read());
    }
    const std::size_t end = shown_.find(text) + text.size();
    const std::string before = shown_.substr(0, end);
    shown_.erase(0, end);
    return before;
  }
  /// Also waits for raw mode, which is set a moment later.
  std::string wait_for_prompt() {
    const std::string shown = wait_for("> ");
    termios mode{};
    do {
      ::usleep(1000);
      REQUIRE(::tcgetattr(terminal_, &mode) == 0);
    } while (mode.c_lflag & ICANON);
    return shown;
  }
  int exit_code() {
    while (read()) {
    }
    int status = 0;
    ::waitpid(process_, &status, 0);
    running_ = false;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  static std::vector<char*> pointers(std::vector<std::string>& words) {
    std::vector<char*> all;
    for (std::string& word : words) all.push_back(word.data());
    all.push_back(nullptr);
    return all;
  }
  /// False at the end of the output, or after a long silence.
  bool read() {
    constexpr int patience = 20'000;  // ms
    pollfd ready{terminal_, POLLIN, 0};
    if (::poll(&ready, 1, patience) <= 0) return false;
    char text[4096];
    const ssize_t count = ::read(terminal_, text, sizeof text);
    if (count <= 0) return false;
    shown_.append(text, static_cast<std::size_t>(count));
    return true;
  }

  pid_t process_ = 0;
  int terminal_ = -1;
  std::string shown_;
  bool running_ = true;
};

}  // namespace taut::test
