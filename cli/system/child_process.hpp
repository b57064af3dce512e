#pragma once

#include <functional>
#include <string>
#include <sys/types.h>

namespace taut::cli {

/// Work in a process of its own, so that a crash there or a signal to it is no more than an exit code here.
/// It is forked and goes on in this program, which must not have a second thread then.
///
/// The child dies with its parent, however that ends. It does not see a Ctrl-C of the terminal, nor its end: they
/// are the parent's to pass on, once, with `ask_to_stop`.
class ChildProcess {
 public:
  /// `work` returns the exit code; what it prints is kept. Throws UsageError when the system has no room for
  /// another process.
  explicit ChildProcess(const std::function<int()>& work);
  ~ChildProcess();  // kills a child that is still at work
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Readable when the child has printed something or has ended.
  int descriptor() const { return output_; }
  /// Takes what is there to read, to be called when there is; false: the child has ended.
  bool read_output();
  /// SIGTERM.
  void ask_to_stop() const;

  struct End {
    int code = 0;    // as returned by `work`
    int signal = 0;  // that killed it; 0: none did
    std::string output;
  };
  /// Waits for the end.
  End wait();

 private:
  pid_t process_ = 0;
  int output_ = -1;
  bool running_ = true;
  std::string text_;
};

}  // namespace taut::cli
