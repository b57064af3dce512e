#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include <doctest/doctest.h>

#include "cli/scene/shipped.hpp"
#include "engine/error.hpp"
#include "engine/layout/initial_particles.hpp"
#include "engine/scene/shapes/round_shapes.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/scene_text.hpp"

using namespace taut;
using namespace taut::test;

namespace {

std::string solid_scene(const std::string& shape, const std::string& keys = "") {
  return "title = \"Solid\"\ndim = 3\nspacing = 0.1\nuntil = 2\n"
         "[material.rubber]\ndensity = 1200\nyoungs_modulus = 1e7\npoisson_ratio = 0.4\n"
         "[[body]]\nname = \"thing\"\nshape = " +
         shape + "\nmaterial = \"rubber\"\n" + keys + "\n";
}

const std::string brick = "{ type = \"box\", low = [0, 0, 0], high = [2, 1, 0.5] }";

/// Expects an error at '@' with all `parts`.
void check_solid_error(std::string text, std::initializer_list<const char*> parts) {
  const std::size_t mark = text.find('@');
  REQUIRE(mark != std::string::npos);
  const int line =
      1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(mark), '\n'));
  text.erase(mark, 1);
  INFO(text);
  try {
    read_text(text);
    FAIL_CHECK("no error");
  } catch (const SceneError& error) {
    INFO("message: ", std::string(error.what()));
    CHECK(error.line == line);
    CHECK(error.column == static_cast<int>(mark - (text.rfind('\n', mark - 1) + 1)) + 1);
    for (const char* part : parts) {
      INFO("expected: ", part);
      CHECK(std::string(error.what()).find(part) != std::string::npos);
    }
  }
}

double volume(const InitialParticles& layout) {
  return std::accumulate(layout.V0.begin(), layout.V0.end(), 0.0);
}

