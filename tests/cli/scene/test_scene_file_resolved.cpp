#include <algorithm>

#include <doctest/doctest.h>

#include "cli/scene/scene_file.hpp"
#include "cli/scene/shipped.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"
#include "engine/layout/initial_particles.hpp"
#include "engine/scene/shapes/box.hpp"
#include "engine/scene/shapes/round_shapes.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/scene_text.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

void check_same(const Expression& a, const Expression& b) {
  REQUIRE(static_cast<bool>(a) == static_cast<bool>(b));
  if (!a) return;
  for (const Point& x : {Point{0, 0, 0}, Point{0.0731, -0.003, 0}, Point{-0.3, 0.1, 0}}) CHECK(a(x) == b(x));
}

void check_same(const Drive& a, const Drive& b) {
  CHECK(a.until == b.until);
  check_same(a.where, b.where);
  for (std::size_t k = 0; k < 3; ++k) {
    REQUIRE(static_cast<bool>(a.velocity[k]) == static_cast<bool>(b.velocity[k]));
    for (const double t : {0.0, 0.3})
      if (a.velocity[k]) CHECK(a.velocity[k](t) == b.velocity[k](t));
  }
}

void check_same(const std::vector<Solution>& a, const std::vector<Solution>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t k = 0; k < a.size(); ++k)
    for (const double t : {0.0, 1.37e-4, 0.2}) CHECK(a[k]({0.31, 0, 0}, t) == b[k]({0.31, 0, 0}, t));
}

template <class... Kinds>
bool equal_as(const Shape& a, const Shape& b) {
  return ((a.as<Kinds>() && b.as<Kinds>() && *a.as<Kinds>() == *b.as<Kinds>()) || ...);
}

bool is_simple(const Shape& shape) { return equal_as<Box, Disc, Ring, Cylinder>(shape, shape); }

void check_same(const Body& a, const Body& b) {
  CHECK(a.name == b.name);
  CHECK(a.material == b.material);
  CHECK(a.mirror == b.mirror);
  REQUIRE(a.shapes.size() == b.shapes.size());
  for (std::size_t i = 0; i < a.shapes.size(); ++i)
    if (is_simple(a.shapes[i])) CHECK(equal_as<Box, Disc, Ring, Cylinder>(a.shapes[i], b.shapes[i]));
  CHECK(a.lattice == b.lattice);
  for (std::size_t k = 0; k < 3; ++k) check_same(a.velocity[k], b.velocity[k]);
  check_same(a.clamped, b.clamped);
  REQUIRE(a.parts.size() == b.parts.size());
  for (std::size_t i = 0; i < a.parts.size(); ++i) {
    CHECK(a.parts[i].material == b.parts[i].material);
    check_same(a.parts[i].where, b.parts[i].where);
  }
  REQUIRE(a.drives.size() == b.drives.size());
  for (std::size_t i = 0; i < a.drives.size(); ++i) check_same(a.drives[i], b.drives[i]);
}

void check_same(const Scene& a, const Scene& b) {
  CHECK(a.name == b.name);
  CHECK(a.title == b.title);
  CHECK(a.source == b.source);
  CHECK(a.spacing == b.spacing);
  CHECK(a.until == b.until);
  CHECK(a.contact == b.contact);
  REQUIRE(a.materials.size() == b.materials.size());
  for (std::size_t i = 0; i < a.materials.size(); ++i) {
    CHECK(a.materials[i].density == b.materials[i].density);
    CHECK(a.materials[i].youngs_modulus == b.materials[i].youngs_modulus);
    CHECK(a.materials[i].poisson_ratio == b.materials[i].poisson_ratio);
    CHECK(a.materials[i].bulk_modulus() == b.materials[i].bulk_modulus());
  }
  REQUIRE(a.bodies.size() == b.bodies.size());
  for (std::size_t i = 0; i < a.bodies.size(); ++i) check_same(a.bodies[i], b.bodies[i]);
  const auto is_other = [](const Body& body) { return !is_simple(body.shapes.front()); };
  if (std::ranges::any_of(a.bodies, is_other))
    CHECK(make_initial_particles(a).x == make_initial_particles(b).x);
  REQUIRE(a.probes.size() == b.probes.size());
  for (std::size_t i = 0; i < a.probes.size(); ++i) {
    CHECK(a.probes[i].kind == b.probes[i].kind);
    CHECK(a.probes[i].at == b.probes[i].at);
    CHECK(a.probes[i].to == b.probes[i].to);
  }
  REQUIRE(a.lines.size() == b.lines.size());
  for (std::size_t i = 0; i < a.lines.size(); ++i) {
    CHECK(a.lines[i].name == b.lines[i].name);
    CHECK(a.lines[i].body == b.lines[i].body);
    CHECK(a.lines[i].field == b.lines[i].field);
    CHECK(a.lines[i].from == b.lines[i].from);
    CHECK(a.lines[i].to == b.lines[i].to);
    CHECK(a.lines[i].points == b.lines[i].points);
    CHECK(a.lines[i].times == b.lines[i].times);
  }
  REQUIRE(a.measures.size() == b.measures.size());
  for (std::size_t i = 0; i < a.measures.size(); ++i) {
    CHECK(a.measures[i].scale == b.measures[i].scale);
    CHECK(a.measures[i].probes == b.measures[i].probes);
    CHECK(a.measures[i].line == b.measures[i].line);
  }
  REQUIRE(a.references.size() == b.references.size());
  for (const auto& [law, reference] : a.references) {
    const Reference& other = b.references.at(law);
    CHECK(reference.name == other.name);
    CHECK(reference.value == other.value);
    REQUIRE(reference.table.size() == other.table.size());
    for (const auto& [measure, table] : reference.table) CHECK(table.value == other.table.at(measure).value);
    REQUIRE(reference.solution.size() == other.solution.size());
    for (const auto& [measure, solution] : reference.solution)
      check_same(solution, other.solution.at(measure));
  }
}

