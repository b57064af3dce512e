#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <numeric>

#include <doctest/doctest.h>

#include "cli/formats/mask.hpp"
#include "cli/formats/particle_file.hpp"
#include "cli/scene/scene_file.hpp"
#include "engine/error.hpp"
#include "engine/layout/initial_particles.hpp"
#include "render/image/png.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/scene_text.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

constexpr std::string_view block = R"({ type = "rectangle", low = [0, 0], high = [2, 1] })";

std::string scene_text(const std::string& shape, const std::string& keys = "", int dim = 2) {
  return "dim = " + std::to_string(dim) + R"(
spacing = 0.05
until = 1
[parameters]
r = { value = 0.8 }
[material.rubber]
density = 1200
youngs_modulus = 1e7
poisson_ratio = 0.4
[[body]]
name = "body"
velocity = ["r", )" +
         (dim == 3 ? "0, " : "") + "0]\nmaterial = \"rubber\"\nshape = " + shape + "\n" + keys + "\n";
}

InitialParticles laid(const std::string& text) {
  const SceneFile file = read_text(text);
  const InitialParticles layout = make_initial_particles(file.scene);
  const SceneFile again = read_text(resolved_text(file, scratch_folder()));
  CHECK(make_initial_particles(again.scene).x == layout.x);
  CHECK(make_initial_particles(again.scene).V0 == layout.V0);
  return layout;
}

double volume(const InitialParticles& layout) {
  return std::accumulate(layout.V0.begin(), layout.V0.end(), 0.0);
}

void write_file(const std::string& name, std::string_view text) {
  std::ofstream(scratch_folder() / name, std::ios::binary) << text;
}

void check_shape_error(const std::string& shape, std::initializer_list<const char*> parts) {
  check_error(block, shape, parts);
}

