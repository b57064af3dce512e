#pragma once

#include <functional>
#include <string>
#include <sys/types.h>

namespace taut::cli {

/// Runs a function in a forked process, so that a crash there only gives an exit code. The parent must have one
/// thread. The child dies with its parent, but ignores Ctrl-C and SIGHUP; the parent must call `ask_to_stop`, once.
class ChildProcess {
 public:
  /// `work` returns the exit code; its output is kept. Throws UsageError if no process can be started.
  explicit ChildProcess(const std::function<int()>& work);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Readable on output or end of the child.
  int descriptor() const { return output_; }
  /// Call if `descriptor` is readable. Returns false after the end of the child.
  bool read_output();
  void ask_to_stop() const;

  struct End {
    int code = 0;
    int signal = 0;  // that killed the child, or 0
    std::string output;
  };
  End wait();

 private:
  pid_t process_ = 0;
  int output_ = -1;
  bool running_ = true;
  std::string text_;
};

}  // namespace taut::cli
