#include <iostream>
#include <map>
#include <sstream>

#include <doctest/doctest.h>

#include "cli/run/checkpoint.hpp"
#include "cli/session/session.hpp"
#include "cli/text/format.hpp"
#include "tests/support/program_runner.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

Outcome session(const TemporaryFolder& folder, const std::string& script,
                const std::vector<std::string>& more = {}) {
  std::istringstream input(script);
  std::streambuf* const before = std::cin.rdbuf(input.rdbuf());
  std::cin.clear();
  std::vector<std::string> arguments{"session", write_tiny_scene(folder), "--threads", "1"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome outcome = call(arguments);
  std::cin.rdbuf(before);
  return outcome;
}

Session session_of(const std::string& scene) {
  RunOptions options;
  options.scene = scene;
  options.threads = 1;
  return Session(options);
}

void write_scene_with_table(const TemporaryFolder& folder) {
  std::ofstream(folder / "gap.csv") << "t,gap\n0,0.002\n0.002,0\n";
  std::ofstream(write_tiny_scene(folder), std::ios::app) << reference_of_gap("gap.csv");
}

std::vector<std::string> lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> all;
  for (std::string line; std::getline(stream, line);) all.push_back(line);
  return all;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a frame of a session equals the frame of a run at the same time") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "out")).code == 0);
    const Outcome outcome = session(folder, "run until 0.0005\nframe " + folder.str("one.png") +
                                                "\nrun until 0.002\nframe " + folder.str("four.png") + "\n");
    CAPTURE(outcome.out);
    CHECK(outcome.code == 0);
    CHECK(text_of(folder / "one.png") == text_of(folder / "out/frames/frame_00001.png"));
    CHECK(text_of(folder / "four.png") == text_of(folder / "out/frames/frame_00004.png"));
  }

  TEST_CASE("colour, range, map and view of a session give the same picture as the options of run") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "out",
                          {"--color", "pressure", "--range", "-1000:2000", "--colormap", "rainbow", "--view",
                           "-0.01:0.03:-0.02:0.01"}))
                .code == 0);
    const Outcome outcome = session(folder,
                                    "color pressure\nrange -1000 2000\ncolormap rainbow\n"
                                    "view -0.02 0.02 -0.02 0.01\nview pan 0.01 0\nframe " +
                                        folder.str("start.png") + "\n",
                                    {"--strict"});
    CAPTURE(outcome.out);
    CHECK(outcome.code == 0);
    CHECK(text_of(folder / "start.png") == text_of(folder / "out/frames/frame_00000.png"));
  }

  TEST_CASE("zoom and fit change the picture, and zooming back restores it") {
    const TemporaryFolder folder;
    const auto file = [&](const char* name) { return folder.str(name); };
    const Outcome outcome =
        session(folder, "frame " + file("a.png") + "\nview zoom 2\nframe " + file("b.png") +
                            "\nview zoom 0.5\nframe " + file("c.png") + "\nview fit\nframe " + file("d.png"));
    CAPTURE(outcome.out);
    CHECK(text_of(folder / "a.png") == text_of(folder / "c.png"));
    CHECK(text_of(folder / "a.png") != text_of(folder / "b.png"));
    CHECK(text_of(folder / "a.png") != text_of(folder / "d.png"));
  }

  TEST_CASE("a session that follows another body shows it in full, and keeps a later view") {
    const TemporaryFolder folder;
    const auto drawn = [&](const std::string& script) {
      const Outcome outcome = session(folder, script + "\nframe " + folder.str("f.png"), {"--strict"});
      REQUIRE_MESSAGE(outcome.code == 0, outcome.out);
      return text_of(folder / "f.png");
    };
    const std::string fit = drawn("follow left\nview fit"), view = "\nview -0.03 0.01 -0.02 0.02";
    CHECK(drawn("follow left") == fit);
    CHECK(drawn("view pan 0.01 0\nfollow left") == fit);
    CHECK(drawn("follow left\nfollow none") == drawn("view fit"));
    const std::string chosen = drawn("follow left" + view);
    CHECK(chosen != fit);
    CHECK(drawn("follow left" + view + "\nfollow left") == chosen);
  }

  TEST_CASE("a session continues from a saved state with the same results") {
    const TemporaryFolder folder;
    const std::string file = folder.str("state.bin");
    const std::string straight = session(folder, "step 40\nprobe\n").out;
    const Outcome outcome =
        session(folder, "step 25\nsave " + file + "\nstep 9\nload " + file + "\nstep 15\nprobe\n");
    CAPTURE(outcome.out);
    CHECK(outcome.out.ends_with(straight));
    CHECK(session(folder, "load " + file + "\nstep 15\nprobe\n", {"--strict"}).out.ends_with(straight));
    const Outcome other = session(folder, "load " + file, {"--method", "og"});
    CHECK(contains(other.out, "error: "));
    CHECK(contains(other.out, "method 'enog'"));
    CHECK(contains(session(folder, "load " + file, {"--set", "speed=3"}).out, "other parameters"));
  }

  TEST_CASE("a state of a scene that names a file can be loaded under each spelling of the scene's path") {
    const TemporaryFolder folder;
    write_scene_with_table(folder);
    const fs::path before = fs::current_path();
    fs::current_path(folder.path());
    for (const std::string& saver : {std::string("discs.toml"), folder.str("discs.toml")}) {
      session_of(saver).save("state.bin");
      CHECK(contains(read_checkpoint("state.bin").scene, "file = \"gap.csv\""));
      for (const std::string& loader :
           {std::string("discs.toml"), std::string("./discs.toml"),
            "../" + folder.path().filename().string() + "/discs.toml", folder.str("discs.toml")}) {
        CAPTURE(saver);
        CAPTURE(loader);
        CHECK_NOTHROW(session_of(loader).load("state.bin"));
      }
    }
    fs::current_path(before);
  }

  TEST_CASE("a refused saved state leaves the session unchanged") {
    const TemporaryFolder folder;
    const std::string file = folder.str("state.bin");
    const std::string straight = session(folder, "step 12\nprobe\n").out;
    session(folder, "step 7\nsave " + file + "\n");
    Checkpoint checkpoint = read_checkpoint(file);
    for (const std::size_t at : {std::size_t{0}, checkpoint.state.size() / 2, checkpoint.state.size() - 9}) {
      CAPTURE(at);
      Checkpoint damaged = checkpoint;
      damaged.state.erase(at, 1);  // shifts the following bytes
      write_checkpoint(file, damaged);
      const Outcome outcome = session(folder, "step 5\nload " + file + "\nstep 7\nprobe\n");
      CHECK(contains(outcome.out, "error: '" + file + "' cannot be used: the saved state is damaged"));
      CHECK(outcome.out.ends_with(straight));
    }
  }

  TEST_CASE("some settings can change during a session, and others are refused with the reason") {
    const TemporaryFolder folder;
    const std::vector<std::string> half =
        lines(session(folder, "step\nset cfl=0.1\nstep\nset method.zeta=5\n").out);
    REQUIRE(half.size() == 8);
    CHECK(half[2] == "cfl=0.1");
    CHECK(half[6] == "method.zeta=5");
    CHECK(half[7] == "ok");
    const auto time = [](const std::string& line) { return std::stod(line.substr(line.find('=') + 1)); };
    CHECK(time(half[4]) - time(half[0]) < 0.5 * time(half[0]));
    for (const char* name : {"speed=3", "spacing=0.001", "method=og", "method.h=1.4", "until=1"}) {
      CAPTURE(name);
      CHECK(contains(session(folder, std::string("set ") + name).out, "cannot change during a session"));
    }
    CHECK(contains(session(folder, "set method.zeta=-1e9").out, "error: "));
  }

  TEST_CASE("set changes only its setting, even if the scene file was edited or removed meanwhile") {
    const TemporaryFolder folder;
    const std::string scene = write_tiny_scene(folder);
    Session session = session_of(scene);
    std::string edited = text_of(scene);
    edited.replace(edited.find("1e6"), 3, "1e4");
    std::ofstream(scene) << edited;
    session.set({"cfl", "0.1"});
    CHECK(session.file().settings.cfl == 0.1);
    CHECK(session.file().scene.materials[0].youngs_modulus == 1e6);
    fs::remove(scene);
    CHECK_NOTHROW(session.set({"cfl", "speed/10"}));
    CHECK(session.file().settings.cfl == 0.2);
  }

  TEST_CASE("set works in a session whose scene was read from a pipe") {
    const TemporaryFolder folder;
    const std::string scene = write_tiny_scene(folder);
    const std::string command = "cat " + scene +
                                " | { printf 'set cfl=0.1\n' | " TAUT_BINARY_DIR
                                "/taut session /dev/fd/3 --threads 1; } 3<&0 >" +
                                folder.str("out") + " 2>&1";
    CHECK(std::system(command.c_str()) == 0);
    CHECK(text_of(folder / "out") == "cfl=0.1\nok\n");
  }

  TEST_CASE("set is refused after a file that the scene names has changed") {
    const TemporaryFolder folder;
    write_scene_with_table(folder);
    Session session = session_of(folder.str("discs.toml"));
    CHECK_NOTHROW(session.set({"cfl", "0.1"}));
    std::ofstream(folder / "gap.csv") << "t,gap\n0,0.003\n0.002,0\n";
    CHECK_THROWS_WITH_AS(session.set({"cfl", "0.2"}),
                         doctest::Contains("has changed since the session started"), taut::UsageError);
    CHECK(session.file().settings.cfl == 0.1);
  }

  TEST_CASE("a quote that is not closed gives an error, and the command is not executed") {
    const TemporaryFolder folder;
    for (const std::string wrong :
         {"title Rings \"m/s", "title \"Rings", "title \"Rings\\\"", "\"step", "step \""}) {
      CAPTURE(wrong);
      const std::string out = session(folder, wrong + "\ninfo\n").out;
      CHECK(contains(lines(out)[0], "error: the quote is not closed in '\""));
      CHECK(contains(out, "\nstep=0\n"));
      CHECK_FALSE(contains(out, "Rings\n"));
    }
    CHECK(session(folder, "title \"Rings \\\"m/s\"  \n").out == "title=Rings \"m/s\nok\n");
    CHECK(session(folder, "title 5\"\n").out == "title=5\"\nok\n");
    CHECK(session(folder, "  # \"remark\n \n").out.find("error") == std::string::npos);
  }

  TEST_CASE("a wrong line gives an error, and ends the session only with --strict") {
    const TemporaryFolder folder;
    for (const char* wrong : {"stepp",       "step 0",      "step 1.5",     "step a",
                              "run 3",       "run until x", "color",        "color foo",
                              "range 2 1",   "range 1",     "colormap foo", "view",
                              "view zoom 0", "view pan 1",  "frame",        "frame now.toml",
                              "preview",     "probe foo",   "set",          "set cfl=-1",
                              "set foo=1",   "save",        "load",         "load nothing",
                              "info now",    "help foo",    "quit now",     "frame /nowhere/at/all.png"}) {
      CAPTURE(wrong);
      const Outcome outcome = session(folder, std::string(wrong) + "\nstep\n");
      const auto answers = lines(outcome.out);
      REQUIRE(answers.size() == 3);
      CHECK(answers[0].starts_with("error: "));
      CHECK(answers[1].ends_with("step=1"));
      CHECK(answers[2] == "ok");
      CHECK(outcome.code == 0);
      const Outcome strict = session(folder, std::string(wrong) + "\nstep\n", {"--strict"});
      CHECK(strict.code == (contains(wrong, "/nowhere") ? 4 : 2));
      CHECK(lines(strict.out).size() == 1);
    }
    CHECK(contains(session(folder, "stepp").out, "did you mean 'step'"));
    CHECK(contains(session(folder, "range 0 1MPa").out, "error: '1MPa' is not a number"));
  }

  TEST_CASE("errors of a session describe values in the syntax of sessions, not of options") {
    const TemporaryFolder folder;
    for (const auto& [wrong, message] : std::map<std::string, std::string>{
             {"range 2 1",
              "error: range is '2 1'; it must be LOW HIGH with LOW < HIGH, such as 0 2e6, or 'auto'"},
             {"view 1 0 0 1", "error: view is '1 0 0 1'; it must be X_MIN X_MAX Y_MIN Y_MAX in metres"},
             {"range -1e308 1e308", "error: range is '-1e308 1e308'; it must be LOW HIGH with LOW < HIGH"},
             {"title Gr\xf6\xdf", "error: title is 'Gr\\xf6\\xdf'; it must be one line of UTF-8 text"},
             {"bar_format 3", "error: bar_format is '3'; it must be auto, %.Nf"},
             {"glyph -1", "error: glyph is '-1'; it must be"}}) {
      CAPTURE(wrong);
      const std::string out = session(folder, wrong + "\n").out;
      CHECK(out.starts_with(message));
      CHECK_FALSE(contains(out, "--"));
    }
  }

  TEST_CASE("exit and ? are other names of quit and help") {
    const TemporaryFolder folder;
    CHECK(session(folder, "exit\nstep\n").out == "ok\n");
    CHECK(session(folder, "?\n").out == session(folder, "help\n").out);
    CHECK(session(folder, "help exit\n").out == session(folder, "help quit\n").out);
  }

  TEST_CASE("reset returns a session to the start and keeps its settings") {
    const TemporaryFolder folder;
    const std::string once = session(folder, "set cfl=0.1\nstep 5\nprobe\n").out;
    CHECK(session(folder, "set cfl=0.1\nstep 9\nreset\nstep 5\nprobe\n")
              .out.ends_with(once.substr(once.find("ok\n"))));
    CHECK(contains(session(folder, "step 9\nreset\n").out, "t=0 step=0\nok\n"));
  }

  TEST_CASE("a measure of a session has the value of a run, or the reason why it has no value yet") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "out")).code == 0);
    const auto measure = json_of(folder / "out/run.json")["measures"]["touch_time"];
    const std::string out = session(folder, "measures\nrun until 0.002\nmeasures touch_time\n").out;
    CAPTURE(out);
    CHECK(out.starts_with("touch_time=none # "));
    REQUIRE(measure["value"].is_number());
    CHECK(contains(out, "\ntouch_time=" + taut::cli::exact(measure["value"].get<double>()) + "\n"));
    CHECK(contains(session(folder, "measures foo\n").out, "error: unknown measure 'foo'"));
  }

  TEST_CASE("plot of a session draws probes over the time so far, and needs a step and known names") {
    const TemporaryFolder folder;
    const std::string file = folder.str("gap.svg");
    const std::string out = session(folder, "plot " + file + "\nrun until 0.001\nplot " + file +
                                                " gap\nplot " + file + " foo\nplot gap.txt\nplot\n")
                                .out;
    CAPTURE(out);
    CHECK(out.starts_with("error: there is nothing to plot at t = 0"));
    CHECK(contains(out, "\nfile=" + file + "\nok\n"));
    CHECK(contains(text_of(file), "<svg"));
    CHECK(text_of(folder / "gap.dat").starts_with("# enog\n# t, s; gap, m\n0 "));
    CHECK(contains(out, "error: unknown probe 'foo'"));
    CHECK(contains(out, "error: usage: plot FILE.png [PROBE ...]"));
  }

  TEST_CASE("a session confirms changes of the picture, and reports that a requested time is past") {
    const TemporaryFolder folder;
    CHECK(session(folder, "range 0 2\n").out == "range=0 2\nok\n");
    CHECK(session(folder, "color pressure\n").out == "color=pressure\nok\n");
    CHECK(contains(session(folder, "view zoom 2\n").out, "view=-0.015 0.015 -0.01 0.01\nok\n"));
    CHECK(contains(session(folder, "run until 0.001\nrun until 0.0005\n").out,
                   "# the session is past 0.0005 s; `reset` returns to the start\n"));
  }

  TEST_CASE("info, probe and help print their answers, and quit ends the session") {
    const TemporaryFolder folder;
    const Outcome outcome = session(folder, "# a remark\n\ninfo\nprobe gap\nhelp\nquit\nstep\n");
    CAPTURE(outcome.out);
    CHECK(outcome.code == 0);
    for (const char* part : {"scene=discs\n", "method=enog\n", "t=0\n", "gap=", "step [N]", "quit"})
      CHECK(contains(outcome.out, part));
    CHECK_FALSE(contains(outcome.out, "step=1"));
    CHECK(lines(session(folder, "help step").out).size() == 2);
  }

  TEST_CASE("a session reports that its simulation diverged") {
    const TemporaryFolder folder;
    const Outcome outcome = session(folder, "set cfl=20\nrun until 1\ninfo\n");
    CAPTURE(outcome.out);
    CHECK(contains(outcome.out, "error: the simulation diverged at t = "));
    CHECK(outcome.out.ends_with("ok\n"));
    const std::string file = folder.str("state.bin");
    for (const std::string& more : {std::string("step 50"), "save " + file, std::string("set cfl=0.1")}) {
      CAPTURE(more);
      const auto answers = lines(session(folder, "set cfl=20\nrun until 1\n" + more + "\n").out);
      REQUIRE(answers.size() == 4);
      CHECK(answers[2].starts_with("error: the simulation diverged at t = "));
      CHECK(answers[3] == answers[2]);
    }
    CHECK_FALSE(fs::exists(file));
  }
}