void check_same(const SceneFile& a, const SceneFile& b) {
  check_same(a.scene, b.scene);
  CHECK(a.settings.method == b.settings.method);
  CHECK(a.settings.constants == b.settings.constants);
  CHECK(a.settings.stepping == b.settings.stepping);
  CHECK(a.settings.cfl == b.settings.cfl);
  CHECK(a.history == b.history);
  CHECK(a.drawing.field == b.drawing.field);
  CHECK(a.drawing.look.range == b.drawing.look.range);
  CHECK(a.drawing.look.colormap == b.drawing.look.colormap);
  CHECK(a.drawing.look.view == b.drawing.look.view);
  CHECK(a.drawing.look.size == b.drawing.look.size);
  CHECK(a.drawing.frames == b.drawing.frames);
  REQUIRE(a.parameters.size() == b.parameters.size());
  for (std::size_t i = 0; i < a.parameters.size(); ++i) {
    CHECK(a.parameters[i].name == b.parameters[i].name);
    CHECK(a.parameters[i].value == b.parameters[i].value);
    CHECK(a.parameters[i].default_value == b.parameters[i].default_value);
    CHECK(a.parameters[i].low == b.parameters[i].low);
  }
  CHECK(resolved_text(a, scratch_folder()) == resolved_text(b, scratch_folder()));
}

SceneFile check_round_trip(const SceneFile& file) {
  const SceneFile again = read_text(resolved_text(file, scratch_folder()));
  check_same(file, again);
  return again;
}