/// Reading the resolved text must give the same particles and resolved text.
void check_resolved(const SceneFile& file) {
  const std::string text = resolved_text(file, scratch_folder());
  const SceneFile again = read_text(text);
  CHECK(resolved_text(again, scratch_folder()) == text);
  const InitialParticles a = make_initial_particles(file.scene), b = make_initial_particles(again.scene);
  CHECK(a.x == b.x);
  CHECK(a.V0 == b.V0);
  CHECK(a.clamped == b.clamped);
  CHECK(a.guided == b.guided);
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("scene in 3D: vectors have three components and expressions can use x, y and z") {
    const SceneFile file = read_text(
        "gravity = [0, 0, \"-9.8*t\"]\n" +
        solid_scene(brick,
                    "velocity = [0, 0, \"x + 10*y + 100*z\"]\n"
                    "driven = [{ where = \"z > 0.4\", velocity = [0, 0, \"t\"] }]\n"
                    "loaded = [{ where = \"z < 0.1\", force = [0, 0, \"z\"] }]\n"
                    "[[wall]]\nname = \"floor\"\nat = [0, 0, -1]\nnormal = [0, 0, 2]\n"
                    "[[probe]]\nname = \"tip\"\nof = \"displacement\"\nbody = \"thing\"\nat = [2, 1, 0.25]\n"
                    "component = \"z\"\n[[measure]]\nname = \"peak\"\nof = \"maximum\"\nprobe = \"tip\"\n"
                    "unit = \"m\""));
    const Scene& scene = file.scene;
    CHECK(scene.dim == 3);
    CHECK(scene.gravity[2](2) == -19.6);
    CHECK(scene.bodies[0].velocity[2]({1, 2, 3}) == 321);
    CHECK(scene.bodies[0].drives[0].velocity[2](7) == 7);
    CHECK(scene.bodies[0].loads[0].value[2]({0, 0, 0.5}) == 0.5);
    CHECK(scene.walls[0].normal == Point{0, 0, 1});
    CHECK(scene.probes[0].at == Point{2, 1, 0.25});
    CHECK(scene.probes[0].axis == 2);
    check_resolved(file);
    check_solid_error(solid_scene(brick, "velocity = @[0, 0]"), {"velocity must be an array of 3"});
    check_solid_error(solid_scene("{ type = \"box\", low = @[0, 0], high = [1, 1, 1] }"),
                      {"low must be an array of 3 numbers", "not an array of 2"});
  }

  TEST_CASE(
      "scene in 3D: boxes, balls, shells and cylinders have their volumes, and invalid ones are refused") {
    const auto layout = [](const std::string& shape) {
      const SceneFile file = read_text(solid_scene(shape));
      check_resolved(file);
      return make_initial_particles(file.scene);
    };
    CHECK(layout(brick).size() == 20 * 10 * 5);
    const double ball = 4.0 / 3 * std::numbers::pi;
    CHECK(volume(layout("{ type = \"ball\", centre = [1, 2, 3], radius = 1 }")) == relative(ball, 0.01));
    CHECK(volume(layout("{ type = \"shell\", centre = [1, 2, 3], inner = 0.5, outer = 1 }")) ==
          relative(ball * 7 / 8, 0.01));
    const std::string pipe =
        "{ type = \"cylinder\", from = [0, 0, 0], to = [0, 3, 0], radius = 1, inner = 0.5";
    CHECK(volume(layout(pipe + " }")) == relative(2.25 * std::numbers::pi, 0.02));
    check_solid_error(solid_scene("{ type = \"cylinder\", from = [1, 2, 3], to = @[1, 2, 3], radius = 1 }"),
                      {"from and to are the same point"});
    check_solid_error(
        solid_scene("{ type = \"cylinder\", from = [0, 0, 0], to = [1, 0, 0], radius = 1, inner = @1 }"),
        {"inner = 1 must be less than radius = 1"});
    check_solid_error(solid_scene("{ type = \"shell\", centre = [0, 0, 0], inner = @2, outer = 1 }"),
                      {"inner = 2 must be less than outer = 1"});
    check_solid_error(
        solid_scene("{ type = \"ball\", centre = [0, 0, 0], radius = 1, @layout = \"spaced\" }"),
        {"unknown key 'layout'"});
    check_solid_error(solid_scene("{ type = \"box\", low = @[0, 0, 1], high = [1, 1, 0] }"),
                      {"low.z = 1 must be less than high.z = 0"});
  }

  TEST_CASE("scene in 3D: thin round walls are laid out in layers for methods with fixed neighbours") {
    const auto volume_of = [](const std::string& shape, const std::string& method) {
      const SceneFile file = read_text("method = \"" + method + "\"\n" + solid_scene(shape));
      check_resolved(file);
      return volume(make_initial_particles(file.scene));
    };
    const double ball = 4.0 / 3 * std::numbers::pi * 0.784, bar = 1.92 * std::numbers::pi;
    const std::string shell = "{ type = \"shell\", centre = [1, 2, 3], inner = 0.6, outer = 1",
                      pipe =
                          "{ type = \"cylinder\", from = [0, 0, 0], to = [0, 3, 0], radius = 1, inner = 0.6";
    for (const auto& [shape, exact] : {std::pair{shell, ball}, std::pair{pipe, bar}}) {
      CHECK(volume_of(shape + " }", "oenog") == relative(exact, 1e-12));
      CHECK(volume_of(shape + " }", "tl") == relative(exact, 1e-12));
      CHECK_FALSE(volume_of(shape + " }", "enog") == relative(exact, 1e-6));
      CHECK(volume_of(shape + ", layout = \"aligned\" }", "enog") == relative(exact, 1e-12));
      CHECK(volume_of(shape + ", layout = \"lattice\" }", "oenog") == volume_of(shape + " }", "enog"));
      check_solid_error(solid_scene(shape + ", layout = @\"spaced\" }"),
                        {"unknown layout 'spaced'", "aligned", "lattice"});
    }
    CHECK_FALSE(volume_of("{ type = \"shell\", centre = [1, 2, 3], inner = 0.5, outer = 1 }", "oenog") ==
                relative(4.0 / 3 * std::numbers::pi * 7 / 8, 1e-6));
    const std::string thick = "{ type = \"shell\", centre = [1, 2, 3], inner = 0.3, outer = 1";
    CHECK_FALSE(volume_of(thick + " }", "oenog") == relative(4.0 / 3 * std::numbers::pi * 0.973, 1e-6));
    check_solid_error(solid_scene(thick + ", layout = @\"aligned\" }"),
                      {"layout = \"aligned\" needs", "use \"lattice\""});
    check_solid_error(
        solid_scene(
            "{ type = \"cylinder\", from = [0, 0, 0], to = [0, 3, 0], radius = 1, layout = @\"aligned\" }"),
        {"layout", "inner"});
  }

  TEST_CASE("scene: a shape of the other dimension is refused, and the message names a shape to use") {
    const auto solid = [](const char* type, const char* instead) {
      check_solid_error(solid_scene(std::string("{ type = @\"") + type + "\" }"),
                        {type, "is a shape with dim = 2, but the scene has dim = 3; use ", instead});
    };
    solid("rectangle", "box");
    solid("disc", "ball");
    solid("ring", "shell");
    const auto flat = [](const char* type, const char* instead) {
      check_error("type = \"ring\"", std::string("type = @\"") + type + "\"",
                  {type, "is a shape with dim = 3, but the scene has dim = 2; use ", instead});
    };
    flat("box", "rectangle");
    flat("ball", "disc");
    flat("shell", "ring");
    flat("cylinder", "disc or rectangle");
    check_solid_error(solid_scene("{ type = @\"bal\" }"), {"unknown type 'bal'", "did you mean 'ball'"});
  }

  TEST_CASE("scene: held can have one expression per component") {
    const SceneFile file = read_text(solid_scene(
        brick, "velocity = [1, 2, 3]\nheld = [\"x < 0.1 || y < 0.1\", \"\", \"x < 0.1 && z < 0.1\"]"));
    check_resolved(file);
    const InitialParticles layout = make_initial_particles(file.scene);
    REQUIRE_FALSE(layout.guided.empty());
    for (int i = 0; i < layout.size(); ++i) {
      const Point& x = layout.x[i];
      const bool along_x = x[0] < 0.1 || x[1] < 0.1, along_z = x[0] < 0.1 && x[2] < 0.1;
      CHECK(layout.clamped[i] == 0);
      CHECK(layout.guided[i] == (along_x ? 1 : 0) + (along_z ? 4 : 0));
      CHECK(layout.v[i] == Point{along_x ? 0.0 : 1.0, 2, along_z ? 0.0 : 3.0});
    }
    const SceneFile all = read_text(solid_scene(brick, "held = [\"x < 0.3\", \"x < 0.2\", \"x < 0.1\"]"));
    check_resolved(all);
    const InitialParticles clamped = make_initial_particles(all.scene);
    for (int i = 0; i < clamped.size(); ++i) {
      const double x = clamped.x[i][0];
      CHECK(clamped.clamped[i] == (x < 0.1));
      CHECK(clamped.guided[i] == (x < 0.1 ? 0 : x < 0.2 ? 3 : x < 0.3 ? 1 : 0));
    }
    check_solid_error(solid_scene(brick, "held = @[\"x < 1\", 0]"), {"held must be an array of 3"});
    check_solid_error(solid_scene(brick, "held = [\"\", \"@q < 1\", 0]"), {"unknown name 'q'"});
    check_error("velocity = [\"v0*c0*x\", 0]", "velocity = [\"v0*c0*x\", 0]\nheld = @[\"x < 1\", 0, 0]",
                {"held must be an array of 2"});
  }

  TEST_CASE("scene: a body can have cut-outs, a rotation, particles on its boundary, and a displacement") {
    const SceneFile file =
        read_text(solid_scene(brick,
                              "without = [{ type = \"ball\", centre = [2, 1, 0.5], radius = 0.4 }, "
                              "{ type = \"box\", low = [0, 0, 0], high = [0.5, 0.5, 1] }]\n"
                              "rotate = { axis = [0, 0, 2], angle = \"45 + 45\", about = [2, 1, 0] }"));
    check_resolved(file);
    const Body& body = file.scene.bodies[0];
    REQUIRE(body.without.size() == 2);
    CHECK(body.without[0].as<Disc>()->radius == 0.4);
    CHECK(body.rotation->axis == Point{0, 0, 1});
    CHECK(body.rotation->about == Point{2, 1, 0});
    for (const Point& x : make_initial_particles(file.scene).x) CHECK((x[0] > 2 && x[0] < 3 && x[1] < 1));
    const SceneFile about_middle = read_text(solid_scene(brick, "rotate = { axis = [1, 0, 0], angle = 30 }"));
    check_resolved(about_middle);
    CHECK(about_middle.scene.bodies[0].rotation->about == Point{1, 0.5, 0.25});
    const SceneFile faces =
        read_text(solid_scene(brick, "on_boundary = true\ndisplacement = [0, \"0.1*x*z\", 0]"));
    check_resolved(faces);
    const InitialParticles layout = make_initial_particles(faces.scene);
    CHECK(layout.size() == 21 * 11 * 6);
    CHECK(layout.start.back()[1] == Approx(1 + 0.1 * 2 * 0.5));
    CHECK(resolved_text(file, scratch_folder()).find("on_boundary") == std::string::npos);
    check_solid_error(solid_scene(brick, "rotate = { axis = @[0, 0, 0], angle = 3 }"), {"has no length"});
    check_solid_error(solid_scene(brick, "rotate = @{ axis = [0, 0, 1] }"), {"'angle' is missing"});
    check_solid_error(solid_scene(brick, "rotate = @3"), {"must be a table"});
    check_solid_error(solid_scene(brick, "on_boundary = @1"), {"must be true or false, not a number"});
    check_solid_error(solid_scene("[" + brick + "," + brick + "]", "on_boundary = @true"),
                      {"one rectangle or box"});
    check_solid_error(solid_scene(brick, "displacement = @[1, 2]"), {"displacement must be an array of 3"});
    check_solid_error(solid_scene(brick, "without = { type = @\"disc\" }"), {"disc is a shape with dim = 2"});
    check_error("velocity = [\"v0*c0*x\", 0]",
                "rotate = { @axis = [0, 0, 1], angle = 3 }\nvelocity = [\"v0\", 0]",
                {"'axis' has no effect"});
  }

  TEST_CASE("scene: in 3D the constants of a method have their 3D defaults") {
    const auto constant = [](const std::string& text, const char* method, const char* name) {
      return read_text(text, {{.name = "method", .value = method}}).settings.constants.at(name);
    };
    const std::string solid = solid_scene(brick);
    CHECK(constant(solid, "oenog", "h") == 0.9);
    CHECK(constant(solid, "enog", "zeta") == relative(0.7 * 3 + 2.1));
    CHECK(constant(small_scene, "oenog", "h") == 0.8);
    const std::string oenog = "method = \"oenog\"\nmethod_constants = { h = ";
    std::string inside = solid_scene(brick), outside = inside;
    inside.insert(0, oenog + "0.95 }\n");
    outside.insert(0, oenog + "@0.8 }\n");
    CHECK(constant(inside, "oenog", "h") == 0.95);
    check_solid_error(outside, {"h = 0.8 is out of bounds", "0.87 to 0.99"});
    CHECK(constant(small_scene, "enog", "zeta") == relative(0.7 * 2 + 2.1));
  }

  TEST_CASE("scene: the reference of the plate in 3D depends on the mode, the method and the support") {
    const auto period = [](const char* method, const char* m, const char* n, const char* ring) {
      const SceneFile file =
          read_scene(find_scene("oscillating-plate-3d"), {{.name = "method", .value = method},
                                                          {.name = "m", .value = m},
                                                          {.name = "n", .value = n},
                                                          {.name = "ring", .value = ring}});
      return file.scene.references.at("neo_hookean").value.at("period");
    };
    CHECK(period("oenog", "1", "1", "0") == 0.0517);
    CHECK(period("oenog", "2", "1", "0") == 0.02141);
    CHECK(period("enog", "1", "1", "1") == 0.0572);
    CHECK(period("enog", "2", "2", "1") == 0.0148);
    CHECK(period("oenog", "1", "1", "1") == 0.0524);
  }

  TEST_CASE("scene: an error of the layout is reported at its key") {
    const auto refused = [](const std::string& keys, const char* part) {
      const SceneFile file = read_text(solid_scene(brick, keys));
      try {
        make_initial_particles(file.scene);
        FAIL_CHECK("no error");
      } catch (const SceneError& error) {
        const SceneError located = locate(file, error);
        CHECK(located.line == 13);
        CHECK(std::string(located.what()).find(part) != std::string::npos);
      }
    };
    refused("without = { type = \"ball\", centre = [9, 9, 9], radius = 1 }",
            "without: shape 1 removes no particle of body 'thing'");
    refused("loaded = [{ where = 1, traction = [1, 0, 0] }]\non_boundary = true", "give the total force");
  }
}
