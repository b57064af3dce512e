#include <cmath>

#include <doctest/doctest.h>

#include "cli/formats/particle_file.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/relative.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

void check_same_files(const fs::path& a, const fs::path& b) {
  REQUIRE(files_in(a) > 0);
  CHECK(files_in(a) == files_in(b));
  for (const auto& file : fs::directory_iterator(a)) {
    CAPTURE(file.path().string());
    const bool same = text_of(file.path()) == text_of(b / file.path().filename());
    CHECK(same);
  }
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a run saves its particles at the times of the frames, with an index") {
    const TemporaryFolder folder;
    const Outcome outcome = call(tiny_run(folder, "out", {"--save-particles", "--no-render"}));
    REQUIRE(outcome.code == 0);
    CHECK(contains(outcome.out, "particles.pvd"));
    CHECK(files_in(folder / "out/particles") == 6);
    const std::string index = text_of(folder / "out/particles/particles.pvd");
    for (int k = 0; k <= 4; ++k) {
      const std::string name = "particles_0000" + std::to_string(k) + ".vtp";
      const ParticleFile file(folder / ("out/particles/" + name));
      CHECK(file.time() == 0.002 * k / 4);
      CHECK(contains(index, "timestep=\"" + exact(file.time()) + "\" part=\"0\" file=\"" + name + "\""));
      CHECK(static_cast<long>(file.fields().size()) == static_cast<long>(fields(2).size()));
    }
    CHECK(json_of(folder / "out/run.json")["reached"].get<double>() > 0.002);
    REQUIRE(call(tiny_run(folder, "out", {"--no-render"})).code == 0);
    CHECK_FALSE(fs::exists(folder / "out/particles"));
  }

  TEST_CASE("particles saved between two steps have the time and the positions of that moment") {
    const TemporaryFolder folder;
    const std::vector<std::string> all{"--save-particles", "--no-render", "--fields", "speed",
                                       "--until",          "1e-4"};
    const auto run = [&](const std::string& name, int frames) {
      std::vector<std::string> more = all;
      more.insert(more.end(), {"--frames", std::to_string(frames)});
      REQUIRE(call(tiny_run(folder, name, more)).code == 0);
      return text_of(folder / (name + "/history.csv"));
    };
    CHECK(run("often", 100) == run("seldom", 1));
    CHECK(json_of(folder / "often/run.json")["steps"].get<int>() < 50);
    const auto leftmost = [&](const ParticleFile& file) { return std::ranges::min(file.positions(2)); };
    const auto saved = [&](int k) {
      return ParticleFile(folder / ("often/particles/" + numbered("particles", k, "vtp")));
    };
    for (int k = 0; k <= 100; ++k) {
      CHECK(saved(k).time() == 1e-4 * k / 100);
      CHECK(std::abs(leftmost(saved(k)) - leftmost(saved(0)) - 2e-6 * k) < 1e-11);
    }
  }

  TEST_CASE(
      "saving particles does not alter a run, and body and material are saved with the requested fields") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "with", {"--save-particles", "--fields", "speed,pressure"})).code == 0);
    REQUIRE(call(tiny_run(folder, "without")).code == 0);
    CHECK(text_of(folder / "with/history.csv") == text_of(folder / "without/history.csv"));
    check_same_files(folder / "with/frames", folder / "without/frames");
    CHECK(ParticleFile(folder / "with/particles/particles_00000.vtp").fields() ==
          std::vector<std::string>{"speed", "pressure", "body", "material"});
    const Outcome outcome = call({"render", folder.str("with"), "--color", "density", "--quiet"});
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "speed, pressure"));
    check_same_files(folder / "with/frames", folder / "without/frames");
  }

  TEST_CASE("render needs saved particles but not the frames of the run") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "plain")).code == 0);
    const Outcome outcome = call({"render", folder.str("plain")});
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "--save-particles"));
    CHECK(call({"render", folder.path()}).code == 2);

    REQUIRE(call(tiny_run(folder, "saved", {"--no-render", "--save-particles"})).code == 0);
    REQUIRE(call({"render", folder.str("saved"), "--out", folder.str("pictures"), "--quiet"}).code == 0);
    check_same_files(folder / "plain/frames", folder / "pictures");
    CHECK(files_in(folder / "saved/frames") == 0);
    std::ofstream(folder / "pictures/mine.png") << "mine";
    CHECK(call({"render", folder.str("saved"), "--out", folder.str("pictures"), "--quiet"}).code == 2);
    CHECK(files_in(folder / "pictures") == 6);
  }

  TEST_CASE("render reports a missing particle file, and the other frames keep their numbers") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "out", {"--save-particles"})).code == 0);
    fs::remove(folder / "out/particles/particles_00002.vtp");
    for (const std::string range : {"0:4", "auto"}) {
      CAPTURE(range);
      const Outcome render =
          call({"render", folder.str("out"), "--range", range, "--out", folder.str("again"), "--quiet"});
      CHECK(render.code == 0);
      CHECK(contains(render.err, "taut: particles_00002.vtp in '"));
      CHECK(contains(render.err, "the other frames keep their numbers"));
      CHECK(contains(render.out, "(4)"));
      CHECK_FALSE(fs::exists(folder / "again/frame_00002.png"));
      CHECK(fs::exists(folder / "again/frame_00004.png"));
    }
    REQUIRE(call({"render", folder.str("out"), "--out", folder.str("same"), "--quiet"}).code == 0);
    CHECK(text_of(folder / "same/frame_00003.png") == text_of(folder / "out/frames/frame_00003.png"));
  }

  TEST_CASE("a view set by an option is the view of the frames") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "whole")).code == 0);
    REQUIRE(call(tiny_run(folder, "close", {"--view", "-0.02:0:-0.01:0.01"})).code == 0);
    CHECK(contains(text_of(folder / "close/scene.toml"), "view = [-0.02, 0.0, -0.01, 0.01]"));
    CHECK(call({"diff", folder.str("whole"), folder.str("close")}).code == 1);
  }

  TEST_CASE("colours by body and by expression are the same in the run and from its saved particles") {
    const TemporaryFolder folder;
    for (const std::string color : {"body", "J", "=speed^2/2 + 1e3*(x - X) + t/dp"}) {
      CAPTURE(color);
      REQUIRE(call(tiny_run(folder, "out", {"--save-particles", "--color", color})).code == 0);
      REQUIRE(call({"render", folder.str("out"), "--out", folder.str("again"), "--quiet"}).code == 0);
      check_same_files(folder / "out/frames", folder / "again");
      CHECK(contains(text_of(folder / "out/scene.toml"), "color = \"" + color + "\""));
      REQUIRE(call({"run", folder.str("out/scene.toml"), "--out", folder.str("third"), "--quiet"}).code == 0);
      check_same_files(folder / "out/frames", folder / "third/frames");
    }
    const Outcome unknown = call(tiny_run(folder, "out", {"--color", "=sped + 1"}));
    CHECK(unknown.code == 2);
    CHECK(contains(unknown.err, "unknown name 'sped' in 'sped + 1' (did you mean 'speed'?)"));
    REQUIRE(call(tiny_run(folder, "out", {"--save-particles", "--fields", "speed", "--no-render"})).code ==
            0);
    const Outcome missing = call({"render", folder.str("out"), "--color", "=density"});
    CHECK(missing.code == 2);
    CHECK(contains(missing.err, "does not contain the field density; it contains speed, body, material"));
    const Outcome both = call(tiny_run(folder, "out", {"--color", "body", "--range", "0:1"}));
    CHECK(both.code == 2);
    CHECK(contains(both.err, "color = \"body\" has one colour for each body"));
    CHECK(call(tiny_run(folder, "out", {"--style", "cells", "--glyph", "0.5"})).code == 2);
  }
}

TEST_SUITE("determinism") {
  TEST_CASE("render gives the bytes that the run would have drawn with the same options") {
    const std::vector<std::vector<std::string>> cases{
        {},
        {"--color", "pressure"},
        {"--color", "displacement_x", "--range", "-1e-3:1e-3", "--colormap", "rainbow"},
        {"--view", "-0.02:0:-0.01:0.01", "--size", "300x200"},
        {"--view", "auto", "--range", "auto"},
    };
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "saved", {"--save-particles"})).code == 0);
    for (const std::vector<std::string>& options : cases) {
      CAPTURE(options.size());
      fs::remove_all(folder / "again");
      fs::copy(folder / "saved", folder / "again", fs::copy_options::recursive);
      std::vector<std::string> render{"render", folder.str("again"), "--quiet"};
      render.insert(render.end(), options.begin(), options.end());
      REQUIRE(call(render).code == 0);
      REQUIRE(call(tiny_run(folder, "direct", options)).code == 0);
      check_same_files(folder / "again/frames", folder / "direct/frames");
      CHECK(text_of(folder / "again/scene.toml") == text_of(folder / "direct/scene.toml"));
    }
  }
}
