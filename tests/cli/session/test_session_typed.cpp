#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>

#include <doctest/doctest.h>

#include "cli/session/session_completion.hpp"
#include "tests/support/child_program.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/terminal_program.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

const std::string up = "\x1b[A", backspace = "\x7f", interrupt = "\x03", end_of_input = "\x04";

/// Distance of `color` from the nearest colour in `shown` (38;2;R;G;B or 48;2;R;G;B), in the channel that differs most.
int nearest_color(const std::string& shown, const std::array<int, 3>& color) {
  int nearest = 255;
  for (std::size_t at = shown.find("8;2;"); at != std::string::npos; at = shown.find("8;2;", at + 1)) {
    std::istringstream text(shown.substr(at + 4, 12));
    int farthest = 0;
    char between = 0;
    for (const int wanted : color) {
      int channel = 0;
      text >> channel >> between;
      farthest = std::max(farthest, std::abs(channel - wanted));
    }
    nearest = std::min(nearest, farthest);
  }
  return nearest;
}

std::vector<std::string> tiny_session(const TemporaryFolder& folder) {
  return {"session", write_tiny_scene(folder), "--threads", "1"};
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("lines typed at a terminal are edited, completed and kept for the next session") {
    const TemporaryFolder folder;
    {
      TerminalProgram program(tiny_session(folder), folder.str("state"));
      program.wait_for("Two discs, enog, ");
      program.wait_for_prompt();
      program.type("ste\t2\r");
      program.wait_for("step=2\r\n");
      CHECK_FALSE(contains(program.wait_for_prompt(), "ok"));
      program.type(up + backspace + "3\r");
      program.wait_for("step=5\r\n");
      program.wait_for_prompt();
      program.type("quit" + interrupt);
      program.wait_for("\n");
      program.wait_for_prompt();
      program.type("colr\r");
      program.wait_for("did you mean 'color'");
      program.wait_for_prompt();
      program.type(end_of_input);
      CHECK(program.exit_code() == 0);
    }
    TerminalProgram program(tiny_session(folder), folder.str("state"));
    program.wait_for_prompt();
    program.type(up + up + "\r");
    program.wait_for("step=3\r\n");
    program.wait_for_prompt();
    program.type("quit\r");
    CHECK(program.exit_code() == 0);
  }

  TEST_CASE("Ctrl-C stops the command of a session, and SIGTERM the session") {
    const TemporaryFolder folder;
    TerminalProgram program(tiny_session(folder), folder.str("state"));
    program.wait_for_prompt();
    program.type("run until 1000\r");
    program.wait_for("to 1000 s [");
    program.type(interrupt);
    program.wait_for("step=");
    program.wait_for_prompt();
    program.type("step 0\r");
    program.wait_for("error: the number of steps is '0'");
    program.wait_for_prompt();
    program.send(SIGTERM);
    CHECK(program.exit_code() == 143);
    TerminalProgram other(tiny_session(folder), folder.str("state"));
    other.wait_for_prompt();
    other.type("run until 1000\r");
    other.wait_for("to 1000 s [");
    other.send(SIGTERM);
    CHECK(other.exit_code() == 143);
  }

  TEST_CASE("an interrupted script does not continue with its next line") {
    const TemporaryFolder folder;
    std::ofstream(folder / "script") << "save " << folder.str("begun") << "\nrun until 1000\nsave "
                                     << folder.str("next") << '\n';
    ChildProgram program(tiny_session(folder), folder.str("script"));
    ChildProgram::wait_for(folder / "begun");
    std::this_thread::sleep_for(50ms);
    program.send(SIGINT);
    CHECK(program.exit_code() == 130);
    CHECK_FALSE(fs::exists(folder / "next"));
  }

  TEST_CASE("preview shows the picture in colours") {
    const TemporaryFolder folder;
    TerminalProgram program(tiny_session(folder), folder.str("state"));
    program.wait_for_prompt();
    program.type("preview\r");
    const std::string shown = program.wait_for("speed 0 to 4 m/s, t = 0 s, x -0.03 to 0.03 m");
    CHECK(std::ranges::count(shown, '\n') >= 21);
    // 2 m/s: the middle of viridis
    CHECK(nearest_color(shown, {33, 145, 140}) <= 2);
    program.type("\rquit\r");
    CHECK(program.exit_code() == 0);
  }

  TEST_CASE("completion in a session offers the commands, and the words that can follow them") {
    const TemporaryFolder folder;
    taut::cli::RunOptions options;
    options.scene = write_tiny_scene(folder);
    options.threads = 1;
    const taut::cli::Session session(options);
    const auto words = [&](const std::vector<std::string>& line) {
      return taut::cli::session_choices(session, line).words;
    };
    using Words = std::vector<std::string>;
    const Words commands = words({""});
    CHECK(std::ranges::count(commands, "preview") == 1);
    CHECK(words({"help", ""}) == commands);
    CHECK(words({"run", ""}) == Words{"until"});
    CHECK(words({"run", "until", ""}).empty());
    CHECK(words({"range", ""}) == Words{"auto"});
    CHECK(words({"view", ""}) == Words{"pan", "zoom", "fit"});
    CHECK(words({"view", "zoom", ""}).empty());
    CHECK(words({"probe", ""}) == Words{"gap"});
    CHECK(words({"probe", "gap", ""}) == Words{"gap"});
    CHECK(std::ranges::count(words({"color", ""}), "pressure") == 1);
    CHECK(std::ranges::count(words({"colormap", ""}), "viridis") == 1);
    const Words constants = words({"set", ""});
    CHECK(std::ranges::count(constants, "method.zeta=") == 1);
    CHECK(std::ranges::count(constants, "cfl=") == 1);
    CHECK(std::ranges::count(constants, "speed=") == 0);
    CHECK(std::ranges::count(constants, "method.h=") == 0);
    CHECK(taut::cli::session_choices(session, {"save", ""}).files == "*");
    CHECK(taut::cli::session_choices(session, {"frame", ""}).files == "*.png");
    CHECK(words({"nothing", ""}).empty());
  }
}
