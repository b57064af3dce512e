// tests/README.md describes how to update the golden pictures.

#include <cstdlib>
#include <filesystem>
#include <string>

#include <doctest/doctest.h>

#include "engine/diagnostics/fields.hpp"
#include "tests/support/program_runner.hpp"

namespace {

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

const fs::path golden_folder = fs::path(TAUT_SOURCE_DIR) / "tests/golden/fields";

Outcome snapshot(std::string_view field, const fs::path& baseline, const fs::path& run,
                 const std::vector<std::string>& more = {}, const std::string& until = "0.003") {
  std::vector<std::string> arguments{"snapshot",   "colliding-rings",
                                     "--baseline", baseline,
                                     "--out",      run,
                                     "--spacing",  "0.002",
                                     "--until",    until,
                                     "--frames",   "1",
                                     "--color",    std::string(field),
                                     "--range",    "auto",
                                     "--size",     "320x180",
                                     "--threads",  "1",
                                     "--quiet"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return call(arguments);
}

}  // namespace

TEST_SUITE("image") {
  TEST_CASE("every field matches its golden pictures in 2D") {
    const TemporaryFolder folder;
    const bool update = std::getenv("TAUT_UPDATE_GOLDEN") != nullptr;
    for (const Field& field : fields(2)) {
      CAPTURE(field.key);
      const Outcome outcome =
          snapshot(field.key, golden_folder / field.key, folder / "run",
                   update ? std::vector<std::string>{"--update"} : std::vector<std::string>{});
      CHECK_MESSAGE(outcome.code == 0, outcome.out, outcome.err);
    }
  }

  TEST_CASE("a wrong picture is found: another field, or the same field a moment later") {
    const TemporaryFolder folder;
    const fs::path golden = golden_folder / "von_mises";
    CHECK(snapshot("speed", golden, folder / "run").code == 1);
    const Outcome later = snapshot("von_mises", golden, folder / "run", {}, "0.0031");
    CHECK(later.code == 1);
    CHECK(contains(later.out, "frame_00001.png"));
    CHECK(fs::exists(folder / "run/difference.png"));
  }
}
