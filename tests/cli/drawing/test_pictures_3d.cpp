#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "cli/drawing/frames.hpp"
#include "render/image/png.hpp"
#include "render/page/page_layout.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/scene_text.hpp"

namespace {

using namespace taut;
using namespace taut::cli;
using namespace taut::test;
using Words = std::vector<std::string>;

constexpr const char* floor_below = R"(
[[wall]]
name = "floor"
at = [0, 0, -0.006]
normal = [0, 0, 1]
)";

std::string write_cubes(const TemporaryFolder& folder, const std::string& more = {}) {
  std::ofstream(folder / "cubes.toml") << R"(
dim = 3
spacing = 0.002
until = 0.0005
method = "tl"
[material.rubber]
density = 1000
youngs_modulus = 1e6
poisson_ratio = 0.4
[[body]]
name = "left"
shape = { type = "box", low = [-0.011, -0.004, -0.004], high = [-0.003, 0.004, 0.004] }
material = "rubber"
velocity = [2, 0, 0]
[[body]]
name = "right"
shape = { type = "box", low = [0.003, -0.004, -0.004], high = [0.011, 0.004, 0.004] }
material = "rubber"
velocity = [-2, 0, 0]
[render]
color = "speed"
size = [160, 120]
frames = 2
)" << more;
  return folder.str("cubes.toml");
}

Outcome run(const TemporaryFolder& folder, const std::string& out, const Words& more = {},
            const std::string& of_scene = {}) {
  Words arguments{"run",    write_cubes(folder, of_scene), "--out", folder.str(out), "--threads", "1",
                  "--quiet"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return call(arguments);
}

std::string last_frame(const TemporaryFolder& folder, const std::string& run) {
  return text_of(folder / (run + "/frames/frame_00002.png"));
}

std::string session(const TemporaryFolder& folder, const std::string& script) {
  std::istringstream input(script);
  std::streambuf* const before = std::cin.rdbuf(input.rdbuf());
  std::cin.clear();
  const Outcome outcome = call({"session", write_cubes(folder), "--threads", "1"});
  std::cin.rdbuf(before);
  return outcome.out;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a run in 3D is drawn, and drawn again from its saved particles with the same bytes") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, "a", {"--save-particles"}, floor_below).code == 0);
    const std::string scene = text_of(folder / "a/scene.toml");
    for (const char* line :
         {"camera = [1.0, -2.0, 1.0]", "up = [0.0, 0.0, 1.0]", "view = \"auto\"", "fov = 0.0",
          "style = \"auto\"", "cut = \"none\"", "hide = \"none\"", "outline = \"none\"", "follow = \"none\""})
      CHECK_MESSAGE(contains(scene, line), line);
    for (const Words& options :
         {Words{}, Words{"--cut", "y < 0"}, Words{"--style", "cells"}, Words{"--follow", "left"},
          Words{"--style", "surface", "--cut", "y < 0"}, Words{"--hide", "left"},
          Words{"--background", "transparent"}, Words{"--camera", "1:1:0", "--up", "0:1:0", "--fov", "40"}}) {
      CAPTURE(options.empty() ? "" : options[0]);
      REQUIRE(run(folder, "b", options, floor_below).code == 0);
      Words again{"render", folder.str("a"), "--quiet"};
      again.insert(again.end(), options.begin(), options.end());
      const Outcome outcome = call(again);
      REQUIRE_MESSAGE(outcome.code == 0, outcome.err);
      CHECK(last_frame(folder, "a") == last_frame(folder, "b"));
      std::ofstream(folder / "a/scene.toml", std::ios::binary) << scene;
      REQUIRE(run(folder, "c", {}, options.empty() ? "" : floor_below).code == 0);
      CHECK(last_frame(folder, "b") != last_frame(folder, "c"));
    }
  }

#ifndef __SANITIZE_ADDRESS__  // the sanitizer reserves the whole address space
  TEST_CASE("pictures that do not fit into memory are refused with their size and a remedy") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, "a", {"--save-particles", "--no-render"}).code == 0);
    // ulimit in KiB; `check_memory` needs about 660 000 KiB for this picture
    const std::string command = "ulimit -c 0; ulimit -v 600000; timeout 60 " TAUT_BINARY_DIR "/taut render " +
                                folder.str("a") + " --size 8000x8000 --threads 1 --quiet 2>" +
                                folder.str("said");
    const int status = std::system(command.c_str());
    const std::string said = text_of(folder / "said");
    CAPTURE(said);
    CHECK(WEXITSTATUS(status) == 2);
    CHECK(contains(said, "no memory for a picture of 8000x8000; use a smaller --size"));
  }

  TEST_CASE("a program without memory for its threads does not abort") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, "a", {"--save-particles", "--no-render"}).code == 0);
    for (const char* limit :
         {"230000", "240000", "250000", "260000"}) {  // KiB; libraries alone need about 225 000
      const std::string command = std::string("ulimit -c 0; ulimit -v ") + limit +
                                  "; timeout 60 " TAUT_BINARY_DIR "/taut render " + folder.str("a") +
                                  " --threads 4 --quiet 2>" + folder.str("said");
      const int code = WEXITSTATUS(std::system(command.c_str()));
      CAPTURE(limit);
      CAPTURE(text_of(folder / "said"));
      CHECK((code == 0 || code == 2 || code == 4 || code == 127));  // 127: the program did not start
    }
  }
