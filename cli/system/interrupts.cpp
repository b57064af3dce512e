#include "cli/system/interrupts.hpp"

#include <unistd.h>

#include "cli/system/exit_code.hpp"

namespace taut::cli {
namespace {

// what a signal handler may touch must live here
volatile std::sig_atomic_t last_signal = 0;

extern "C" void on_signal(int number) {
  if (last_signal) ::_exit(exit_interrupted);
  last_signal = number;
}

}  // namespace

Interrupts::Interrupts() {
  last_signal = 0;
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

bool Interrupts::asked() const { return last_signal != 0; }

bool Interrupts::asked_to_end() const { return last_signal == SIGTERM; }

}  // namespace taut::cli
