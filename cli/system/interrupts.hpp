#pragma once

#include <atomic>
#include <csignal>

namespace taut::cli {

/// While an object exists, the first Ctrl-C, SIGTERM or SIGHUP only sets a flag. A second signal ends the program,
/// except SIGHUP, which shells send twice. SIGPIPE is ignored.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  /// The first signal ends the program: for long work that checks no flag and writes no files.
  class ExitOnSignal {
   public:
    ExitOnSignal();
    ~ExitOnSignal();
    ExitOnSignal(const ExitOnSignal&) = delete;
    ExitOnSignal& operator=(const ExitOnSignal&) = delete;
  };

  /// The flag survives the destructor.
  static bool interrupted() { return flag() != 0; }
  /// SIGTERM or SIGHUP: the program must end, not only the command.
  static bool must_end();
  static int exit_code();
  /// The signal, or 0.
  static const std::atomic<int>& flag();

 private:
  struct sigaction old_interrupt_ {};
  struct sigaction old_terminate_ {};
  struct sigaction old_hang_up_ {};
  struct sigaction old_pipe_ {};
};

}  // namespace taut::cli
