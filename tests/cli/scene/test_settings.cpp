#include <doctest/doctest.h>

#include "cli/run/labels.hpp"
#include "cli/run/plan.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene_text.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;
using Source = ResolvedSetting::Source;

namespace {

std::string folder_of(const std::string& scene, const std::vector<Setting>& settings) {
  RunOptions options;
  options.scene = write_scene(scene).string();
  options.settings = settings;
  return make_plan(options).folder.path().string();
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a resolved setting has its value, its default and the source of the value") {
    const SceneFile file =
        read_text("cfl = 0.25\njitter = \"v0\"\n" + small_scene,
                  {{"v0", "0.08"}, {"method", "tl"}, {"stepping", "dual"}, {"spacing", "0.3/2"}});
    const auto check = [&](const char* name, const char* value, const char* usual, Source source) {
      CAPTURE(name);
      const ResolvedSetting* found = file.find_resolved(name);
      REQUIRE(found);
      CHECK(found->value == value);
      CHECK(found->default_value == usual);
      CHECK(found->source == source);
    };
    check("v0", "0.08", "0.06", Source::setting);
    check("method", "tl", "oenog", Source::setting);
    check("spacing", "0.15", "0.1", Source::setting);
    check("until", "2", "2", Source::by_default);
    check("jitter", "0.08", "0", Source::scene);
    check("jitter_seed", "1", "1", Source::by_default);
    check("stepping", "dual", "dual", Source::by_default);
    CHECK(file.find_resolved("cfl")->source ==
          Source::by_default);  // the scene's CFL number is for another method
    CHECK(read_text("cfl = 0.25\n" + small_scene).find_resolved("cfl")->source == Source::scene);
    for (const std::string& name : names_to_set(file)) {
      CAPTURE(name);
      CHECK(file.find_resolved(name));
    }
    CHECK_FALSE(file.find_resolved("speed"));
  }

  TEST_CASE("the default folder of a run names only settings that change the run") {
    CHECK(folder_of(small_scene, {}) == "out/scene-oenog");
    CHECK(folder_of(small_scene, {{"method", "tl"}}) == "out/scene-tl");
    CHECK(folder_of(small_scene, {{"until", "3"}, {"v0", "0.07"}, {"cfl", "0.2"}}) ==
          "out/scene-oenog-cfl=0.2-until=3-v0=0.07");
    CHECK(folder_of(small_scene, {{"v0", "3/50"}, {"spacing", "0.1"}, {"contact", "published"}}) ==
          "out/scene-oenog");
    const std::string timed = replaced(small_scene, "until = 2", "until = \"50*v0\"");
    CHECK(folder_of(timed, {{"v0", "0.08"}, {"until", "4"}}) == "out/scene-oenog-v0=0.08");
    const std::string copied = replaced(small_scene, "value = 0.06", "value = 0.07, default = 0.06");
    CHECK(folder_of(copied, {}) == "out/scene-oenog-v0=0.07");
    CHECK(folder_of(copied, {{"v0", "0.06"}}) == "out/scene-oenog");
  }

  TEST_CASE("a contact law of --set that the method cannot use is refused by the name of the setting") {
    CHECK_THROWS_WITH_AS(
        read_text(small_scene, {{"method", "tl"}, {"contact", "sph"}}),
        doctest::Contains("--set contact=sph: method 'tl' cannot run with the contact law 'sph': "),
        UsageError);
    CHECK_NOTHROW(read_text("contact = \"sph\"\n" + small_scene, {{"method", "tl"}, {"contact", "penalty"}}));
    CHECK_NOTHROW(read_text(small_scene, {{"method", "enog"}, {"contact", "sph"}}));
  }

  TEST_CASE("labels of runs name each setting that differs from the method's default") {
    const auto run_with = [](const std::vector<Setting>& settings) {
      return SavedRun{RunFolder("out/a"), read_text(small_scene, settings), {}, {}};
    };
    const RunLabels labels =
        label_runs({run_with({}), run_with({{"cfl", "0.2"}, {"method.damping", "0"}, {"stepping", "single"}}),
                    run_with({{"contact", "impulse"}, {"law", "mooney-rivlin"}})});
    CHECK(labels.title == "Small");
    CHECK(labels.note == "oenog");
    REQUIRE(labels.columns.size() == 3);
    CHECK(labels.columns[0].title == "a");
    CHECK(labels.columns[1].title == "damping = 0");
    CHECK(labels.columns[1].note == "CFL 0.2, single stepping");
    CHECK(labels.columns[2].title == "contact impulse");
    CHECK(labels.columns[2].note == "law mooney-rivlin");
  }
}
