#include "cli/command_line/program.hpp"

#include <algorithm>
#include <ostream>

#include <CLI/CLI.hpp>

#include "cli/command_line/command.hpp"
#include "cli/command_line/completion.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

void print_help(std::span<const Command> commands, std::ostream& out) {
  out << "taut " TAUT_VERSION
         ": simulates elastic solids with smoothed particle hydrodynamics and draws them\n\n"
         "Usage: taut COMMAND [OPTIONS]\n\nCommands:\n";
  for (const Command& c : commands)
    out << "  " << c.name << std::string(15 - c.name.size(), ' ') << c.summary << '\n';
  out << "\nOptions:\n"
         "  --help      show this text; `taut COMMAND --help` shows the options and examples of a command\n"
         "  --version   show the version of the program\n\n"
         "Exit codes:\n"
         "  0    success\n"
         "  1    diff, snapshot: pictures differ; check: a check failed; choose: no run is accurate enough;\n"
         "       other commands: a bug of taut\n"
         "  2    wrong command line or scene\n"
         "  3    the simulation diverged, or its verdict is as bad as --fail-on or worse\n"
         "  4    output could not be written\n"
         "  130  interrupted\n\n"
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

/// CLI11 leaves what it does not know in `remaining`, and puts no nearest names into its own message.
void refuse_unknown(const CLI::App& app) {
  std::vector<std::string> rest = app.remaining();
  std::erase(rest, "--");  // what follows is no option, whatever it begins with
  const auto dashed = [](const std::string& word) { return word.size() > 1 && word[0] == '-'; };
  const auto option = std::ranges::find_if(rest, dashed);
  if (option != rest.end()) {
    std::vector<std::string> names;
    for (const CLI::Option* o : app.get_options())
      for (const std::string& name : o->get_lnames()) names.push_back("--" + name);
    const std::string name = option->substr(0, option->find('='));
    if (std::ranges::find(names, name) != names.end())
      throw UsageError("'" + name +
                       "' follows '--', after which options are not allowed; put it before '--'");
    throw UsageError(unknown_name("option", name, names));
  }
  if (!rest.empty()) throw UsageError("'" + rest.front() + "' is one argument too many; remove it");
}

/// Of the options that take several words, the one that took more than one; nullptr if none did.
const CLI::Option* greedy_option(const CLI::App& app) {
  for (const CLI::Option* o : app.get_options())
    if (!o->get_positional() && o->get_items_expected_max() > 1 && o->count() > 1) return o;
  return nullptr;
}

/// CLI11 speaks of "1 required FLOAT missing".
std::string what_is_wrong(const CLI::App& app, const CLI::ParseError& e) {
  const std::string text = e.what();
  if (const CLI::Option* taker = greedy_option(app); taker && dynamic_cast<const CLI::RequiredError*>(&e))
    return text + ": " + taker->get_name() + " takes all words that follow it; put the argument before it";
  if (!dynamic_cast<const CLI::ArgumentMismatch*>(&e)) return text;
  const bool too_many = text.find("received") != std::string::npos;
  return text.substr(0, text.find(':')) + (too_many ? " can be given only once" : " needs a value");
}

int run_command(const Command& command, const std::vector<std::string>& arguments, Streams streams) {
  CLI::App app{std::string(command.summary), "taut " + std::string(command.name)};
  app.allow_extras();
  app.set_help_flag("--help,-h", "show this text");
  app.footer("Examples:\n" + std::string(command.examples));
  app.get_formatter()->column_width(26);
  const std::function<int(Streams)> action = command.declare(app);
  try {
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
    app.parse(reversed);
    refuse_unknown(app);
  } catch (const CLI::CallForHelp&) {
    streams.out << app.help();
    return exit_fine;
  } catch (const CLI::ParseError& e) {
    refuse_unknown(app);  // a misspelt option is the better explanation of "SCENE is required"
    throw UsageError(what_is_wrong(app, e) + "; see `taut " + std::string(command.name) + " --help`");
  }
  return action(streams);
}

int dispatch(std::span<const Command> commands, const std::vector<std::string>& arguments, Streams streams) {
  const std::string first = arguments.empty() ? "" : arguments.front();
  if (first == "--version") {
    streams.out << "taut " TAUT_VERSION "\n";
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
