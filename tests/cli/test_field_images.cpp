// One picture per colour field, drawn by `taut run` at small size and compared with tests/golden/fields.
// TAUT_UPDATE_GOLDEN=1 cli_tests --test-suite=image   writes them anew; look at them before they are kept.

#include <cstdlib>
#include <filesystem>
#include <string>

#include <doctest/doctest.h>

#include "engine/field.hpp"
#include "render/image_difference.hpp"
#include "tests/cli/program_runner.hpp"

namespace {

using namespace taut;
using namespace taut::test;

const fs::path golden_folder = fs::path(TAUT_SOURCE_DIR) / "tests/golden/fields";

/// The rings at 3 ms, pressed together, at twice the usual spacing; moments of about 0.2 s of work.
Image picture_of(std::string_view field, const fs::path& folder, const std::string& until = "0.003") {
  const Outcome run = call({"run", "colliding-rings", "--spacing", "0.002", "--until", until, "--frames", "1",
                            "--color", std::string(field), "--range", "auto", "--size", "320x180",
                            "--threads", "1", "--quiet", "--out", folder.string()});
  REQUIRE_MESSAGE(run.code == 0, run.err);
  return read_png(folder / "frames/frame_00001.png");
}

}  // namespace

TEST_SUITE("image") {
  TEST_CASE("every field is drawn as in its golden picture") {
    const TemporaryFolder folder;
    for (const Field& field : fields()) {
      CAPTURE(field.key);
      const fs::path golden = golden_folder / (std::string(field.key) + ".png");
      const Image picture = picture_of(field.key, folder / "run");
      if (std::getenv("TAUT_UPDATE_GOLDEN")) write_png(picture, golden);
      REQUIRE_MESSAGE(fs::exists(golden), "no golden picture; run with TAUT_UPDATE_GOLDEN=1 and look at it");
      const ImageDifference difference = compare(picture, read_png(golden));
      CHECK_MESSAGE(alike(difference), "share ", difference.share, ", densest window ", difference.densest);
    }
  }

  TEST_CASE("a wrong picture is found: another field, and the same a moment later") {
    const TemporaryFolder folder;
    const Image golden = read_png(golden_folder / "von_mises.png");
    CHECK_FALSE(alike(compare(golden, read_png(golden_folder / "speed.png"))));
    CHECK_FALSE(alike(compare(golden, picture_of("von_mises", folder / "run", "0.0031"))));
  }
}
