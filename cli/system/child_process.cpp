#include "cli/system/child_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/core.h>

#include "engine/error.hpp"

namespace taut::cli {
namespace {

[[noreturn]] void fail(int error) {
  throw UsageError(fmt::format("a process cannot be started: {}; use fewer --jobs", std::strerror(error)));
}

sigset_t interrupting_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  sigaddset(&set, SIGHUP);
  return set;
}

/// Throws if the process has several threads: a child would never get locks that other threads hold.
void check_no_threads() {
  std::error_code no_proc;  // threads cannot be counted without /proc
  const std::filesystem::directory_iterator threads("/proc/self/task", no_proc);
  if (!no_proc && std::distance(begin(threads), end(threads)) > 1)
    throw std::logic_error("a process with several threads cannot be forked");
}

/// Called with the interrupting signals blocked; SIGINT and SIGHUP stay blocked.
void prepare_child(pid_t parent, int output) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // the parent ended before prctl
  // SIGTERM ends the child until `work` sets a handler
  std::signal(SIGTERM, SIG_DFL);
  sigset_t terminate;
  sigemptyset(&terminate);
  sigaddset(&terminate, SIGTERM);
  ::sigprocmask(SIG_UNBLOCK, &terminate, nullptr);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
}

}  // namespace

ChildProcess::ChildProcess(const std::function<int()>& work) {
  check_no_threads();
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail(errno);
  std::cout.flush();  // else the child prints it again
  std::cerr.flush();
  const sigset_t blocked = interrupting_signals();
  sigset_t before;
  ::sigprocmask(SIG_BLOCK, &blocked, &before);
  const pid_t parent = ::getpid();
  process_ = ::fork();
  const int error = errno;
  if (process_ == 0) {
    prepare_child(parent, ends[1]);
    const int code = work();
    std::cout.flush();
    std::cerr.flush();
    ::_exit(code);  // no destructors of the parent's objects
  }
  ::sigprocmask(SIG_SETMASK, &before, nullptr);
  ::close(ends[1]);
  output_ = ends[0];
  if (process_ > 0) return;
  ::close(output_);
  fail(error);
}

ChildProcess::~ChildProcess() {
  if (running_) {
    ::kill(process_, SIGKILL);
    wait();
  }
  ::close(output_);
}

bool ChildProcess::read_output() {
  constexpr std::size_t most = 1 << 16;
  std::array<char, 4096> part{};
  const ssize_t taken = ::read(output_, part.data(), part.size());
  if (taken < 0) return errno == EINTR;
  text_.append(part.data(), static_cast<std::size_t>(taken));
  if (text_.size() > most) text_.erase(0, text_.size() - most);
  return taken > 0;
}

void ChildProcess::ask_to_stop() const { ::kill(process_, SIGTERM); }

ChildProcess::End ChildProcess::wait() {
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
  running_ = false;
  return {.code = WIFEXITED(status) ? WEXITSTATUS(status) : 0,
          .signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0,
          .output = text_};
}

}  // namespace taut::cli
