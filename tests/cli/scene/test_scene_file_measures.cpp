#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "cli/scene/sections.hpp"
#include "engine/diagnostics/measure_kinds.hpp"
#include "engine/error.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/scene_text.hpp"

using namespace taut;
using namespace taut::test;

namespace {

const std::map<std::string_view, std::string> values = {
    {"probe", "\"tip\""},
    {"probes", "[\"tip\", \"tip\"]"},
    {"line", "\"middle\""},
    {"body", "\"ring\""},
    {"fields", "[\"speed\"]"},
    {"rigid_motion", "\"counts\""},
    {"threshold", "3"},
    {"scale", "4"},
    {"band", "[5, 6]"},
    {"from", "7"},
    {"free", "\"tip\""},
    {"time", "0.5"},
    {"about", "2"},
    {"until", "9"},
};

/// The measure has every key of its kind except `axis`.
std::string scene_with(const MeasureKind& kind, const std::string& more = "") {
  std::string measure =
      "\n[[line]]\nname = \"middle\"\nbody = \"block\"\nfield = \"pressure\"\nfrom = [0, 0.5]\n"
      "to = [2, 0.5]\npoints = 3\ntimes = [1]\n[[measure]]\nname = \"m\"\nof = \"" +
      std::string(kind.name) + "\"\n";
  for (const std::string_view key : kind.keys)
    if (key != "axis") measure += std::string(key) + " = " + values.at(key) + "\n";
  return small_scene + measure + more;
}

bool takes(const MeasureKind& kind, std::string_view key) {
  return std::ranges::find(kind.keys, key) != kind.keys.end();
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("scene: a measure accepts the keys of its kind and refuses others") {
    for (const MeasureKind& kind : measure_kinds()) {
      CAPTURE(kind.name);
      const Measure m = read_text(scene_with(kind)).scene.measures.at(1);
      CHECK(m.kind == kind.name);
      CHECK(m.probes.size() == (takes(kind, "probe") ? 1 : takes(kind, "probes") ? 2 : 0));
      CHECK(m.line == (takes(kind, "line") ? "middle" : ""));
      CHECK(m.body == (takes(kind, "body") ? 1 : 0));
      CHECK(m.fields.size() == (takes(kind, "fields") ? 1 : 0));
      CHECK(m.threshold == (takes(kind, "threshold") ? 3 : 0));
      CHECK(m.scale == (takes(kind, "scale") ? 4 : 1));
      CHECK(m.band == (takes(kind, "band") ? std::array{5.0, 6.0} : std::array{0.0, 0.0}));
      CHECK(m.from == (takes(kind, "from") ? 7 : 0));
      CHECK(m.time == (takes(kind, "time") ? 0.5 : 0));
      CHECK(m.free == (takes(kind, "free") ? "tip" : ""));
      CHECK(m.about == (takes(kind, "about") ? 2 : 0));
      CHECK(m.until == (takes(kind, "until") ? std::optional(9.0) : std::nullopt));
      for (const auto& [key, value] : values) {
        const auto& key_now = key;
        CAPTURE(key_now);
        if (!takes(kind, key))
          CHECK_THROWS_WITH_AS(read_text(scene_with(kind, std::string(key) + " = " + value + "\n")),
                               doctest::Contains("unknown key"), SceneError);
      }
    }
  }

  TEST_CASE("scene: a measure can use the mean as its level, and must end after it begins") {
    const std::string swing = "[[measure]]\nname = \"T\"\nof = \"period\"\nprobe = \"tip\"\n";
    CHECK(read_text(small_scene + swing + "about = \"mean\"\n").scene.measures.at(1).about_mean);
    CHECK(read_text(small_scene + swing + "about = \"2*dp\"\n").scene.measures.at(1).about == 0.2);
    const std::string middle = "of = \"mean\"\nprobe = \"tip\"\nfrom = 1\nuntil = ";
    CHECK(read_text(replaced(small_scene, "of = \"maximum\"\nprobe = \"tip\"\n", middle + "1.5\n"))
              .scene.measures.at(0)
              .until == 1.5);
    check_error("of = \"maximum\"\nprobe = \"tip\"\n", middle + "@1\n",
                {"until = 1 s must be after from = 1 s"});
    check_error("of = \"maximum\"", "of = \"period\"\nabout = \"@maen\"", {"unknown name 'maen'"});
  }

  TEST_CASE("scene: probes measure stress, reactions and contact forces") {
    const std::string old_probe = "[[probe]]\nname = \"tip\"\n",
                      wall = "[[wall]]\nname = \"floor\"\nat = [0, -3]\nnormal = [0, 1]\n";
    const auto with = [&](const std::string& probe) {
      return read_text(
                 replaced(small_scene, old_probe, wall + "[[probe]]\nname = \"new\"\n" + probe + old_probe) +
                 "[[measure]]\nname = \"n\"\nof = \"mean\"\nprobe = \"new\"\n")
          .scene.probes.front();
    };
    const Probe stress =
        with("of = \"stress\"\nbody = \"block\"\nat = [1, 0.5]\ncomponent = \"von_mises\"\n");
    CHECK(stress.kind == Probe::Kind::stress);
    CHECK(stress.part == StressPart::von_mises);
    CHECK(stress.at == Point{1, 0.5, 0});
    const Probe held = with("of = \"reaction\"\nbody = \"ring\"\nwhere = \"x < 4\"\ncomponent = \"y\"\n");
    CHECK(held.kind == Probe::Kind::reaction);
    CHECK(held.bodies == std::vector{1});
    CHECK(held.axis == 1);
    CHECK(held.where({3, 0, 0}) == 1);
    CHECK(held.where({5, 0, 0}) == 0);
    for (const char* nowhere : {"0", "\"0\""})
      CHECK_THROWS_WITH_AS(
          with(std::string("of = \"reaction\"\nbody = \"ring\"\ncomponent = \"y\"\nwhere = ") + nowhere +
               "\n"),
          doctest::Contains("where is 0"), SceneError);
    const Probe pair = with("of = \"contact_force\"\nbodies = [\"ring\", \"block\"]\ncomponent = \"x\"\n");
    CHECK(pair.bodies == std::vector{1, 0});
    CHECK(pair.wall == -1);
    CHECK(unit_of(pair, 2) == "N/m");
    CHECK(unit_of(pair, 3) == "N");
    CHECK(unit_of(stress, 2) == "Pa");
    const Probe of_wall =
        with("of = \"contact_force\"\nbody = \"ring\"\nwall = \"floor\"\ncomponent = \"x\"\n");
    CHECK(of_wall.bodies.front() == 1);
    CHECK(of_wall.wall == 0);
    CHECK_THROWS_WITH_AS(
        with("of = \"contact_force\"\nbody = \"ring\"\nwall = \"flor\"\ncomponent = \"x\"\n"),
        doctest::Contains("unknown wall 'flor'"), SceneError);
    CHECK_THROWS_WITH_AS(with("of = \"stress\"\nbody = \"block\"\nat = [1, 0.5]\ncomponent = \"xz\"\n"),
                         doctest::Contains("von_mises"), SceneError);
  }

  TEST_CASE("scene: an expression of forces alone is a mean over the previous step, like the forces") {
    const auto of_steps = [](const std::string& value) {
      const std::string
          force = "[[probe]]\nname = \"push\"\nof = \"reaction\"\nbody = \"ring\"\ncomponent = \"y\"\n",
          old = "[[measure]]\nname = \"peak\"\nof = \"maximum\"\nprobe = \"tip\"";
      const Scene scene =
          read_text(replaced(small_scene, old,
                             force + "[[probe]]\nname = \"sum\"\nof = \"expression\"\nvalue = \"" + value +
                                 "\"\n" + replaced(old, "tip", "sum")))
              .scene;
      CHECK(is_step_mean(scene.probes.at(1)));
      return is_step_mean(scene.probes.at(2));
    };
    CHECK(of_steps("2*push - v0"));
    CHECK_FALSE(of_steps("push + t"));
    CHECK_FALSE(of_steps("push*tip"));
    CHECK_FALSE(of_steps("v0"));
  }

  TEST_CASE("scene: an expression of probes can use earlier probes, t and the numbers of the scene") {
    const auto with = [](const std::string& value, const std::string& name = "sum") {
      return replaced(small_scene, "[[measure]]\nname = \"peak\"\nof = \"maximum\"\nprobe = \"tip\"",
                      "[[probe]]\nname = \"" + name + "\"\nof = \"expression\"\nvalue = " + value +
                          "\n[[measure]]\nname = \"peak\"\nof = \"maximum\"\nprobe = \"" + name + "\"");
    };
    const Probe sum = read_text(with("\"2*tip + v0*t + dp\"")).scene.probes.at(1);
    CHECK(sum.kind == Probe::Kind::expression);
    CHECK(sum.bodies == std::vector{0});
    CHECK(unit_of(sum, 2).empty());
    CHECK(sum.value({10, 0}, 3) == Approx(20 + 0.06 * 3 + 0.1));
    CHECK(read_text(with("\"tip\"", "later-one")).scene.probes.size() == 2);
    const auto refused = [&](const std::string& text, const char* message) {
      CHECK_THROWS_WITH_AS(read_text(text), doctest::Contains(message), SceneError);
    };
    refused(with("\"2*tp\""), "unknown name 'tp'");
    // material constants are known only if they are unique
    CHECK(read_text(with("\"0*t + K/G\"")).scene.probes.at(1).value({0, 0}, 0) == Approx(14.0 / 3));
    const std::string soft =
        "[material.soft]\ndensity = 1000\nyoungs_modulus = 1e6\npoisson_ratio = 0.3\n"
        "[[body]]\nname = \"block\"";
    const std::string two = replaced(with("\"0*t + K\""), "[[body]]\nname = \"block\"", soft);
    refused(replaced(two, "outer = 2 }\nmaterial = \"rubber\"", "outer = 2 }\nmaterial = \"soft\""),
            "unknown name 'K'");
    CHECK_NOTHROW(
        read_text(replaced(replaced(with("\"tip + 0*K\""), "[[body]]\nname = \"block\"", soft),
                           "outer = 2 }\nmaterial = \"rubber\"", "outer = 2 }\nmaterial = \"soft\"")));
    refused(with("\"2*sum\""), "unknown name 'sum'");
    refused(with("\"2*tip +\""), "is not an expression");
    CHECK(read_text(with("\"3*t\"")).scene.probes.size() == 2);
    refused(replaced(with("\"tip\""), "v0 = {", "tip = { value = 1 }\nv0 = {"),
            "name of a probe and of a number");
  }
}