std::string error_in_file(const std::string& text, int line) {
  try {
    read_text(text);
  } catch (const SceneError& error) {
    CHECK(error.line == line);
    return error.what();
  }
  FAIL("no error");
  return "";
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE(
      "shapes: ellipses, polygons, expressions and combinations are filled, and equal in the resolved text") {
    const double pi = std::numbers::pi;
    CHECK(volume(laid(
              scene_text(R"({ type = "ellipse", centre = [0, 0], semi_axes = [2, "r"], rotate = 30 })"))) ==
          relative(pi * 1.6, 0.01));
    CHECK(
        volume(laid(scene_text(
            R"({ type = "polygon", contours = [[[0, 0], [4, 0], [4, 2], [0, 2]], [["r", 0.5], [2, 0.5], [2, 1.5], ["r", 1.5]]] })"))) ==
        relative(8 - 1.2, 1e-9));
    CHECK(volume(laid(scene_text(
              R"({ type = "expression", inside = "x^2 + y^2 < r^2", low = [-1, -1], high = [1, 1] })"))) ==
          relative(pi * 0.64, 0.01));
    CHECK(
        volume(laid(scene_text(
            R"({ type = "difference", shapes = [{ type = "union", shapes = [{ type = "rectangle", low = [0, 0], high = [2, 1] }, { type = "rectangle", low = [1, 0], high = [3, 2] }] }, { type = "intersection", shapes = [{ type = "disc", centre = [2, 1], radius = 0.5 }, { type = "rectangle", low = [2, 0], high = [3, 2] }] }] })"))) ==
        relative(5 - pi / 8, 0.01));
    CHECK(
        volume(laid(scene_text(
            R"({ type = "ellipsoid", centre = [0, 0, 0], semi_axes = [1, "r", 0.5], rotate = { axis = [1, 1, 0], angle = 20 } })",
            "", 3))) == relative(4 * pi / 3 * 0.4, 0.02));
  }

  TEST_CASE(
      "shapes: combinations nest at most eight levels, and their outlines do not grow with each level") {
    const std::string disc = R"({ type = "disc", centre = [0, 0], radius = 1 })";
    const auto nested = [&](int levels) {
      std::string shape = disc;
      for (int k = 0; k < levels; ++k)
        shape = R"({ type = "union", shapes = [)" + shape + ", " + disc + "] }";
      return shape;
    };
    const auto points = [&](int levels) {
      const SceneFile file = read_text(scene_text(nested(levels)));
      std::size_t sum = 0;
      for (const Chain& chain : file.scene.bodies[0].shapes[0]->outline(2, 0.05)) sum += chain.size();
      return sum;
    };
    CHECK(points(8) == points(1));
    CHECK(volume(laid(scene_text(nested(8)))) == relative(std::numbers::pi, 0.01));
    std::string deep = nested(9);
    deep.insert(deep.rfind("shapes = [{ type = \"disc\"") + std::string("shapes = ").size(), "@");
    check_shape_error(deep, {"nested more than 8 levels deep", "use fewer levels"});
  }

  TEST_CASE("shapes: rotate can be a number in 2D, for a shape as for a body") {
    const std::string box = R"({ type = "rectangle", low = [0, 0], high = [2, 1])";
    const InitialParticles turned = laid(scene_text(box + ", rotate = 30 }"));
    CHECK(turned.x == laid(scene_text(box + "}", "rotate = 30")).x);
    CHECK(turned.x == laid(scene_text(box + ", rotate = { angle = 30, about = [1, 0.5] } }")).x);
    CHECK(laid(scene_text(box + ", rotate = { angle = 30, about = [0, 0] } }")).x ==
          laid(scene_text(box + "}", "rotate = { angle = 30, about = [0, 0] }")).x);
    check_error("name = \"block\"\nshape = " + std::string(block),
                "name = \"block\"\nrotate = @true\nshape = " + std::string(block),
                {"rotate must be a number"});
  }

  TEST_CASE("shapes: a body can have a hexagonal lattice") {
    const InitialParticles layout =
        laid(scene_text(R"({ type = "disc", centre = [0, 0], radius = 2 })", "lattice = \"hexagonal\""));
    CHECK(volume(layout) == relative(4 * std::numbers::pi, 0.01));
    check_error("name = \"block\"", "name = \"block\"\nlattice = @\"cubic\"", {"square", "hexagonal"});
    check_error("name = \"block\"", "name = \"block\"\non_boundary = true\nlattice = @\"hexagonal\"",
                {"on_boundary"});
    check_error("name = \"ring\"\nshape = { type = \"ring\",",
                "name = \"ring\"\nlattice = \"hexagonal\"\nshape = { layout = @\"spaced\", type = \"ring\",",
                {"unknown layout 'spaced'", "lattice"});
  }

  TEST_CASE(
      "shapes: a relaxed layout has the volume of its shape, and needs a square lattice without on_boundary") {
    const std::string disc = R"({ type = "disc", centre = [0, 0], radius = 2 })";
    const InitialParticles relaxed = laid(scene_text(disc, "layout = \"relaxed\""));
    CHECK(relaxed.x != laid(scene_text(disc, "layout = \"regular\"")).x);
    CHECK(volume(relaxed) == relative(4 * std::numbers::pi, 1e-12));
    const std::string ball = R"({ type = "ball", centre = [0, 0, 0], radius = 0.3 })";
    CHECK(volume(laid(scene_text(ball, "layout = \"relaxed\"", 3))) ==
          relative(0.036 * std::numbers::pi, 1e-12));
    check_error("name = \"block\"", "name = \"block\"\nlayout = @\"aligned\"", {"regular", "relaxed"});
    check_error("name = \"block\"", "name = \"block\"\non_boundary = true\nlayout = @\"relaxed\"",
                {"on_boundary"});
    check_error("name = \"block\"", "name = \"block\"\nlattice = \"hexagonal\"\nlayout = @\"relaxed\"",
                {"square lattice", "hexagonal"});
  }

  TEST_CASE("shapes: invalid polygons, ellipses, expressions and combinations are refused at their place") {
    check_shape_error(R"({ type = "polygon", points = @[[0, 0], [1, 0], [0, 0]] })",
                      {"at least three points, but this one has 2"});
    check_shape_error(R"({ type = "polygon", points = @[] })", {"at least three points"});
    check_shape_error(R"({ type = "polygon", contours = @[] })", {"array of contours"});
    check_shape_error(R"({ type = "polygon", points = [[0, 0], @[1], [0, 1]] })",
                      {"[x, y]", "not an array of 1"});
    check_shape_error(R"({ type = "polygon", points = [[0, 0], [@"0/0", 0], [0, 1]] })", {"finite"});
    check_shape_error(R"({ type = "polygon", points = @[[0, 0], [2, 2], [2, 0], [0, 2]] })",
                      {"cross", "at (1, 1) m"});
    check_shape_error(R"({ type = "polygon", points = @[[0, 0], [1, 1], [2, 2]] })", {"lie on"});
    check_shape_error(R"({ type = "polygon", points = [[0, 0], [1, 0], [0, 1]], contours = @[] })",
                      {"contours and points are both given"});
    check_shape_error(R"({ type = "ellipse", centre = [0, 0], semi_axes = [1, @0] })",
                      {"semi_axes[1]", "greater than 0"});
    check_shape_error(R"({ type = @"ellipsoid", centre = [0, 0], semi_axes = [1, 1] })", {"use ellipse"});
    check_shape_error(R"({ type = "expression", inside = @0, low = [0, 0], high = [1, 1] })",
                      {"so the shape is empty"});
    check_shape_error(R"({ type = "expression", inside = @"0", low = [0, 0], high = [1, 1] })",
                      {"so the shape is empty"});
    check_shape_error(R"({ type = "expression", inside = "x < @q", low = [0, 0], high = [1, 1] })",
                      {"unknown name 'q'"});
    check_shape_error(R"({ type = "union", shapes = @[{ type = "disc", centre = [0, 0], radius = 1 }] })",
                      {"at least two"});
    check_shape_error(
        R"({ type = "difference", shapes = [{ type = "disc", centre = [0, 0], radius = 1 }, { type = "disc", centre = [0, 0], radius = @0 }] })",
        {"greater than 0"});
  }

  TEST_CASE(
      "scene: with oenog in 3D, `touching` is 0.1 dp for listed particles and 0 for a body with faces") {
    write_file("given.csv", "x,y,z\n0,0,0\n0.05,0,0\n");
    const std::string_view probe_and_measure = R"([[probe]]
name = "tip"
of = "displacement"
body = "body"
at = [0, 0, 0]
component = "x"
[[measure]]
name = "met"
of = "first_below"
probe = "tip"
threshold = "touching"
unit = "s"
)";
    const auto touching = [&](const std::string& shape) {
      const SceneFile file =
          read_text(scene_text(shape, std::string(probe_and_measure), 3), {{"method", "oenog"}});
      return file.scene.measures.at(0).threshold;
    };
    CHECK(touching(R"({ type = "particles", file = "given.csv" })") == relative(0.1 * 0.05));
    CHECK(touching(R"({ type = "box", low = [0, 0, 0], high = [1, 1, 1] })") == 0);
  }

  TEST_CASE("shapes: particles are read from a table") {
    write_file("given.csv", "# three\nx, y, volume\n0, 0, 0.001\n1, 0, 0.002\n0, 1, 0.003\n");
    const InitialParticles layout = laid(scene_text(R"({ type = "particles", file = "given.csv" })"));
    CHECK(layout.x == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    CHECK(layout.V0 == std::vector<double>{0.001, 0.002, 0.003});
    write_file("plain.csv", "\xEF\xBB\xBFz,y,x\n0,1,2\n0,1,2.05\n");
    CHECK(laid(scene_text(R"({ type = "particles", file = "plain.csv" })", "", 3)).V0[1] ==
          relative(1.25e-4));
    check_shape_error(R"({ type = "particles", file = @"absent.csv" })",
                      {"there is no file", "absent.csv", "scene's folder"});
    check_shape_error(
        R"([{ type = @"particles", file = "given.csv" }, { type = "disc", centre = [0, 0], radius = 1 }])",
        {"must be the only shape of its body"});
    const std::string bad = scene_text(R"({ type = "particles", file = "bad.csv" })");
    const auto error_of = [&](std::string_view table, int line) {
      write_file("bad.csv", table);
      return error_in_file(bad, line);
    };
    CHECK(error_of("x,y\n0,0\n0,nan\n", 3).find("finite") != std::string::npos);
    CHECK(error_of("x,y,volume\n0,0,1\n0,1,-1\n", 3).find("greater than 0") != std::string::npos);
    CHECK(error_of("x,y\n0,0\n1,1\n0,0\n", 0).find("particles 1 and 3") != std::string::npos);
    CHECK(error_of("x,y,mass\n0,0,1\n", 1).find("unknown column 'mass'") != std::string::npos);
    CHECK(error_of("x\n0\n", 1).find("no column 'y'") != std::string::npos);
    CHECK(error_of("x,y\n", 1).find("no rows") != std::string::npos);
    CHECK(error_of("", 0).find("empty") != std::string::npos);
    for (const char* far :
         {"x,y\n0,0\n1e7,0\n", "x,y\n0,0\n1e300,0\n", "x,y\n1e12,0\n1e12,1\n", "x,y\n0,0\n9e3,9e3\n"})
      CHECK(error_of(far, 0).find("too far apart, or too far from the origin") != std::string::npos);
    CHECK(error_of("x,y,volume\n0,0,6e-4\n.1,.1,6e-4\n", 0).find("about 0.0245 m apart") !=
          std::string::npos);
    for (const auto* other : {"x,y\n0,0\n.1,0\n.2,0\n0,.1\n", "x,y\n0,0\n.025,0\n.025,.025\n"})
      CHECK(error_of(other, 0).find("without a column volume") != std::string::npos);
    CHECK(error_of("x,y,volume\n0,0,1e-300\n1,1,1\n", 0).find("does not fit a spacing") != std::string::npos);
  }

  TEST_CASE("shapes: particles are read from a saved file, of one body or of all") {
    Snapshot now;
    now.dim = 2;
    now.x = {0, 0, 0.05, 0, 1, 1, 2, 0.1};
    now.x0 = now.x, now.v.assign(8, 3);
    now.m.assign(4, 1), now.rho.assign(4, 1), now.diameter = {0.05, 0.05, 0.05, 0.06};
    now.body = {0, 0, 1, 1}, now.material = {0, 0, 0, 0}, now.clamped.assign(4, 0);
    write_file("saved.vtp", particle_file_text(now, {}));
    const InitialParticles all = laid(scene_text(R"({ type = "particles", file = "saved.vtp" })"));
    CHECK(all.x == std::vector<Point>{{0, 0, 0}, {0.05, 0, 0}, {1, 1, 0}, {2, 0.1, 0}});
    CHECK(all.V0[0] == relative(0.0025));
    CHECK(all.V0[3] == relative(0.0036));
    const InitialParticles one =
        laid(scene_text(R"({ type = "particles", file = "saved.vtp", of_body = 1 })"));
    CHECK(one.x == std::vector<Point>{{1, 1, 0}, {2, 0.1, 0}});
    check_shape_error(R"({ type = "particles", file = @"saved.vtp", of_body = 2 })",
                      {"saved.vtp contains no particle of body 2"});
    check_shape_error(R"({ type = "particles", file = "saved.vtp", of_body = @-1 })",
                      {"whole number from 0"});
    now.diameter[2] = std::nan("");
    write_file("odd.vtp", particle_file_text(now, {}));
    now.diameter[2] = 0.05;
    check_shape_error(R"({ type = "particles", file = @"odd.vtp" })", {"particle 3", "diameter of nan"});
    write_file("given.csv", "x, y\n0, 0\n1, 0\n");
    check_shape_error(R"({ type = "particles", file = "given.csv", of_body = @1 })", {"a .vtp file"});
    write_file("cut.vtp", particle_file_text(now, {}).substr(0, 900));
    check_shape_error(R"({ type = "particles", file = @"cut.vtp" })", {"is not a particle file of taut"});
    now.dim = 3;
    now.x = {0, 0, 0, 0.05, 0, 0, 1, 1, 0.1, 2, 0.1, 0}, now.x0 = now.x, now.v.assign(12, 3);
    write_file("solid.vtp", particle_file_text(now, {}));
    check_shape_error(R"({ type = "particles", file = @"solid.vtp" })",
                      {"is a file of a scene with dim = 3"});
    CHECK(laid(scene_text(R"({ type = "particles", file = "solid.vtp" })", "", 3)).x[2] == Point{1, 1, 0.1});
    now.x[4] = std::nan("");
    write_file("nowhere.vtp", particle_file_text(now, {}));
    check_shape_error(R"({ type = "particles", file = @"nowhere.vtp" })",
                      {"particle 2", "has the coordinate nan"});
  }

  TEST_CASE("shapes: a mask is the dark part of a picture, or the light part") {
    render::Image image(40, 20);
    for (int row = 0; row < 20; ++row)
      for (int column = 0; column < 10; ++column) image.set(column, row, {20, 20, 20});
    render::write_png(image, scratch_folder() / "mask.png");
    const InitialParticles dark =
        laid(scene_text(R"({ type = "mask", file = "mask.png", height = 2, low = [0, 0] })"));
    CHECK(volume(dark) == relative(2.0, 0.03));
    CHECK(std::ranges::max(dark.x)[0] < 1.03);
    const InitialParticles light = laid(
        scene_text(R"({ type = "mask", file = "mask.png", width = 4, centre = [0, 0], inside = "light" })"));
    CHECK(volume(light) == relative(6.0, 0.03));
    CHECK(std::ranges::min(light.x)[0] > -1.03);
    check_shape_error(R"({ type = "mask", file = @"mask.png", height = 2, low = [0, 0], threshold = 0.97 })",
                      {"no part of the picture is inside"});
    check_shape_error(R"({ type = "mask", file = "mask.png", height = 2, low = [0, 0], threshold = @1 })",
                      {"must be greater than 0 and below 1"});
    check_shape_error(R"({ type = "mask", file = "mask.png", height = @-1, low = [0, 0] })",
                      {"greater than 0"});
    check_shape_error(R"({ type = "mask", file = "mask.png", height = 1, low = @[0, 0], centre = [0, 0] })",
                      {"low and centre are both given"});
    check_shape_error(R"(@{ type = "mask", file = "mask.png", height = 1 })", {"'centre' is missing"});
    write_file("text.png", "no picture");
    check_shape_error(R"({ type = "mask", file = @"text.png", height = 1, low = [0, 0] })", {"not a PNG"});
    render::write_png(render::Image(4097, 1), scratch_folder() / "large.png");
    check_shape_error(R"({ type = "mask", file = @"large.png", height = 1, low = [0, 0] })",
                      {"4097", "4096"});
  }

  TEST_CASE("shapes: an SVG file is filled by its fill rules") {
    const auto file = [](const std::string& rule) {
      write_file(
          "ring.svg",
          R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 400 300"><path fill="gold" fill-rule=")" +
              rule + R"(" d="M50 50 H250 V150 H50 Z M100 75 H200 V125 H100 Z"/></svg>)");
      return scene_text(R"({ type = "svg", file = "ring.svg", height = 2, low = [1, 1] })");
    };
    const InitialParticles whole = laid(file("nonzero"));
    CHECK(volume(whole) == relative(8.0, 0.01));
    CHECK(std::ranges::min(whole.x)[0] == relative(1.025, 0.01));
    CHECK(volume(laid(file("evenodd"))) == relative(6.0, 0.01));
    write_file(
        "up.svg",
        R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10"><path d="M0 0 L10 10 H0 Z"/></svg>)");
    const InitialParticles corner =
        laid(scene_text(R"({ type = "svg", file = "up.svg", width = 4, centre = [0, 0] })"));
    CHECK(volume(corner) == relative(8.0, 0.02));
    CHECK(std::ranges::count_if(corner.x, [](const Point& x) { return x[1] > -x[0] + 0.1; }) == 0);
    write_file("empty.svg", R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10"/>)");
    check_shape_error(R"({ type = "svg", file = @"empty.svg", height = 1, low = [0, 0] })",
                      {"paints nothing"});
    write_file("broken.svg", "<svg");
    check_shape_error(R"({ type = "svg", file = @"broken.svg", height = 1, low = [0, 0] })",
                      {"is not an SVG file"});
    write_file("huge.svg", std::string((4 << 20) + 1, ' '));
    check_shape_error(R"({ type = "svg", file = @"huge.svg", height = 1, low = [0, 0] })",
                      {"larger than 4 MiB"});
  }

  TEST_CASE("shapes: a mesh is filled, scaled and placed, and an open one is refused") {
    const std::string points = "v 0 0 0\nv 1000 0 0\nv 0 1000 0\nv 0 0 1000\n";
    const std::string three = "f 1 3 2\nf 1 2 4\nf 2 3 4\n";
    write_file("tetrahedron.obj", points + three + "f 1 4 3\n");
    write_file("open.obj", points + three);
    write_file("turned.obj", points + three + "f 1 3 4\n");
    write_file("facet.stl",
               "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
               "endfacet\nendsolid a\n");
    write_file("part.ply", "ply\n");
    const auto shape = [](const std::string& file, const std::string& more = "") {
      return "{ type = \"mesh\", file = \"" + file + "\", scale = 0.001" + more + " }";
    };
    const InitialParticles layout = laid(scene_text(shape("tetrahedron.obj"), "", 3));
    CHECK(volume(layout) == relative(1.0 / 6, 0.1));
    for (const Point& x : layout.x) CHECK(x[0] + x[1] + x[2] < 1 + 1e-6);
    const InitialParticles moved = laid(scene_text(shape("tetrahedron.obj", ", centre = [5, 0, 0]"), "", 3));
    for (const Point& x : moved.x) CHECK(std::abs(x[0] - 5) < 0.5);
    for (const auto& [file, message] : {std::pair{"open.obj", "is not closed: it has 3 open edges"},
                                        {"facet.stl", "is not closed: it has 3 open edges"},
                                        {"turned.obj", "has 3 edges whose triangles face opposite sides"},
                                        {"part.ply", "must be an STL or OBJ file"}})
      CHECK_THROWS_WITH_AS(read_text(scene_text(shape(file), "", 3)), doctest::Contains(message), SceneError);
  }
}