#endif

  TEST_CASE(
      "an orbiting camera starts at --camera, turns by a full circle over the number of frames, and keeps its scale") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, "a", {"--save-particles", "--frames", "3"}).code == 0);
    const auto frame = [&](int number) {
      return taut::render::read_png(folder / ("o/" + frame_name(number)));
    };
    REQUIRE(call({"render", folder.str("a"), "--orbit", "--camera", "0:-1:0", "--out", folder.str("o"),
                  "--quiet"})
                .code == 0);
    const auto width = [](const taut::render::Image& image) {
      const taut::render::PageLayout layout = taut::render::make_layout(image.width, image.height, {});
      int left = image.width, right = 0;
      for (int row = 0; row < layout.plot.height; ++row)
        for (int column = 0; column < layout.plot.width; ++column)
          if (image.at(column, row) != taut::render::Rgb{255, 255, 255})
            left = std::min(left, column), right = std::max(right, column);
      return right - left + 1;
    };
    CHECK(width(frame(0)) > 2 * width(frame(1)));
    const double nearer = 1 - 2 * 2.0 * 0.001 / 3 / 0.022;  // 2 m/s each, at two thirds of 0.5 ms
    CHECK(std::abs(width(frame(2)) - nearer * width(frame(0))) <= 3);
    CHECK(std::abs(width(frame(3)) - width(frame(1))) <= 3);
    REQUIRE(call(tiny_run(folder, "flat", {"--save-particles"})).code == 0);
    const Outcome flat = call({"render", folder.str("flat"), "--orbit"});
    CHECK(flat.code == 2);
    CHECK(contains(flat.err, "--orbit needs a scene in 3D"));
  }

  TEST_CASE("runs in 3D are drawn side by side in a panel") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, "a", {"--save-particles", "--no-render"}).code == 0);
    const auto panel = [&](const Words& options) {
      Words arguments{"compare",           folder.str("a"), folder.str("a"), "--out",
                      folder.str("p.png"), "--times",       "0.0005"};
      arguments.insert(arguments.end(), options.begin(), options.end());
      const Outcome outcome = call(arguments);
      REQUIRE_MESSAGE(outcome.code == 0, outcome.err);
      return text_of(folder / "p.png");
    };
    const std::string plain = panel({});
    CHECK(panel({}) == plain);
    CHECK(panel({"--cut", "x < 0"}) != plain);
    CHECK(panel({"--style", "cells"}) != plain);
    CHECK(panel({"--fov", "60"}) != plain);
    const auto size = [&](const Words& options) {
      panel(options);
      const render::Image image = render::read_png(folder / "p.png");
      return std::pair(image.width, image.height);
    };
    CHECK(size({}).first > 1.3 * size({"--times-across"}).first);
    CHECK(size({"--times-across"}).second > 1.3 * size({}).second);
  }

  TEST_CASE("a session in 3D orbits, zooms and cuts, and returns to its first view") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, "a").code == 0);
    const auto frame = [&](const std::string& name) { return "frame " + folder.str(name + ".png") + "\n"; };
    const std::string answers = session(
        folder, frame("start") + "orbit 30 10\n" + frame("turned") + "camera auto\nup auto\n" +
                    frame("back") + "view zoom 2\n" + frame("near") + "view fit\n" + frame("fit") +
                    "cut y < 0\n" + frame("cut") + "cut none\n" + frame("whole") +
                    "view zoom 2\nfollow left\n" + frame("followed") + "view fit\n" + frame("followed_fit") +
                    "follow none\n" + "cut x < 9\nview 0 1 0 1\nstyle discs\ninfo\n");
    const auto picture = [&](const std::string& name) { return text_of(folder / (name + ".png")); };
    for (const char* same : {"back", "fit", "whole"}) CHECK_MESSAGE(picture(same) == picture("start"), same);
    for (const char* other : {"turned", "near", "cut"})
      CHECK_MESSAGE(picture(other) != picture("start"), other);
    CHECK(picture("followed") == picture("followed_fit"));
    CHECK(contains(answers, "error: cut = \"x < 9\" hides all particles"));
    CHECK(contains(answers, "error: view needs dim = 2"));
    CHECK(contains(answers, "error: style = \"discs\" needs dim = 2"));
    CHECK(contains(answers, "cut=none\n"));
    CHECK(contains(answers, "camera=1 -2 1\n"));
  }

  TEST_CASE("pictures: a key that is invalid or does not fit the scene is refused with its place") {
    check_error("color = \"von_mises\"", "camera = @[1, 1, 1]", {"need dim = 3", "has dim = 2", "`view`"});
    check_error("color = \"von_mises\"", "fov = @30", {"need dim = 3"});
    check_error("color = \"von_mises\"", "fov = @130",
                {"fov = 130 must be from 0 (parallel) to 120 degrees"});
    check_error("color = \"von_mises\"", "up = @[0, 0, 0]", {"cannot be [0, 0, 0]"});
    check_error("color = \"von_mises\"", "up = @[0, 1e-300, 0]", {"nor shorter than 1e-100"});
    check_error("color = \"von_mises\"", "range = [0, @1e308]",
                {"range[1] = 1e+308 must be at least -1e+100 and at most 1e+100"});
    check_error("color = \"von_mises\"", "title = @\"two\\nlines\"",
                {"title: 'two\\x0alines' must be one line of UTF-8 text of at most 200 bytes"});
    check_error("color = \"von_mises\"", "style = @\"spheres\"",
                {"needs dim = 3", "discs, cells or surface"});
    check_error("color = \"von_mises\"", "style = @\"sphere\"", {"unknown style 'sphere'", "'spheres'"});
    check_error("color = \"von_mises\"", "follow = @\"rin\"", {"unknown body 'rin'", "'ring'"});
    check_error("color = \"von_mises\"", "hide = @\"rin\"", {"unknown body 'rin'", "'ring'"});
    check_error("color = \"von_mises\"", "outline = @\"all\"", {"unknown outline 'all'", "deformed"});
    check_error("color = \"von_mises\"", "axes_position = @\"outside\"",
                {"axes_position needs dim = 3, but this scene has dim = 2"});
    check_error("color = \"von_mises\"", "bar_position = @\"top\"", {"unknown position 'top'", "bottom"});
    check_error("color = \"von_mises\"", "bar_format = @\"%d\"", {"bar_format = \"%d\" must be auto, %.Nf"});
    check_error("color = \"von_mises\"", "cut = \"x >@\"", {"'x >'"});
    check_error("color = \"von_mises\"", "cut = @3", {"cut must be a text in quotes"});
    const TemporaryFolder folder;
    const Outcome view = run(folder, "a", {"--view", "0:1:0:1"});
    CHECK(view.code == 2);
    CHECK(contains(view.err, "view needs dim = 2, but this scene has dim = 3"));
    const Outcome cut = run(folder, "a", {"--cut", "1"});
    CHECK(cut.code == 2);
    CHECK(contains(cut.err, "hides all particles"));
    CHECK_FALSE(fs::exists(folder / "a"));
    CHECK(call(tiny_run(folder, "b", {"--camera", "1:1:1"})).code == 2);
  }
}
