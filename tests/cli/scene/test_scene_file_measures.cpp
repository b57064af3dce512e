#include <algorithm>
#include <array>
#include <map>

#include <doctest/doctest.h>

#include "engine/diagnostics/measure_kinds.hpp"
#include "engine/error.hpp"
#include "tests/support/scene_text.hpp"

using namespace taut;
using namespace taut::test;

namespace {

const std::map<std::string_view, std::string> values = {
    {"probe", "\"tip\""},      {"probes", "[\"tip\", \"tip\"]"},
    {"line", "\"middle\""},    {"body", "\"ring\""},
    {"fields", "[\"speed\"]"}, {"rigid_motion", "\"counts\""},
    {"threshold", "3"},        {"scale", "4"},
    {"band", "[5, 6]"},        {"from", "7"},
    {"free", "\"tip\""},       {"time", "0.5"},
};

/// The small scene with one more measure of a kind that says all it can say.
std::string scene_with(const MeasureKind& kind, const std::string& more = "") {
  std::string measure =
      "\n[[line]]\nname = \"middle\"\nbody = \"block\"\nfield = \"pressure\"\nfrom = [0, 0.5]\n"
      "to = [2, 0.5]\npoints = 3\ntimes = [1]\n[[measure]]\nname = \"m\"\nof = \"" +
      std::string(kind.name) + "\"\n";
  for (const std::string_view key : kind.keys)
    if (key != "axis")  // of 3D
      measure += std::string(key) + " = " + values.at(key) + "\n";
  return small_scene + measure + more;
}

bool takes(const MeasureKind& kind, std::string_view key) {
  return std::ranges::find(kind.keys, key) != kind.keys.end();
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("scene: a measure of every kind takes the keys of its kind and no other") {
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
      for (const auto& [key, value] : values) {
        CAPTURE(key);
        if (!takes(kind, key))
          CHECK_THROWS_WITH_AS(read_text(scene_with(kind, std::string(key) + " = " + value + "\n")),
                               doctest::Contains("unknown key"), SceneError);
      }
    }
  }
}
