#include <cmath>

#include <doctest/doctest.h>

#include "cli/scene/scene_file.hpp"
#include "engine/error.hpp"
#include "engine/layout/initial_particles.hpp"
#include "engine/simulation.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/scene_text.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

constexpr const char* block_material = "material = \"rubber\"\nvelocity";

std::string with_block(const std::string& keys) {
  return replaced(small_scene, block_material, "material = \"rubber\"\n" + keys + "\nvelocity");
}

void check_block_error(const std::string& keys, std::initializer_list<const char*> parts) {
  check_error(block_material, "material = \"rubber\"\n" + keys + "\nvelocity", parts);
}

SceneError layout_error(const std::string& keys) {
  const SceneFile file = read_text(with_block(keys));
  try {
    make_initial_particles(file.scene);
  } catch (const SceneError& error) {
    return locate(file, error);
  }
  FAIL("no error");
  return {"", ""};
}

bool says(const SceneError& error, const std::string& part) {
  return std::string(error.what()).find(part) != std::string::npos;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("scene: parts of a body can have other materials, and the last matching part counts") {
    const std::string steel =
        "[material.steel]\ndensity = 8000\nyoungs_modulus = 2e11\npoisson_ratio = 0.3\n"
        "[[body]]\nname = \"block\"";
    const SceneFile file =
        read_text(replaced(with_block("parts = [{ material = \"steel\", where = \"x > 1\" },\n"
                                      "{ material = \"rubber\", where = \"y > 0.5 && c0 < 200\" }]"),
                           "[[body]]\nname = \"block\"", steel));
    const InitialParticles layout = make_initial_particles(file.scene);
    int steels = 0;
    for (int i = 0; i < layout.first[1]; ++i) {
      const bool is_steel = layout.x[i][0] > 1 && layout.x[i][1] < 0.5;
      steels += is_steel;
      CHECK(layout.material[i] == (is_steel ? 1 : 0));
    }
    CHECK(steels == 50);
    check_block_error("parts = [{ material = @\"ruber\", where = 1 }]",
                      {"unknown material 'ruber'", "did you mean 'rubber'"});
    check_block_error("parts = [@{ material = \"rubber\" }]",
                      {"'where' is missing in a part of body 'block'"});
    check_block_error("parts = [{ material = \"rubber\", @were = 1 }]", {"'where' is missing", "'were'"});
    check_block_error("parts = [{ material = \"rubber\", where = \"@a < 1\" }]", {"unknown name 'a'", "x"});
    check_block_error("parts = @{ material = \"rubber\", where = 1 }", {"parts must be an array of tables"});
    const SceneError empty = layout_error("parts = [{ material = \"rubber\", where = \"x > 9\" }]");
    CHECK(says(empty, "no particle of body 'block' is in region 1"));
    CHECK(empty.line == 14);
  }

  TEST_CASE("scene: driven regions have a velocity that depends on time") {
    const SceneFile file =
        read_text(with_block("driven = [{ where = \"x < dp\", velocity = [\"v0*t^2\", -3], until = 0.25 }]"));
    const Drive& drive = file.scene.bodies[0].drives.at(0);
    CHECK(drive.velocity[0](2) == 0.24);
    CHECK(drive.velocity[1](2) == -3);
    CHECK(drive.until == 0.25);
    CHECK_FALSE(read_text(with_block("driven = [{ where = 1, velocity = [1, 0] }]"))
                    .scene.bodies[0]
                    .drives.at(0)
                    .until);
    const InitialParticles layout = make_initial_particles(file.scene);
    for (int i = 0; i < layout.size(); ++i) CHECK(layout.drive[i] == (layout.x[i][0] < 0.1 ? 0 : -1));
    check_block_error("driven = [{ where = 1, velocity = [\"@x\", 0] }]", {"unknown name 'x'", "t"});
    check_block_error("driven = [{ where = 1, velocity = @[\"t\"] }]", {"velocity must be an array of 2"});
    check_block_error("driven = [@{ where = 1 }]",
                      {"'velocity' is missing in a driven region of body 'block'"});
    check_block_error("driven = [{ where = 1, velocity = [1, 0], until = @0 }]",
                      {"until = 0 must be greater than 0"});
    check_block_error("driven = [{ where = 1, velocity = [1, 0], @untl = 1 }]",
                      {"unknown key 'untl'", "'until'"});
    CHECK(says(layout_error("driven = [{ where = \"x > 9\", velocity = [1, 0] }]"), "driven: no particle"));
    const SceneError both = layout_error("held = \"x < 1\"\ndriven = [{ where = 1, velocity = [1, 0] }]");
    CHECK(says(both, "both held and driven"));
    for (const char* none : {"held = 0", "held = \"0\"", "held = [\"0\", 0]"})
      CHECK_NOTHROW(make_initial_particles(read_text(with_block(none)).scene));
    CHECK(both.line == 15);
    const SceneFile infinite = read_text(with_block("driven = [{ where = 1, velocity = [\"1/(t-1)\", 0] }]"));
    try {
      infinite.scene.bodies[0].drives[0].velocity[0](1);
      FAIL("no error");
    } catch (const SceneError& error) {
      CHECK(says(error, "is inf at t = 1 s"));
      CHECK(error.line == 14);
    }
  }

  TEST_CASE("scene: loaded regions have a force, a force density or a traction, with a ramp in time") {
    const SceneFile file = read_text(with_block(
        "loaded = [{ where = \"x > 1.9\", force = [\"v0*y\", 0], ramp = \"t^2\" },\n"
        "{ where = \"y > 0.9\", traction = [0, \"-E\"] }, { where = 1, force_density = [2, 0] }]"));
    const std::vector<Load>& loads = file.scene.bodies[0].loads;
    REQUIRE(loads.size() == 3);
    CHECK(loads[0].kind == Load::Kind::force);
    CHECK(loads[0].value[0]({0, 2, 0}) == 0.12);
    CHECK_FALSE(loads[0].value[1]);
    CHECK(loads[0].ramp(3) == 9);
    CHECK(loads[1].kind == Load::Kind::traction);
    CHECK(loads[1].value[1]({0, 0, 0}) == -1e7);
    CHECK(loads[1].ramp(3) == 1);
    CHECK(loads[2].kind == Load::Kind::force_density);
    check_block_error("loaded = [{ where = 1, @fource = [1, 0] }]",
                      {"unknown key 'fource'", "did you mean 'force'?"});
    check_block_error("loaded = [@{ where = 1 }]", {"'force', 'force_density' or 'traction' is missing",
                                                    "in a loaded region of body 'block'"});
    check_block_error("loaded = [{ where = 1, force = [1, 0], traction = @[1, 0] }]",
                      {"traction and force are both given"});
    check_block_error("loaded = [{ where = 1, force = @[1] }]", {"force must be an array of 2"});
    check_block_error("loaded = [{ where = 1, force = [1, 0], ramp = \"@x\" }]", {"unknown name 'x'", "t"});
    check_block_error("loaded = [{ where = 1, force = [1, 0], ramp = @0 }]", {"never act"});
    check_block_error("loaded = [{ where = 1, force = [1, 0], ramp = @\"0\" }]", {"never act"});
    check_block_error("loaded = [{ where = 1, force = [\"@t\", 0] }]", {"unknown name 't'"});
    check_block_error("loaded = [{ where = 1, force = [1, 0], @rmp = 1 }]", {"unknown key 'rmp'", "'ramp'"});
    const SceneError empty = layout_error("loaded = [{ where = \"x > 9\", force = [1, 0] }]");
    CHECK(says(empty, "loaded: no particle of body 'block'"));
    CHECK(empty.line == 14);
  }

  TEST_CASE("scene: gravity is a function of time, and damping a non-negative number") {
    const SceneFile file = read_text(replaced(
        small_scene, "until = 2", "until = 2\ngravity = [0, \"-9.8*min(1, t/v0)\"]\ndamping = \"2*v0\""));
    CHECK_FALSE(file.scene.gravity[0]);
    CHECK(file.scene.gravity[1](0.03) == -4.9);
    CHECK(file.scene.damping == 0.12);
    const SceneFile without = read_text(small_scene);
    CHECK_FALSE(has_loads(without.scene));
    CHECK(without.scene.damping == 0);
    check_error("until = 2", "until = 2\ngravity = @9.8", {"gravity must be an array of 2"});
    check_error("until = 2", "until = 2\ngravity = [0, \"@y\"]", {"unknown name 'y'"});
    check_error("until = 2", "until = 2\ndamping = @-1", {"damping = -1 must be at least 0"});
    check_error("until = 2", "until = 2\n@gravty = [0, 1]", {"unknown key 'gravty'", "'gravity'"});
  }

  TEST_CASE(
      "scene: the bulk modulus follows from E and nu unless given, and c0 follows from the bulk modulus") {
    const SceneFile usual = read_text(small_scene);
    CHECK(usual.scene.materials[0].bulk_modulus() == 1e7 / (3 * (1 - 2 * 0.4)));
    const SceneFile given = read_text(
        replaced(small_scene, "poisson_ratio = 0.4", "poisson_ratio = 0.4\nbulk_modulus = \"3*E\""));
    CHECK(given.scene.materials[0].bulk_modulus() == 3e7);
    CHECK(given.scene.bodies[0].velocity[0]({1, 0, 0}) == Approx(0.06 * std::sqrt(3e7 / 1200)));
    check_error("poisson_ratio = 0.4", "poisson_ratio = 0.4\nbulk_modulus = @\"-E\"",
                {"bulk_modulus = -1e+07 must be greater than 0"});
    check_error("poisson_ratio = 0.4", "poisson_ratio = 0.4\nbulk_modulus = \"@c0\"", {"unknown name 'c0'"});
  }

  TEST_CASE("scene: walls have a place and a normal") {
    const auto with_wall = [](const std::string& keys) {
      return small_scene + "\n[[wall]]\nname = \"floor\"\n" + keys + "\n";
    };
    const SceneFile file = read_text(with_wall("at = [0, -1]\nnormal = [0, 2]"));
    REQUIRE(file.scene.walls.size() == 1);
    CHECK(file.scene.walls[0].normal == Point{0, 1, 0});
    CHECK(file.scene.walls[0].at == Point{0, -1, 0});
    CHECK(resolved_text(read_text(resolved_text(file, scratch_folder())), scratch_folder()) ==
          resolved_text(file, scratch_folder()));
    const auto error_of = [&](const std::string& keys) -> std::string {
      try {
        read_text(with_wall(keys));
      } catch (const SceneError& error) {
        CHECK(error.line > 1);
        return error.what();
      }
      return "no error";
    };
    CHECK(error_of("at = [0, 0]\nnormal = [0, 0]").find("has no length") != std::string::npos);
    CHECK(error_of("at = [0, 0]").find("'normal' is missing") != std::string::npos);
    CHECK(error_of("at = [0, 0]\nnormal = [0, 1]\nnormel = 1").find("'normal'") != std::string::npos);
  }

  TEST_CASE("scene: a frequency is searched in a band, from a given time on") {
    const std::string kind = "of = \"frequency\"\n";
    const Scene scene =
        read_text(replaced(small_scene, "of = \"maximum\"", kind + "band = [2, 5]\nfrom = 3")).scene;
    CHECK(scene.measures[0].band == std::array{2.0, 5.0});
    CHECK(scene.measures[0].from == 3);  // past the end: no value, no error
    check_error("of = \"maximum\"", kind + "band = @[5, 2]", {"the lower one first"});
    check_error("of = \"maximum\"", kind + "band = [2, 5]\nfrom = @-1", {"must be at least 0"});
    CHECK_THROWS_AS(read_text(replaced(small_scene, "of = \"maximum\"", kind)), SceneError);
  }

  TEST_CASE("scene: a law of elasticity that the method does not support is refused or replaced") {
    const auto with_law = [](const std::string& method, const std::string& law) {
      return replaced(small_scene, "until = 2", "until = 2\nmethod = \"" + method + "\"" + law);
    };
    CHECK(read_text(with_law("tl", "")).settings.law == "neo-hookean");
    const SceneFile file = read_text(with_law("tl", "\nlaw = \"linear\""));
    CHECK(file.settings.law == "linear");
    CHECK(read_text(resolved_text(file, scratch_folder())).settings.law == "linear");
    const auto read_changed = [&](const char* law, const char* method) {
      std::vector<Setting> settings;
      if (law) settings.push_back({"law", law});
      if (method) settings.push_back({"method", method});
      return read_text(resolved_text(file, scratch_folder()), settings);
    };
    const auto changed = [&](const char* law, const char* method) {
      return read_changed(law, method).settings.law;
    };
    CHECK(changed("st-venant-kirchhoff", nullptr) == "st-venant-kirchhoff");
    CHECK_THROWS_AS(changed("linaer", nullptr), UsageError);
    CHECK_THROWS_AS(changed("linear", "icb"), UsageError);
    CHECK_THROWS_AS(changed("linear", "pfj-jst"), UsageError);
    CHECK(file.remark.empty());
    CHECK(changed(nullptr, "oenog") == "linear");
    CHECK(read_changed(nullptr, "oenog").remark.empty());
    CHECK(changed(nullptr, "pfj-jst") == "neo-hookean");
    CHECK(read_changed(nullptr, "pfj-jst").remark ==
          "the method 'pfj-jst' does not support the law of the scene, 'linear'; it runs with neo-hookean");
    CHECK(changed("mooney-rivlin", "pfj-jst") == "mooney-rivlin");
    CHECK(read_changed("mooney-rivlin", "pfj-jst").remark.empty());
    CHECK(changed(nullptr, "icb").empty());
    CHECK(read_changed(nullptr, "icb").remark.find("it runs with its own law") != std::string::npos);
    check_error("until = 2", "until = 2\nmethod = \"tl\"\nlaw = @\"linaer\"",
                {"unknown law 'linaer'", "did you mean 'linear'"});
    check_error("until = 2", "until = 2\nmethod = \"icb\"\nlaw = @\"linear\"", {"cannot be chosen"});
  }

  TEST_CASE("scene: an unknown contact law, or one that the method does not support, is refused") {
    CHECK(read_text(replaced(small_scene, "until = 2", "until = 2\ncontact = \"penalty\"")).scene.contact ==
          ContactLaw::penalty);
    CHECK(read_text(replaced(small_scene, "until = 2", "until = 2\ncontact = \"surface\"")).scene.contact ==
          ContactLaw::surface);
    check_error("until = 2", "until = 2\ncontact = @\"surfaces\"",
                {"unknown contact 'surfaces'", "did you mean 'surface'"});
    check_error("until = 2", "until = 2\ncontact = @\"impuls\"",
                {"unknown contact 'impuls'", "did you mean 'impulse'",
                 "published, sph, impulse, penalty, lennard-jones, surface"});
    const SceneFile file =
        read_text(replaced(small_scene, "until = 2", "until = 2\nmethod = \"oenog\"\ncontact = \"sph\""));
    try {
      make_simulation(file.scene, file.settings);
      FAIL("no error");
    } catch (const SceneError& error) {
      const SceneError located = locate(file, error);
      CHECK(located.line == 5);
      CHECK(says(located, "allowed: penalty, impulse"));
    }
  }
}
