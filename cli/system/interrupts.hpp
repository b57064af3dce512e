#pragma once

#include <atomic>
#include <csignal>

namespace taut::cli {

/// While an object exists, the first Ctrl-C, SIGTERM or SIGHUP only sets a flag, so that a run can stop after its
/// step. A second one ends the program, except SIGHUP, which shells send twice. SIGPIPE is ignored.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  /// While an object exists, a first or earlier signal ends the program: for long work that checks no flag.
  class AtOnce {
   public:
    AtOnce();
    ~AtOnce();
    AtOnce(const AtOnce&) = delete;
    AtOnce& operator=(const AtOnce&) = delete;
  };

  /// Keeps its value until the next object, so that no signal is missed.
  static bool asked() { return flag() != 0; }
  /// By SIGTERM or SIGHUP: the program must end, not only the command.
  static bool asked_to_end();
  /// 128 + signal.
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
