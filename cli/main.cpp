#include <csignal>
#include <fcntl.h>
#include <iostream>

#include "cli/command_line/program.hpp"
#include "cli/commands/commands.hpp"

namespace {

/// Opens /dev/null for closed standard streams, so that no file gets their numbers. The mode makes each use an error.
void occupy_closed_streams() {
  for (const int stream : {0, 1, 2})
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY);
}

}  // namespace

int main(int argc, char** argv) {
  occupy_closed_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // exceeding `ulimit -f` is then an error
  return taut::cli::run_program(taut::cli::commands(), {argv + 1, argv + argc}, {std::cout, std::cerr});
}
