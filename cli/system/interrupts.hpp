#pragma once

#include <csignal>

namespace taut::cli {

/// While it lives, the first Ctrl-C (or SIGTERM) only sets a flag, so that a run can stop in good order; the
/// second ends the program at once. Files stay whole either way: each is written beside and renamed.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  bool asked() const;
  /// It was SIGTERM: all is to end, not only what is going on.
  bool asked_to_end() const;

 private:
  struct sigaction old_interrupt_ {};
  struct sigaction old_terminate_ {};
};

}  // namespace taut::cli
