#include <doctest/doctest.h>

#include "cli/run/labels.hpp"
#include "cli/run/panel_cells.hpp"
#include "render/image/png.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/scene_text.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

void make_run(const TemporaryFolder& folder, const std::string& name, std::vector<std::string> more = {}) {
  more.insert(more.end(), {"--save-particles", "--no-render"});
  const Outcome outcome = call(tiny_run(folder, name, more));
  REQUIRE_MESSAGE(outcome.code == 0, outcome.err);
}

Outcome compare(const TemporaryFolder& folder, const std::vector<std::string>& runs,
                const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"compare"};
  for (const std::string& run : runs) arguments.push_back(folder.str(run));
  arguments.insert(arguments.end(), {"--out", folder.str("panel.png")});
  arguments.insert(arguments.end(), more.begin(), more.end());
  return call(arguments);
}

RunLabels labels(const TemporaryFolder& folder, const std::vector<std::string>& names) {
  std::vector<SavedRun> runs;
  for (const std::string& name : names) runs.push_back(open_saved_run(folder / name));
  return label_runs(runs);
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a panel reports particles outside the scene's view, and --view auto shows them") {
    const TemporaryFolder folder;
    const auto panel = [&](const std::string& left, const std::vector<std::string>& more = {}) {
      const std::string scene = write_tiny_scene(folder), text = text_of(scene), view = "view = [-0.03";
      std::ofstream(scene) << text.substr(0, text.find(view)) << "view = [" << left
                           << text.substr(text.find(view) + view.size());
      const Outcome run = call({"run", scene, "--out", folder.str("r"), "--quiet", "--no-render",
                                "--save-particles", "--until", "1e-4"});
      REQUIRE_MESSAGE(run.code == 0, run.err);
      const Outcome outcome = compare(folder, {"r"}, more);
      CHECK(outcome.code == 0);
      return outcome.err;
    };
    const std::string told = "of the particles of " + folder.str("r") + " are outside the view of the scene";
    CHECK(contains(panel("-0.01"), told));
    const render::Image cut = render::read_png(folder / "panel.png");
    CHECK(panel("-0.01", {"--view", "auto"}).empty());
    CHECK(render::read_png(folder / "panel.png").width != cut.width);
    CHECK(panel("-0.03").empty());
    CHECK(panel("-0.01", {"--hide", "left"}).empty());
    CHECK(panel("-0.01", {"--cut", "x < 0"}).empty());
    CHECK(contains(panel("-0.01", {"--hide", "right"}), told));
    const std::string twice = panel("-0.01", {"--beside", "color=pressure"});
    CHECK(contains(twice, told));
    CHECK(twice.find(told) == twice.rfind(told));
  }

  TEST_CASE("a panel with a wrong number of labels or an invalid label is refused before it is drawn") {
    const TemporaryFolder folder;
    make_run(folder, "a", {"--until", "1e-4"});
    for (const auto& [labels, message] :
         {std::pair("one,two", "--labels must give one label for each run (labels: 2, runs: 1)"),
          std::pair("Gr\xf6\xdf", "'Gr\\xf6\\xdf' must be one line of UTF-8 text of at most 200 bytes"),
          std::pair("two\nlines", "'two\\x0alines' must be one line of UTF-8 text")}) {
      const Outcome outcome = compare(folder, {"a"}, {"--labels", labels});
      CAPTURE(outcome.err);
      CHECK(outcome.code == 2);
      CHECK(contains(outcome.err, message));
    }
    CHECK_FALSE(fs::exists(folder / "panel.png"));
    CHECK(compare(folder, {"a"}, {"--labels", "Größe"}).code == 0);
  }

  TEST_CASE("a panel shows two fields or views beside each other, and refuses keys of the whole page") {
    const TemporaryFolder folder;
    make_run(folder, "a", {"--until", "1e-4"});
    const auto drawn = [&](const std::vector<std::string>& more) {
      const Outcome outcome = compare(folder, {"a"}, more);
      REQUIRE_MESSAGE(outcome.code == 0, outcome.err);
      return render::read_png(folder / "panel.png");
    };
    const render::Image one = drawn({});
    const render::Image two = drawn({"--beside", "color=pressure"});
    CHECK(two.width > one.width + 100);
    CHECK(drawn({"--beside", "color = pressure; range = 0:1"}) ==
          drawn({"--beside", "range=0:1; color=pressure"}));
    CHECK_FALSE(drawn({"--beside", "color=pressure; range=0:1"}) == two);
    CHECK(drawn({"--beside", "view=0:0.01:0:0.01"}).width < two.width);  // both views share a colour bar
    CHECK(drawn({"--beside", "color=pressure", "--beside", "color=speed"}).width > two.width);
    const auto refused = [&](const std::string& text) {
      const Outcome outcome = compare(folder, {"a"}, {"--beside", text});
      CHECK(outcome.code == 2);
      return outcome.err;
    };
    CHECK(contains(refused("size=300x200"), "--beside: unknown drawing option 'size'"));
    CHECK(contains(refused("colour=speed"), "did you mean 'color'"));
    CHECK(contains(refused("speed"), "--beside contains 'speed'; it must be KEY=VALUE"));
    CHECK(contains(refused("color=spede"), "unknown field 'spede'"));
    CHECK(contains(refused("camera=1:1:1"), "need dim = 3"));
  }

  TEST_CASE("runs whose bodies have different names cannot share a legend") {
    const TemporaryFolder folder;
    make_run(folder, "a", {"--until", "1e-4"});
    const std::string scene = write_tiny_scene(folder);
    const std::string text =
        replaced(replaced(text_of(scene), "name = \"left\"", "name = \"first\""), "[\"left\"", "[\"first\"");
    std::ofstream(folder / "other.toml") << text;
    REQUIRE(call({"run", folder.str("other.toml"), "--out", folder.str("b"), "--quiet", "--no-render",
                  "--save-particles", "--until", "1e-4"})
                .code == 0);
    const Outcome refused = compare(folder, {"a", "b"}, {"--color", "body"});
    CHECK(refused.code == 2);
    CHECK(contains(refused.err, "has left, right"));
    CHECK(contains(refused.err, "has first, right"));
    CHECK(compare(folder, {"a", "b"}, {"--color", "material"}).code == 0);
    CHECK(compare(folder, {"a", "b"}).code == 0);
  }

  TEST_CASE("a panel that follows a body missing in one run is refused, and --follow none draws it") {
    const TemporaryFolder folder;
    make_run(folder, "a", {"--until", "1e-4", "--follow", "left"});
    const std::string scene = write_tiny_scene(folder);
    std::ofstream(folder / "other.toml") << replaced(
        replaced(text_of(scene), "name = \"left\"", "name = \"first\""), "[\"left\"", "[\"first\"");
    REQUIRE(call({"run", folder.str("other.toml"), "--out", folder.str("b"), "--quiet", "--no-render",
                  "--save-particles", "--until", "1e-4"})
                .code == 0);
    const Outcome refused = compare(folder, {"a", "b"});
    CHECK(refused.code == 2);
    CHECK(contains(
        refused.err,
        "the picture follows body 'left', but '" + folder.str("b") +
            "' has only the bodies first, right; choose another body with --follow, or --follow none"));
    CHECK(compare(folder, {"a", "b"}, {"--follow", "none"}).code == 0);
    CHECK(contains(compare(folder, {"a", "b"}, {"--follow", "none", "--beside", "follow=left"}).err,
                   "has only the bodies first, right; choose another body in --beside, or follow=none"));
    CHECK(compare(folder, {"a", "b"}, {"--follow", "none", "--beside", "follow=none"}).code == 0);
    CHECK(compare(folder, {"b", "a"}).code == 0);
  }

  TEST_CASE("a panel and a difference picture create the folder of their file") {
    const TemporaryFolder folder;
    make_run(folder, "a", {"--until", "1e-4"});
    CHECK(call({"compare", folder.str("a"), "--out", folder.str("pictures/of/a.png")}).code == 0);
    CHECK(std::filesystem::exists(folder / "pictures/of/a.png"));
    CHECK(call({"diff", folder.str("pictures/of/a.png"), folder.str("pictures/of/a.png"), "--out",
                folder.str("differences/d.png")})
              .code == 0);
    CHECK(std::filesystem::exists(folder / "differences/d.png"));
  }

  TEST_CASE("a panel in a missing folder of the root directory gives exit code 4, and makes no folder") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "out", {"--save-particles"})).code == 0);
    const Outcome panel = call({"compare", folder.str("out"), "--out", "/no-such-folder/deep/panel.png"});
    CHECK(panel.code == 4);
    CHECK(contains(panel.err, "the folder /no-such-folder does not exist"));
    CHECK_FALSE(fs::exists("/no-such-folder"));
  }

  TEST_CASE("a panel shows every run at every time, and is refused if no run has a picture") {
    const TemporaryFolder folder;
    make_run(folder, "slow");
    make_run(folder, "fast", {"--set", "speed=3"});
    make_run(folder, "short", {"--until", "0.001"});
    REQUIRE(compare(folder, {"slow", "fast"}).code == 0);
    const render::Image quarters = render::read_png(folder / "panel.png");
    REQUIRE(compare(folder, {"slow", "fast"}, {"--times", "0.0005,0.001,0.0015,0.002"}).code == 0);
    CHECK(render::read_png(folder / "panel.png") == quarters);
    REQUIRE(compare(folder, {"fast", "slow"}).code == 0);
    CHECK_FALSE(render::read_png(folder / "panel.png") == quarters);
    REQUIRE(compare(folder, {"slow", "fast"}, {"--times", "0.0005,0.001,0.0015,0.0019"}).code == 0);
    CHECK_FALSE(render::read_png(folder / "panel.png") == quarters);
    REQUIRE(compare(folder, {"slow", "fast"}, {"--size", "900x700", "--times", "0"}).code == 0);
    CHECK(render::read_png(folder / "panel.png").width == 900);

    const std::vector<std::string> late{"--times", "0.002"};
    REQUIRE(compare(folder, {"slow", "short"}, late).code == 0);
    const render::Image ended = render::read_png(folder / "panel.png");
    REQUIRE(compare(folder, {"slow", "slow"}, late).code == 0);
    CHECK_FALSE(render::read_png(folder / "panel.png") == ended);
    CHECK(compare(folder, {"short"}, late).code == 2);
  }

  TEST_CASE("a picture in a panel is labelled with its time if its row has another time") {
    const TemporaryFolder folder;
    make_run(folder, "out", {"--frames", "2"});
    const SavedRun run = open_saved_run(folder / "out");
    const Drawing speed{.field = find_field("speed")};
    const Origins origins = origins_of(run.file.scene);
    const PanelCell at = cell_at(run, 0.001, 0.002, speed, origins);
    REQUIRE(at.particles);
    CHECK(at.particles->time == run.particles[1].time());
    CHECK(at.particles->value == run.particles[1].field("speed"));
    CHECK(at.remark.empty());
    const PanelCell beside = cell_at(run, 0.0012, 0.002, speed, origins);
    REQUIRE(beside.particles);
    CHECK(beside.particles->time == run.particles[1].time());
    CHECK(contains(beside.remark, "t = 1.0"));
    const PanelCell after = cell_at(run, 0.003, 0.003, speed, origins);
    CHECK_FALSE(after.particles);
    CHECK(contains(after.remark, "ended at t = 2.0"));
  }

  TEST_CASE("a diverged run shows the time of divergence in place of a picture") {
    const TemporaryFolder folder;
    const Outcome outcome = call(tiny_run(
        folder, "out",
        {"--set", "cfl=20", "--until", "0.02", "--save-particles", "--no-render", "--frames", "40"}));
    REQUIRE(outcome.code == 3);
    const SavedRun run = open_saved_run(folder / "out");
    const PanelCell end =
        cell_at(run, 0.02, 0.02, {.field = find_field("speed")}, origins_of(run.file.scene));
    CHECK_FALSE(end.particles);
    CHECK(contains(end.remark, "diverged at t = "));
  }

  TEST_CASE("times in a panel have only the decimals that they need") {
    CHECK(time_labels({0.003, 0.006}, 0.012) == std::vector<std::string>{"t = 3 ms", "t = 6 ms"});
    CHECK(time_labels({0.003, 0.00625}, 0.012) == std::vector<std::string>{"t = 3.00 ms", "t = 6.25 ms"});
    CHECK(time_labels({0, 1.0 / 3}, 1) == std::vector<std::string>{"t = 0.0000 s", "t = 0.3333 s"});
  }

  TEST_CASE("the automatic range of a panel spans all its pictures") {
    const TemporaryFolder folder;
    make_run(folder, "slow");
    make_run(folder, "fast", {"--set", "speed=3"});
    const auto panel = [&](const std::vector<std::string>& runs, const std::string& range) {
      REQUIRE(
          compare(folder, runs, {"--times", "0", "--view", "-0.03:0.03:-0.02:0.02", "--range", range}).code ==
          0);
      return render::read_png(folder / "panel.png");
    };
    CHECK(panel({"slow", "fast"}, "auto") == panel({"slow", "fast"}, "2:3"));
    CHECK_FALSE(panel({"slow", "fast"}, "auto") == panel({"slow", "fast"}, "0:4"));
  }

  TEST_CASE("columns of a panel are named by the settings that differ between the runs") {
    const TemporaryFolder folder;
    make_run(folder, "a");
    make_run(folder, "b");
    make_run(folder, "fast", {"--set", "speed=3"});
    make_run(folder, "og", {"--method", "og", "--set", "speed=3"});
    make_run(folder, "zeta", {"--set", "method.zeta=4", "--spacing", "0.001"});
    const RunLabels same = labels(folder, {"a", "b"});
    CHECK(same.title == "Two discs");
    CHECK(same.note == "enog");
    CHECK(same.columns[1].title == "b");
    const RunLabels speeds = labels(folder, {"a", "fast"});
    CHECK(speeds.note == "enog");
    CHECK(speeds.columns[0].title == "speed = 2 m/s");
    CHECK(speeds.columns[1].title == "speed = 3 m/s");
    CHECK(speeds.columns[1].note.empty());
    const RunLabels methods = labels(folder, {"a", "og"});
    CHECK(methods.note.empty());
    CHECK(methods.columns[0].title == "enog");
    CHECK(methods.columns[1].title == "og");
    CHECK(methods.columns[1].note == "speed = 3 m/s");
    const RunLabels constants = labels(folder, {"a", "zeta"});
    CHECK(constants.columns[0].title == "dp = 2 mm");
    CHECK(constants.columns[1].title == "dp = 1 mm");
    CHECK(constants.columns[1].note == "zeta = 4");
  }

  TEST_CASE("a panel whose file is not named .png is refused before anything is drawn") {
    const TemporaryFolder folder;
    make_run(folder, "slow");
    for (const char* name : {"panel.jpg", "panel", "panel.png.svg"}) {
      CAPTURE(name);
      const Outcome outcome = call({"compare", folder.str("slow"), "--out", folder.str(name)});
      CHECK(outcome.code == 2);
      CHECK(contains(outcome.err, "' must end in .png"));
      CHECK_FALSE(fs::exists(folder / name));
    }
  }

  TEST_CASE("a run without saved particles cannot be compared") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "plain", {"--no-render"})).code == 0);
    const Outcome outcome = compare(folder, {"plain"});
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "--save-particles"));
    CHECK_FALSE(fs::exists(folder / "panel.png"));
  }
}
