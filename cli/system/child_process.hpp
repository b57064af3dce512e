#pragma once

#include <functional>
#include <string>
#include <sys/types.h>

namespace taut::cli {

/// Requires a single thread at the fork. The child dies with its parent and ignores Ctrl-C and SIGHUP.
class ChildProcess {
 public:
  /// `work` returns the exit code; the last 64 KiB of its output are kept. Throws UsageError.
  explicit ChildProcess(const std::function<int()>& work);
  ~ChildProcess();  // kills a running child
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Becomes readable when the child prints or ends.
  int descriptor() const { return output_; }
  /// Requires a readable `descriptor`. Returns false after the end of the child.
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
