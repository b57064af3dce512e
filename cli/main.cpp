#include <csignal>
#include <fcntl.h>
#include <iostream>

#include "cli/command_line/program.hpp"
#include "cli/commands/commands.hpp"

namespace {

/// A file that is opened must not get the number of a stream that the caller has closed: what is printed would
/// end in it. To use such a stream stays an error.
void occupy_closed_streams() {
  for (const int stream : {0, 1, 2})
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY);
}

}  // namespace

int main(int argc, char** argv) {
  occupy_closed_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // what is longer than `ulimit -f` allows is an error, as on a full disk
  return taut::cli::run_program(taut::cli::commands(), {argv + 1, argv + argc}, {std::cout, std::cerr});
}
