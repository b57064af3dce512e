#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

#include <doctest/doctest.h>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/command_line/completion.hpp"
#include "cli/command_line/placeholders.hpp"
#include "cli/commands/commands.hpp"
#include "cli/scene/shipped.hpp"
#include "cli/text/format.hpp"
#include "engine/methods/catalogue.hpp"
#include "render/colormap.hpp"
#include "tests/support/program_runner.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

using Words = std::vector<std::string>;

Words words_for(const Words& typed) {
  Words words;
  for (const auto& word : taut::cli::complete(taut::cli::commands(), typed).words) words.push_back(word.text);
  return words;
}

/// With the cursor at the end of `line`.
Words offered_by_bash(const TemporaryFolder& folder, const std::string& line) {
  std::ofstream(folder / "ask.sh") << "source <(\"$1\"/taut completion bash)\n"
                                      "compopt() { :; }  # that of bash fails outside a completion\n"
                                      "PATH=$1:$PATH COMP_LINE=$2 COMP_POINT=${#2}\n"
                                      "cd \"$3\"\n_taut\nprintf '%s\\n' \"${COMPREPLY[@]}\" | sort -u\n";
  const std::string ask = "bash '" + folder.str("ask.sh") + "' '" TAUT_BINARY_DIR "' '" + line + "' '" +
                          folder.path().string() + "' >'" + folder.str("offered") + "'";
  REQUIRE(std::system(ask.c_str()) == 0);
  return lines_of(folder / "offered");
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a command line is completed with the words that can follow") {
    const TemporaryFolder folder;
    const std::string scene = write_tiny_scene(folder);
    fs::create_directories(folder / "run");
    fs::copy_file(scene, folder / "run/scene.toml");
    fs::create_directories(folder / "cable");
    fs::copy_file(fs::path(TAUT_SOURCE_DIR) / "scenes/heterogeneous-cable.toml", folder / "cable/scene.toml");
    const std::map<Words, Words> cases{
        {{"comp"}, {"compare", "completion"}},
        {{"--v"}, {"--version"}},
        {{"run", "coll"}, {"colliding-balls", "colliding-rings"}},
        {{"run", "coll", "--meth"}, {"--method"}},
        {{"run", "coll", "--method", "oe"}, {"oenog"}},
        {{"run", "coll", "--method=oe"}, {"--method=oenog"}},
        {{"run", scene, "--set", "s"}, {"speed=", "spacing=", "stepping="}},
        {{"run", scene, "--method", "tl", "--set", "method.z"}, {}},
        {{"run", scene, "--method", "enog", "--set", "method.z"}, {"method.zeta="}},
        {{"run", scene, "--method", "ulsph-r-tic", "--set", "method.limiter=m"}, {"method.limiter=minmod"}},
        {{"run", scene, "--set", "pull=1", "--set", "stepping="}, {"stepping=dual", "stepping=single"}},
        {{"run", "--quiet", "tran"}, {"tran-duc-rings"}},
        {{"run", scene, "--fields", "speed,den"}, {"speed,density"}},
        {{"run", scene, "--save-particles", "x"}, {"xyz"}},
        {{"run", scene, "--save-particles=v"}, {"--save-particles=vtp"}},
        {{"run", "--save-particles", "xyz", "tran"}, {"tran-duc-rings"}},
        {{"run", "--save-particles", "tran"}, {"tran-duc-rings"}},
        {{"run", scene, "--particle-precision", ""}, {"double", "single"}},
        {{"run", scene, "--fail-on", ""}, {"hourglass", "penetrated", "fractured", "diverged"}},
        {{"run", scene, "--range", ""}, {"auto"}},
        {{"run", scene, "--until", ""}, {}},
        {{"run", scene, "--until", "1", "--unt"}, {}},  // --until is not repeatable
        {{"run", scene, "--set", "pull=1", "--se"}, {"--set"}},
        {{"sweep", "rings-speed-l"}, {"rings-speed-limit"}},
        {{"sweep", scene, "--grid", "method=og,oe"}, {"method=og,oenog"}},
        {{"sweep", scene, "--emit", ""}, {"slurm", "parallel"}},
        {{"describe", "oe"}, {"oenog"}},
        {{"describe", "bod"}, {"body"}},
        {{"describe", "sweep-"}, {"sweep-file"}},
        {{"claims", "--run", "Zhang2024.fig-19"}, {"Zhang2024.fig-19a", "Zhang2024.fig-19b"}},
        {{"snapshot", "rings-and"}, {"rings-and-balls"}},
        {{"describe", "suite-"}, {"suite-file"}},
        {{"list", "e"}, {"equations"}},
        {{"plot", folder.str("run"), "--columns", "t,g"}, {"t,gap"}},
        {{"plot", folder.str("cable"), "--lines", ""}, {"stress"}},
        {{"check", folder.str("run"), "--measure", ""}, {"touch_time"}},
        {{"completion", ""}, {"bash", "zsh"}},
        {{"nothing", ""}, {}},
        {{"run", scene, "--nothing", "--set", "x"}, {}},
        {{}, {}},
    };
    for (const auto& [typed, expected] : cases) {
      const std::string line = taut::cli::join(typed, " ");
      CAPTURE(line);
      CHECK(words_for(typed) == expected);
    }
    CHECK(words_for({"run", scene, "--colormap", ""}).size() == taut::render::colormaps().size());
    CHECK(words_for({"run", scene, "--method", ""}).size() == taut::methods().size());
    CHECK(taut::cli::complete(taut::cli::commands(), {"run", ""}).files == "*.toml");
    CHECK(taut::cli::complete(taut::cli::commands(), {"compare", "a", "b", ""}).files == "*/");
    CHECK(taut::cli::complete(taut::cli::commands(), {"compare", "a", "--out", ""}).files == "*.png");
    CHECK(taut::cli::complete(taut::cli::commands(), {"movie", "a", "--out", ""}).files == "*");
  }

  TEST_CASE("every command, option and argument is known to completion") {
    const Words names = words_for({""});
    const taut::cli::SceneFile scene = taut::cli::read_scene(taut::cli::find_scene("rotating-plate"));
    const std::set<std::string> free_values{"N",      "T",      "DT",        "DP",
                                            "X",      "TIMES",  "T,...",     "WIDTHxHEIGHT",
                                            "LENGTH", "POINTS", "LABEL,...", "ENTRY,..."};
    for (const taut::cli::Command& command : taut::cli::commands()) {
      const std::string name(command.name);
      CHECK(std::ranges::count(names, name) == 1);
      taut::cli::Options declared({});
      command.declare(declared);
      const Words options = words_for({name, "--"});
      for (const taut::cli::Option& option : declared.all()) {
        if (!option.is_positional()) CHECK(std::ranges::count(options, option.name()) == 1);
        const std::string placeholder = option.placeholder();
        CAPTURE(name);
        CAPTURE(placeholder);
        const taut::cli::Choices found = taut::cli::choices(placeholder, "", &scene);
        CHECK((placeholder.empty() || free_values.contains(placeholder)) ==
              (found.words.empty() && found.files.empty()));
      }
    }
  }

  TEST_CASE("bash completes with the program's words, and with files where files are allowed") {
    const TemporaryFolder folder;
    write_tiny_scene(folder);
    fs::create_directory(folder / "dune");
    CHECK(offered_by_bash(folder, "taut sn") == Words{"snapshot"});
    CHECK(offered_by_bash(folder, "taut run colliding-r") == Words{"colliding-rings"});
    CHECK(offered_by_bash(folder, "taut run d") == Words{"discs.toml", "dune"});
    CHECK(offered_by_bash(folder, "taut run discs.toml --out d") == Words{"dune"});
    CHECK(offered_by_bash(folder, "taut run discs.toml --out=d") == Words{"dune"});
    CHECK(offered_by_bash(folder, "taut run discs.toml --set spe") == Words{"speed="});
    CHECK(offered_by_bash(folder, "taut run discs.toml --set contact=i") == Words{"impulse"});
    CHECK(offered_by_bash(folder, "taut run discs.toml --method=oe") == Words{"oenog"});
    CHECK(offered_by_bash(folder, "taut run discs.toml --fr") == Words{"--frames"});
    // names that bash would have to quote are not offered
    for (const char* name : {"dip`touch x`", "dip $(touch x)", "dip;x", "dip\nx"})
      std::ofstream(folder / (std::string(name) + ".toml"));
    ::setenv("TAUT_SCENES", folder.path().c_str(), 1);
    CHECK(call({"--complete", "run", "di"}).out == "*.toml\ndiscs\t\n");
    ::unsetenv("TAUT_SCENES");
    const Outcome outcome = call({"completion", "bsh"});
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "did you mean 'bash'"));
  }
}