std::vector<Setting> set(const std::vector<std::pair<std::string, std::string>>& values) {
  std::vector<Setting> settings;
  for (const auto& [name, value] : values) settings.push_back({name, value});
  return settings;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("every scene equals the scene read from its resolved text") {
    for (const std::string& name : scene_names()) {
      INFO("scene ", name);
      const SceneFile file = read_scene(find_scene(name));
      const SceneFile again = check_round_trip(file);
      CHECK(again.scene.name == std::filesystem::path(name).stem());
      CHECK(resolved_text(file, scratch_folder()).find(scene_folders().back().string()) == std::string::npos);
      CHECK(again.scene.references.size() == file.scene.references.size());
    }
  }

  TEST_CASE(
      "the resolved text contains contact, parts, driven and loaded regions, gravity and a bulk modulus") {
    const std::string text = replaced(
        replaced(
            small_scene, "material = \"rubber\"\nvelocity",
            "material = \"rubber\"\nparts = [{ material = \"steel\", where = \"x > 1\" }]\n"
            "driven = [{ where = \"x < dp\", velocity = [\"v0*c0*sin(pi*t)\", 0], until = \"until0\" },\n"
            "          { where = \"y < dp\", velocity = [0, 1] }]\n"
            "loaded = [{ where = \"x > 1\", force = [\"v0*t0*y\", 0], ramp = \"t/t0\" }]\nvelocity"),
        "[material.rubber]",
        "until0 = { value = 0.5 }\nt0 = { value = 2 }\n"
        "[material.steel]\ndensity = 8000\nyoungs_modulus = 2e11\npoisson_ratio = 0.3\n"
        "bulk_modulus = \"E\"\n[material.rubber]");
    const SceneFile file = read_text("gravity = [0, \"-9*t/t0\"]\ndamping = \"t0\"\n" + text,
                                     set({{"contact", "impulse"}, {"until0", "0.7"}, {"t0", "4"}}));
    const SceneFile again = check_round_trip(file);
    CHECK(again.scene.gravity[1](2) == -4.5);
    CHECK(again.scene.damping == 4);
    CHECK(again.scene.bodies[0].loads.at(0).ramp(1) == 0.25);
    CHECK(again.scene.bodies[0].loads[0].value[0]({0, 3, 0}) == Approx(0.72));
    CHECK(again.scene.contact == ContactLaw::impulse);
    CHECK(again.scene.materials[0].bulk_modulus() == 2e11);
    CHECK(again.scene.bodies[0].parts[0].material == 0);
    CHECK(again.scene.bodies[0].drives[0].until == 0.7);
    CHECK_FALSE(again.scene.bodies[0].drives[1].until);
    CHECK(read_text(small_scene, set({{"method", "oenog"}})).scene.contact == ContactLaw::published);
  }

  TEST_CASE("the resolved text contains overrides") {
    const SceneFile file = read_scene(find_scene("oscillating-plate"), set({{"spacing", "0.0033"},
                                                                            {"vf", "0.03/3"},
                                                                            {"stepping", "single"},
                                                                            {"cfl", "0.1/3"},
                                                                            {"jitter", "8*vf"},
                                                                            {"jitter_seed", "7"},
                                                                            {"until", "1/3"}}));
    CHECK(file.scene.spacing == 0.02 / 6);
    CHECK(file.parameters[0].value == 0.01);
    CHECK(file.parameters[0].default_value == 0.05);
    const SceneFile again = check_round_trip(file);
    CHECK(again.scene.references.at("2d_deviator").value.at("period") == 0.25682);
    CHECK(again.settings.cfl == 0.1 / 3);
    CHECK(again.settings.stepping == Stepping::single);
    CHECK(again.scene.jitter.share == 8 * (0.03 / 3));
    CHECK(again.scene.jitter.seed == 7);
    CHECK(again.scene.until == 1.0 / 3);
    CHECK(*again.history == 1.0 / 3 / 1000);
  }

  TEST_CASE("a scene that has no reference because of an override has none in the resolved text") {
    const SceneFile file = read_scene(find_scene("ball-plate"), set({{"v0", "0.06"}, {"fixed", "8*dp"}}));
    CHECK(file.scene.references.empty());
    CHECK(file.parameters[5].value == 8 * 0.0025);
    check_round_trip(file);
  }

  TEST_CASE("a parameter unused because of an override is not an error in the resolved text") {
    const std::string text = replaced(replaced(small_scene, "until = 2", "until = \"length\""), "[material",
                                      "length = { value = 4 }\n[material");
    check_round_trip(read_text(text, set({{"until", "3"}})));
  }

  TEST_CASE("the constants and CFL number of a scene hold only for its method") {
    const std::string text =
        replaced(small_scene, "until = 2",
                 "until = 2\nmethod = \"enog\"\ncfl = 0.123\nmethod_constants = { zeta = 4.25 }");
    CHECK(read_text(text).settings.cfl == 0.123);
    CHECK(read_text(text).settings.constants.at("zeta") == 4.25);
    CHECK(read_text(text, set({{"method", "enog"}})).settings.cfl == 0.123);
    const SceneFile other = read_text(text, set({{"method", "og"}}));
    CHECK(other.settings.method == "og");
    CHECK(other.settings.cfl != 0.123);
    CHECK_FALSE(other.settings.constants.contains("zeta"));
    check_round_trip(other);
  }

  TEST_CASE("a constant with named values accepts only these names") {
    const std::string method = "until = 2\nmethod = \"d-ulsph-r-tic\"",
                      text = replaced(small_scene, "until = 2",
                                      method + "\nmethod_constants = { limiter = \"minmod\" }");
    const auto limiter = [](const SceneFile& file) { return file.settings.constants.at("limiter"); };
    CHECK(limiter(read_text(replaced(small_scene, "until = 2", method))) == 0);
    CHECK(limiter(read_text(text)) == 1);
    CHECK(read_text(text).find_resolved("method.limiter")->value == "minmod");
    const SceneFile changed = read_text(text, set({{"method.limiter", "van-leer"}}));
    CHECK(limiter(changed) == 2);
    CHECK(changed.find_resolved("method.limiter")->default_value == "none");
    check_round_trip(changed);
    for (const std::string wrong : {"minmd", "1", "van - leer"}) {
      const std::string message = "unknown method.limiter '" + wrong + "'";
      CHECK_THROWS_WITH_AS(read_text(text, set({{"method.limiter", wrong}})),
                           doctest::Contains(message.c_str()), UsageError);
    }
  }

  TEST_CASE("the resolved text contains the changed drawing") {
    SceneFile file = read_scene(find_scene("colliding-rings"));
    file.drawing = {.field = find_field("von_mises"),
                    .look = {.view = {}, .range = render::Range{0.1, 1.0 / 3}, .size = render::Size{96, 64}},
                    .frames = 7};
    file.history = 0.25;
    check_round_trip(file);
  }

  TEST_CASE("texts with special characters are kept") {
    const std::string text = replaced(small_scene, "\"Small\"", "\"a \\\"b\\\" \\\\ c ν\"");
    CHECK(read_text(text).scene.title == "a \"b\" \\ c ν");
    check_round_trip(read_text(text));
    // a line break, which a title cannot contain
    TomlValue lines;
    lines.set("a", TomlValue(std::string("b\n\t\x01 ν")));
    CHECK(parse_toml(print_toml(lines), "").find("a")->value.text == "b\n\t\x01 ν");
  }
}
