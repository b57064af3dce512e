#include <doctest/doctest.h>

#include "render/colormap.hpp"
#include "render/image/png.hpp"
#include "tests/support/program_runner.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

using Words = std::vector<std::string>;

int pixels_of(const fs::path& picture, std::size_t category) {
  const taut::render::Image image = taut::render::read_png(picture);
  int pixels = 0;
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column)
      pixels += image.at(column, row) == taut::render::category_color(category);
  return pixels;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("drawing values that cannot be drawn are refused before older frames or runs are removed") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "out", {"--save-particles"})).code == 0);
    const std::string scene = text_of(folder / "out/scene.toml"), record = text_of(folder / "out/run.json");
    const auto refused = [&](const Outcome& outcome, const std::string& message) {
      CAPTURE(outcome.err);
      CHECK(outcome.code == 2);
      CHECK(contains(outcome.err, message));
      CHECK_FALSE(contains(outcome.err, "is replaced"));
      CHECK(text_of(folder / "out/scene.toml") == scene);
      CHECK(text_of(folder / "out/run.json") == record);
      CHECK(files_in(folder / "out/frames") == 5);
    };
    for (const auto& [option, message] :
         {std::pair("--title=Gr\xf6\xdf", "--title is 'Gr\\xf6\\xdf'; it must be one line of UTF-8 text"),
          std::pair("--title=two\nlines", "--title is 'two\\x0alines'; it must be one line"),
          std::pair("--range=-1e308:1e308", "both from -1e100 to 1e100"),
          std::pair("--view=-1e308:1e308:0:1", "all from -1e100 to 1e100"),
          std::pair("--camera=1e-300:0:0", "its length from 1e-100 to 1e100")}) {
      refused(call({"render", folder.str("out"), "--quiet", option}), message);
      refused(call(tiny_run(folder, "out", {option})), message);
    }
    CHECK(call({"render", folder.str("out"), "--quiet", "--title", "Größe"}).code == 0);
    CHECK(contains(text_of(folder / "out/scene.toml"), "title = \"Größe\""));
    CHECK(call({"render", folder.str("out"), "--quiet"}).code == 0);
  }

  TEST_CASE("snapshot and plot refuse a title that is no line of UTF-8 text, and write nothing") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "out", {"--no-render"})).code == 0);
    const int before = files_in(folder.path());
    Words snapshot = tiny_run(folder, "new", {"--baseline", folder.str("base"), "--update"});
    snapshot[0] = "snapshot";
    for (Words command : {snapshot, Words{"plot", folder.str("out"), "--out", folder.str("plot.svg")}}) {
      command.insert(command.end(), {"--title", "Gr\xf6\xdf"});
      const Outcome outcome = call(command);
      CAPTURE(outcome.err);
      CHECK(outcome.code == 2);
      CHECK(contains(outcome.err, "must be one line of UTF-8 text of at most 200 bytes"));
      CHECK(files_in(folder.path()) == before);
    }
  }

  TEST_CASE("a hidden body is not in the legend, and the other keeps its colour") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "out", {"--until", "1e-4", "--save-particles", "--no-render"})).code == 0);
    const auto drawn = [&](const Words& more) {
      Words words{"render", folder.str("out"), "--quiet", "--color",           "body", "--range", "auto",
                  "--size", "640x360",         "--out",   folder.str("frames")};
      words.insert(words.end(), more.begin(), more.end());
      const Outcome outcome = call(words);
      REQUIRE_MESSAGE(outcome.code == 0, outcome.err);
      return folder / "frames/frame_00000.png";
    };
    CHECK(pixels_of(drawn({}), 0) > 100);
    CHECK(pixels_of(drawn({"--hide", "left"}), 0) == 0);
    CHECK(pixels_of(drawn({"--hide", "left"}), 1) > 100);
  }

  TEST_CASE("run and render with --follow show the body in full, or the view given with it") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "out", {"--until", "1e-4", "--save-particles", "--no-render"})).code == 0);
    REQUIRE(call(tiny_run(folder, "followed", {"--until", "1e-4", "--follow", "left"})).code == 0);
    const auto drawn = [&](const Words& more) {
      Words words{"render", folder.str("out"), "--quiet", "--out", folder.str("frames")};
      words.insert(words.end(), more.begin(), more.end());
      const Outcome outcome = call(words);
      REQUIRE_MESSAGE(outcome.code == 0, outcome.err);
      return text_of(folder / "frames/frame_00000.png");
    };
    const std::string followed = drawn({"--follow", "left"});
    CHECK(followed == drawn({"--follow", "left", "--view", "auto"}));
    CHECK(followed == text_of(folder / "followed/frames/frame_00000.png"));
    CHECK(contains(text_of(folder / "followed/scene.toml"), "view = \"auto\""));
    const std::string view = "-0.01:0.03:-0.02:0.02";
    const std::string chosen = drawn({"--follow", "left", "--view", view});
    CHECK(chosen != followed);
    CHECK(chosen == drawn({"--view", view, "--follow", "left"}));
  }
}
