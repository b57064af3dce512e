#include <fstream>

#include <doctest/doctest.h>

#include "cli/drawing/kept_look.hpp"
#include "engine/error.hpp"
#include "tests/support/program_runner.hpp"

using namespace taut::cli;
using namespace taut::test;
namespace render = taut::render;

namespace {

Drawing drawn_in_3d() {
  Drawing drawing;
  drawing.look.range = {0.1, 1.0 / 3};
  drawing.look.view = {-1.0 / 7, 2, -3, 4};
  drawing.look.camera.emplace().front = 2.0 / 3;
  return drawing;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("kept look: range, view and camera are the same after writing and reading") {
    const TemporaryFolder folder;
    const fs::path file = folder / "look.json";
    CHECK_FALSE(read_look(file));
    std::ofstream(file) << to_json(look_of(drawn_in_3d())).dump(2);
    Drawing open;
    open.look.camera.emplace();
    set_open(open, *read_look(file));
    CHECK(open.look.range == drawn_in_3d().look.range);
    CHECK(open.look.view == drawn_in_3d().look.view);
    CHECK(open.look.camera == drawn_in_3d().look.camera);
  }

  TEST_CASE("kept look: a fixed range and view stay, and a range of another field is not used") {
    const KeptLook look = look_of(drawn_in_3d());
    Drawing fixed;
    fixed.look.range = {5, 6};
    fixed.look.view = {0, 1, 0, 1};
    set_open(fixed, look);
    CHECK(fixed.look.range == render::Range{5, 6});
    CHECK(fixed.look.view == render::View{0, 1, 0, 1});
    Drawing other;
    other.formula = "speed^2";
    set_open(other, look);
    CHECK_FALSE(other.look.range);
    CHECK(other.look.view);
    Drawing orbit;
    orbit.orbit = true;
    set_open(orbit, look);
    CHECK_FALSE(orbit.look.view);
  }
}
