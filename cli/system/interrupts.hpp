#pragma once

#include <atomic>
#include <csignal>

namespace taut::cli {

/// While it lives, the first Ctrl-C, SIGTERM or SIGHUP (the terminal is closed) only sets a flag, so that a run
/// can stop in good order; a second one ends the program at once, but for SIGHUP, which shells send twice. Files
/// stay whole either way: each is written beside and renamed. A reader of its streams that goes away does not
/// end it.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  /// While it lives, already the first ends the program, and one that has come before ends it here: for work
  /// that takes long, looks at no flag, and has touched no file yet.
  class AtOnce {
   public:
    AtOnce();
    ~AtOnce();
    AtOnce(const AtOnce&) = delete;
    AtOnce& operator=(const AtOnce&) = delete;
  };

  /// Both keep what they say when it has gone, until there is a new one: who looks only before that misses
  /// the signal that comes meanwhile.
  static bool asked() { return flag() != 0; }
  /// By SIGTERM or SIGHUP: all is to end, not only what is going on.
  static bool asked_to_end();
  /// 128 + the signal that asked.
  static int exit_code();
  /// The signal, or 0; for whoever is to stop in the middle of a long piece of work.
  static const std::atomic<int>& flag();

 private:
  struct sigaction old_interrupt_ {};
  struct sigaction old_terminate_ {};
  struct sigaction old_hang_up_ {};
  struct sigaction old_pipe_ {};
};

}  // namespace taut::cli
