#include <iostream>

#include <CLI/CLI.hpp>

#include "cli/command.hpp"
#include "cli/exit_code.hpp"
#include "cli/option_checks.hpp"
#include "cli/session_commands.hpp"
#include "cli/text.hpp"
#include "engine/error.hpp"

namespace taut {
namespace {

struct Options : RunOptions {
  bool strict = false;
};

/// The exit code of a line that went wrong, 0 of one that did not; `going` becomes false at the end.
int answer(Session& session, const std::string& line, std::ostream& out, bool& going) {
  const auto fail = [&](const std::string& message, int code) {
    out << "error: " << message << '\n';
    return code;
  };
  try {
    going = run_session_line(session, line, out);
    out << "ok\n";
    return exit_fine;
  } catch (const UsageError& e) {
    return fail(e.what(), exit_wrong_input);
  } catch (const SceneError& e) {
    return fail(e.what(), exit_wrong_input);
  } catch (const NumericalError& e) {
    return fail("the simulation diverged at t = " + brief(e.time) + " s: " + e.what(), exit_diverged);
  } catch (const OutputError& e) {
    return fail(e.path + ": " + e.what(), exit_not_written);
  }
}

int converse(const Options& options, Streams streams) {
  Session session(options);
  std::string line;
  for (bool going = true; going && std::getline(std::cin, line);) {
    const int code = answer(session, line, streams.out, going);
    if (!streams.out.flush()) throw OutputError("standard output", "could not be written");
    if (options.strict && code != exit_fine) return code;
  }
  return exit_fine;
}

}  // namespace

std::function<int(Streams)> declare_session(CLI::App& app) {
  auto options = std::make_shared<Options>();
  app.add_option("SCENE", options->scene, "a name from `taut list scenes`, or the path of a scene file")
      ->option_text(" ")
      ->required();
  declare_setting_options(app, *options);
  declare_drawing_options(app, options->drawing);
  app.add_option("--threads", options->threads, "default: all cores")
      ->option_text("N")
      ->check(positive_whole_number);
  app.add_flag("--strict", options->strict,
               "the first line that is wrong ends the session; exit code 2, 3 or 4");
  return [options](Streams streams) { return converse(*options, streams); };
}

}  // namespace taut
