#include <ostream>

#include <fmt/core.h>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/session/line_input.hpp"
#include "cli/session/session_commands.hpp"
#include "cli/session/session_completion.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/text/checks.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

struct SessionArguments : RunOptions {
  bool strict = false;
};

struct Answer {
  int code = exit_fine;
  bool going = true;
};

/// An answer to a script ends with "ok" or "error: REASON".
Answer answer(Session& session, const std::string& line, const Dialogue& to, bool typed) {
  const auto fail = [&](const std::string& message, int code) {
    to.out << "error: " << message << '\n';
    return Answer{code, true};
  };
  try {
    const bool going = run_session_line(session, line, to);
    if (!typed) to.out << "ok\n";
    return {exit_fine, going};
  } catch (const UsageError& e) {
    return fail(e.what(), exit_wrong_input);
  } catch (const SceneError& e) {
    return fail(e.what(), exit_wrong_input);
  } catch (const NumericalError& e) {
    return fail(fmt::format("the simulation diverged at t = {} s: {}", brief(e.time), e.what()),
                exit_diverged);
  } catch (const OutputError& e) {
    return fail(fmt::format("{}: {}", e.path, e.what()), exit_not_written);
  }
}

void greet(const Session& session, std::ostream& out) {
  out << session.file().scene.title << ", " << session.file().settings.method << ", "
      << session.simulation().snapshot().size()
      << " particles. `help` lists the commands, Tab completes them, Ctrl-D ends the session.\n"
      << std::flush;
}

int converse(const SessionArguments& options, Streams streams) {
  Session session(options);
  print_remark(session.file(), streams.err);
  LineInput input([&](const auto& words) { return session_choices(session, words); });
  const bool typed = input.is_typed();
  Progress progress(streams.err, progress_style(streams.err, !typed));
  if (typed) greet(session, streams.out);
  while (const auto line = input.next()) {
    const Answer given = [&] {
      const Interrupts interrupts;
      const Answer one = answer(session, *line, {streams.out, interrupts, progress}, typed);
      if (!streams.out.flush()) throw OutputError("standard output", "cannot be written");
      return one;
    }();
    // the next lines of a script rely on this one
    if (Interrupts::interrupted() && (!typed || Interrupts::must_end())) return Interrupts::exit_code();
    if (options.strict && given.code != exit_fine) return given.code;
    if (!given.going) break;
  }
  return Interrupts::must_end() ? Interrupts::exit_code() : exit_fine;  // signal at the prompt
}

}  // namespace

std::function<int(Streams)> declare_session(Options& command) {
  auto options = std::make_shared<SessionArguments>();
  command.add_argument("SCENE", options->scene, "a name from `taut list scenes`, or the path of a scene file")
      .required();
  declare_setting_options(command, *options);
  declare_drawing_options(command, options->drawing);
  command
      .add("--threads", "N", options->threads,
           "number of threads; default: all cores, fewer for small scenes")
      .check(positive_whole_number);
  command.add_flag("--strict", options->strict,
                   "end the session at the first error, with exit code 2, 3 or 4");
  return [options](Streams streams) { return converse(*options, streams); };
}

}  // namespace taut::cli
