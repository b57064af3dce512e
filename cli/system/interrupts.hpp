#pragma once

#include <atomic>
#include <csignal>

namespace taut::cli {

/// While an object exists, the first Ctrl-C, SIGTERM or SIGHUP only sets a flag, so that a run can stop after its
/// step. SIGHUP comes when the terminal closes. A second signal ends the program at once, except SIGHUP, which shells
/// send twice. SIGPIPE is ignored. Files stay complete in all cases, since each is renamed when it is complete.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  /// While an object exists, the first signal ends the program at once, and an earlier signal ends it here: for long
  /// work that checks no flag and has not written to files yet.
  class ExitOnSignal {
   public:
    ExitOnSignal();
    ~ExitOnSignal();
    ExitOnSignal(const ExitOnSignal&) = delete;
    ExitOnSignal& operator=(const ExitOnSignal&) = delete;
  };

  /// Whether a signal came. Like `must_end`, keeps its value after the object's end, until the next object
  /// exists: callers can check it then without missing a signal.
  static bool interrupted() { return flag() != 0; }
  /// Whether SIGTERM or SIGHUP came: the program must end, not only the command.
  static bool must_end();
  /// 128 + the signal that came.
  static int exit_code();
  /// The signal, or 0; long work can check it.
  static const std::atomic<int>& flag();

 private:
  struct sigaction old_interrupt_ {};
  struct sigaction old_terminate_ {};
  struct sigaction old_hang_up_ {};
  struct sigaction old_pipe_ {};
};

}  // namespace taut::cli
