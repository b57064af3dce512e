#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "engine/diagnostics/fields.hpp"
#include "engine/error.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/scene_text.hpp"

using namespace taut;
using namespace taut::test;

namespace {

std::string judged_solid(const std::string& tables) {
  return "title = \"Solid\"\ndim = 3\nspacing = 0.1\nuntil = 2\n"
         "[material.rubber]\ndensity = 1200\nyoungs_modulus = 1e7\npoisson_ratio = 0.4\n"
         "[[body]]\nname = \"thing\"\nmaterial = \"rubber\"\n"
         "shape = { type = \"box\", low = [-1, -0.5, 0], high = [1, 0.5, 0.5] }\n" +
         tables + "\n";
}

std::string probe(const std::string& name, const std::string& keys) {
  return "[[probe]]\nname = \"" + name + "\"\nbody = \"thing\"\n" + keys + "\n";
}

std::string measure(const std::string& name, const std::string& keys) {
  return "[[measure]]\nname = \"" + name + "\"\nunit = \"1\"\n" + keys + "\n";
}

SceneFile read_twice(const std::string& tables) {
  const SceneFile file = read_text(judged_solid(tables));
  const std::string text = resolved_text(file, scratch_folder());
  CHECK(resolved_text(read_text(text), scratch_folder()) == text);
  return file;
}

void refused(const std::string& tables, const char* part) {
  try {
    read_text(judged_solid(tables));
    FAIL_CHECK("no error");
  } catch (const SceneError& error) {
    INFO("message: ", std::string(error.what()));
    CHECK(std::string(error.what()).find(part) != std::string::npos);
  }
}

const std::string of_turn = measure("most", "of = \"maximum\"\nprobe = \"turn\"");

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("scene in 3D: a probe measures rotation about z, or about any axis through the origin") {
    const SceneFile about_z = read_twice(probe("turn", "of = \"turn\"\nat = [1, 0.5, 0]") + of_turn);
    CHECK(about_z.scene.probes[0].kind == Probe::Kind::turn);
    CHECK(about_z.scene.probes[0].turns_about == Point{0, 0, 1});
    const SceneFile other =
        read_twice(probe("turn", "of = \"turn\"\nat = [1, 0.5, 0]\naxis = [0, -3, \"2+2\"]") + of_turn);
    CHECK(other.scene.probes[0].turns_about[1] == relative(-0.6));
    CHECK(other.scene.probes[0].turns_about[2] == relative(0.8));
    refused(probe("turn", "of = \"turn\"\nat = [1, 0.5, 0]\naxis = [0, 0, 0]") + of_turn, "has no direction");
    refused(probe("turn", "of = \"turn\"\nat = [1, 0.5, 0]\naxis = [0, 1]") + of_turn,
            "axis must be an array of 3");
    refused(probe("turn", "of = \"turn\"\nat = [1, 0.5, 0]\naxis = [2, 1, 0]") + of_turn, "lies on the axis");
    refused(probe("turn", "of = \"turn\"\nat = [1, 0.5, 0]\ncomponent = \"z\"") + of_turn,
            "unknown key 'component'");
  }

  TEST_CASE("scene in 2D: the probe turn is about z and its axis cannot be chosen") {
    const std::string turn = "of = \"turn\"\nbody = \"block\"\nat = [2, 0.5]";
    const std::string old_probe = "of = \"displacement\"\nbody = \"block\"\nat = [2, 0.5]\ncomponent = \"y\"";
    CHECK(read_text(replaced(small_scene, old_probe, turn)).scene.probes[0].turns_about == Point{0, 0, 1});
    check_error(old_probe, turn + "\n@axis = [0, 0, 1]", {"'axis' has no effect"});
  }

  TEST_CASE("scene in 3D: the measure turn has three probes and an axis") {
    std::string probes;
    for (const char* axis : {"x", "y", "z"})
      probes += probe(axis, std::string("of = \"position\"\nat = [1, 0.5, 0]\ncomponent = \"") + axis + "\"");
    const std::string turn = "of = \"turn\"\nprobes = [\"x\", \"y\", \"z\"]";
    CHECK(read_twice(probes + measure("angle", turn)).scene.measures[0].axis == Point{0, 0, 1});
    CHECK(read_twice(probes + measure("angle", turn + "\naxis = [0, 5, 0]")).scene.measures[0].axis ==
          Point{0, 1, 0});
    refused(probes + measure("angle", "of = \"turn\"\nprobes = [\"x\", \"y\"]"),
            "the x, y and z components of one point");
  }

  TEST_CASE("scene: probes measure a body's deviation from its own mirror image, and its centre of mass") {
    const SceneFile file = read_twice(probe("image", "of = \"mirror_asymmetry\"\ncomponent = \"x\"") +
                                      probe("centre", "of = \"mean_position\"\ncomponent = \"z\"") +
                                      measure("a", "of = \"maximum\"\nprobe = \"image\"") +
                                      measure("b", "of = \"maximum\"\nprobe = \"centre\""));
    CHECK(file.scene.probes[0].bodies == std::vector<int>{0, 0});
    CHECK(file.scene.probes[1].kind == Probe::Kind::mean_position);
    CHECK(file.scene.probes[1].axis == 2);
  }

  TEST_CASE("scene: fields of 3D are known in 3D and unknown in 2D") {
    const std::string line =
        "[[line]]\nname = \"across\"\nbody = \"thing\"\nfield = \"stress_xz\"\nfrom = [-0.9, 0, 0.2]\n"
        "to = [0.9, 0, 0.4]\npoints = 3\ntimes = [1]\n";
    CHECK(read_twice(line).scene.lines[0].to == Point{0.9, 0, 0.4});
    read_twice(measure("field",
                       "of = \"field_rmse\"\nbody = \"thing\"\nrigid_motion = \"free\"\n"
                       "fields = [\"displacement_x\", \"displacement_y\", \"displacement_z\"]"));
    refused(measure("field",
                    "of = \"field_rmse\"\nbody = \"thing\"\nrigid_motion = \"free\"\n"
                    "fields = [\"displacement_x\", \"displacement_y\"]"),
            "\"displacement_z\"]; use \"counts\"");
    check_error("[[probe]]",
                "[[measure]]\nname = \"field\"\nof = \"field_rmse\"\nunit = \"1\"\nbody = \"block\"\n"
                "fields = [@\"displacement_z\"]\n[[probe]]",
                {"unknown field 'displacement_z'"});
  }
}
