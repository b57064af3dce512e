#include "cli/command_line/program.hpp"

#include <algorithm>
#include <ostream>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/command_line/completion.hpp"
#include "cli/system/build_info.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/system/provenance.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

void print_help(std::span<const Command> commands, std::ostream& out) {
  out << "taut " << build_info.version
      << ": simulates elastic solids with smoothed particle hydrodynamics and draws them\n\n"
         "Usage: taut COMMAND [OPTIONS]\n\nCommands:\n";
  for (const Command& c : commands)
    out << "  " << c.name << std::string(15 - c.name.size(), ' ') << c.summary << '\n';
  out << "\nOptions:\n"
         "  --help      show this text; `taut COMMAND --help` shows the options and examples of a command\n"
         "  --version   show version, compiler, libraries and file formats\n\n"
         "Exit codes:\n"
         "  0    success\n"
         "  1    diff, snapshot: pictures differ; check: a check failed; choose: no stored run qualifies;\n"
         "       claims: a claim differs from its recorded state\n"
         "  2    wrong command line or scene\n"
         "  3    the simulation diverged, or its verdict is as bad as --fail-on or worse\n"
         "  4    output could not be written\n"
         "  70   a bug of taut\n"
         "  130  interrupted by Ctrl-C; 143 by SIGTERM, 129 by SIGHUP (128 + number of the signal)\n\n"
         "Environment: TAUT_SCENES lists folders with your own scenes, separated by ':'.\n\n"
         "Example:\n  taut run colliding-rings\n";
}

const Command& find_command(std::span<const Command> all, const std::string& name) {
  const auto found = std::ranges::find(all, name, &Command::name);
  if (found != all.end()) return *found;
  std::vector<std::string> names;
  for (const Command& c : all) names.emplace_back(c.name);
  throw UsageError(unknown_name("command", name, names));
}

int run_command(const Command& command, const std::vector<std::string>& arguments, Streams streams) {
  Options options({.program = "taut " + std::string(command.name),
                   .summary = std::string(command.summary),
                   .examples = std::string(command.examples)});
  const std::function<int(Streams)> action = command.declare(options);
  if (options.read(arguments)) return action(streams);
  streams.out << options.help();
  return exit_fine;
}

int dispatch(std::span<const Command> commands, const std::vector<std::string>& arguments, Streams streams) {
  const std::string first = arguments.empty() ? "" : arguments.front();
  if (first == "--version") {
    streams.out << version_text();
  } else if (first == "--help" || first == "-h" || first == "help") {
    print_help(commands, streams.out);
  } else if (first == "--complete") {
    streams.out << answer_to_shell(commands, {arguments.begin() + 1, arguments.end()});
  } else if (first.empty()) {
    print_help(commands, streams.err);
    return exit_wrong_input;
  } else if (first[0] == '-') {
    throw UsageError(unknown_name("option", first, {"--help", "--version"}));
  } else {
    return run_command(find_command(commands, first), {arguments.begin() + 1, arguments.end()}, streams);
  }
  return exit_fine;
}

}  // namespace

int run_program(std::span<const Command> commands, const std::vector<std::string>& arguments,
                Streams streams) {
  const auto all = [&] {
    const int code = dispatch(commands, arguments, streams);
    if (!streams.out.flush()) throw OutputError("standard output", "cannot be written");
    return code;
  };
  return guarded(all, streams.err);
}

}  // namespace taut::cli
