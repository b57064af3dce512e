#include "cli/system/interrupts.hpp"

#include <unistd.h>

#include "cli/system/exit_code.hpp"

namespace taut::cli {
namespace {

// the handler uses no other state
std::atomic<int> last_signal = 0;
std::atomic<bool> at_once = false;
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

extern "C" void on_signal(int number) {
  if (at_once.load()) {
    // ends a progress line
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, "\n", 1);
    ::_exit(exit_by_signal(number));
  }
  if (last_signal.load() == 0)
    last_signal.store(number);
  else if (number != SIGHUP)
    ::_exit(exit_by_signal(number));
}

}  // namespace

Interrupts::Interrupts() {
  last_signal.store(0);
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  ::sigaction(SIGINT, &action, &old_interrupt_);
  ::sigaction(SIGTERM, &action, &old_terminate_);
  ::sigaction(SIGHUP, nullptr, &old_hang_up_);
  if (old_hang_up_.sa_handler != SIG_IGN) ::sigaction(SIGHUP, &action, nullptr);  // ignored under nohup
  action.sa_handler = SIG_IGN;
  ::sigaction(SIGPIPE, &action, &old_pipe_);
}

Interrupts::~Interrupts() {
  ::sigaction(SIGINT, &old_interrupt_, nullptr);
  ::sigaction(SIGTERM, &old_terminate_, nullptr);
  ::sigaction(SIGHUP, &old_hang_up_, nullptr);
  ::sigaction(SIGPIPE, &old_pipe_, nullptr);
}

Interrupts::ExitOnSignal::ExitOnSignal() {
  at_once.store(true);
  if (interrupted()) ::_exit(exit_code());
}
Interrupts::ExitOnSignal::~ExitOnSignal() { at_once.store(false); }

bool Interrupts::must_end() { return flag() == SIGTERM || flag() == SIGHUP; }

int Interrupts::exit_code() { return exit_by_signal(flag()); }

const std::atomic<int>& Interrupts::flag() { return last_signal; }

}  // namespace taut::cli
