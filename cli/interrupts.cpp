#include "cli/interrupts.hpp"

#include <unistd.h>

#include "cli/exit_code.hpp"

namespace taut {
namespace {

// what a signal handler may touch must live here
volatile std::sig_atomic_t signals = 0;

extern "C" void on_signal(int) {
  if (signals) ::_exit(exit_interrupted);
  signals = 1;
}

}  // namespace

Interrupts::Interrupts() {
  signals = 0;
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  ::sigaction(SIGINT, &action, &old_interrupt_);
  ::sigaction(SIGTERM, &action, &old_terminate_);
}

Interrupts::~Interrupts() {
  ::sigaction(SIGINT, &old_interrupt_, nullptr);
  ::sigaction(SIGTERM, &old_terminate_, nullptr);
}

bool Interrupts::asked() const { return signals != 0; }

}  // namespace taut
