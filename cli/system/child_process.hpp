#pragma once

#include <functional>
#include <string>
#include <sys/types.h>

namespace taut::cli {

/// Runs a function in a forked process, so that a crash or signal there only gives an exit code. The parent must have
/// a single thread at the fork. The child dies with its parent. It ignores Ctrl-C and SIGHUP: the parent must pass
/// them on, once, by `ask_to_stop`.
class ChildProcess {
 public:
  /// `work` returns the exit code; its output is kept. Throws UsageError if no process can be started.
  explicit ChildProcess(const std::function<int()>& work);
  ~ChildProcess();  // kills a running child
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Becomes readable when the child prints or ends.
  int descriptor() const { return output_; }
  /// Reads the available output; call only when `descriptor` is readable. Returns false after the end of the child.
  bool read_output();
  /// Sends SIGTERM.
  void ask_to_stop() const;

  struct End {
    int code = 0;    // returned by `work`
    int signal = 0;  // that killed the child, or 0
    std::string output;
  };
  /// Waits for the end of the child.
  End wait();

 private:
  pid_t process_ = 0;
  int output_ = -1;
  bool running_ = true;
  std::string text_;
};

}  // namespace taut::cli
