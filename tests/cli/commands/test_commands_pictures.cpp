#include <doctest/doctest.h>

#include "render/image/png.hpp"
#include "tests/support/program_runner.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

void write_picture(const fs::path& path, int side, int width = 64) {
  fs::create_directories(path.parent_path());
  taut::render::Image image(width, 48);
  for (int column = 0; column < side; ++column)
    for (int row = 0; row < side; ++row) image.set(column, row, {200, 0, 0});
  taut::render::write_png(image, path);
}

std::vector<std::string> tiny_snapshot(const TemporaryFolder& folder,
                                       const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = tiny_run(folder, "out", {"--baseline", folder.str("base")});
  arguments[0] = "snapshot";
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("run and render name the texts that have no room in the pictures") {
    const TemporaryFolder folder;
    const std::string title = "A title of so many words that no picture of this size can have room for it";
    const auto told = [&](std::vector<std::string> more) {
      more.insert(more.end(), {"--frames", "1", "--until", "1e-5", "--save-particles"});
      const Outcome outcome = call(tiny_run(folder, "out", more));
      CHECK(outcome.code == 0);
      return outcome.err.substr(std::min(outcome.err.size(), outcome.err.find("taut: the picture")));
    };
    CHECK(told({"--size", "640x360"}).empty());
    CHECK(told({"--text", "none"}).empty());
    CHECK(contains(told({"--size", "400x300", "--title", title}), "has no room for " + title + ";"));
    const Outcome drawn =
        call({"render", folder.str("out"), "--quiet", "--size", "400x300", "--title", title});
    CHECK(drawn.code == 0);
    CHECK(contains(drawn.err, "has no room for " + title + ";"));
    CHECK(call({"render", folder.str("out"), "--quiet", "--title", "Short"}).err.empty());
  }

  TEST_CASE("diff compares the pictures of equal names in two folders") {
    const TemporaryFolder folder;
    for (const std::string name : {"frame_00000.png", "frame_00001.png", "frame_00002.png"}) {
      write_picture(folder / ("a/" + name), 10);
      write_picture(folder / ("b/" + name), 10);
    }
    const auto diff = [&](const std::vector<std::string>& more = {}) {
      std::vector<std::string> arguments{"diff", folder.str("a"), folder.str("b")};
      arguments.insert(arguments.end(), more.begin(), more.end());
      return call(arguments);
    };
    CHECK(diff().code == 0);
    CHECK(contains(diff().out, "alike\n"));
    const Outcome jpeg = diff({"--out", folder.str("diff.jpg")});
    CHECK(jpeg.code == 2);
    CHECK(contains(jpeg.err, "diff.jpg' must end in .png"));

    write_picture(folder / "b/frame_00001.png", 20);
    write_picture(folder / "b/frame_00002.png", 13);
    const Outcome worse = diff({"--out", folder.str("diff.png")});
    CHECK(worse.code == 1);
    CHECK(contains(worse.out, "different\n"));
    CHECK(contains(worse.out, "frame_00001.png"));
    CHECK_FALSE(contains(worse.out, "frame_00002.png"));
    CHECK(taut::render::read_png(folder / "diff.png").at(15, 15)[1] < 180);
    CHECK(diff({"--max-difference", "150"}).code == 0);
  }

  TEST_CASE("a picture in only one folder is a difference") {
    const TemporaryFolder folder;
    write_picture(folder / "a/one.png", 5);
    write_picture(folder / "b/one.png", 5);
    write_picture(folder / "b/two.png", 5);
    for (const bool swapped : {false, true}) {
      const std::string a = folder.str(swapped ? "b" : "a"), b = folder.str(swapped ? "a" : "b");
      const Outcome outcome = call({"diff", a, b});
      CHECK(outcome.code == 1);
      CHECK(contains(outcome.out, "only in " + folder.str("b")));
      CHECK(contains(outcome.out, "two.png"));
    }
  }

  TEST_CASE(
      "diff refuses folders without pictures, pictures of unequal size, and a folder compared with an image") {
    const TemporaryFolder folder;
    write_picture(folder / "a/one.png", 5);
    write_picture(folder / "wide/one.png", 5, 65);
    fs::create_directories(folder / "empty");
    CHECK(call({"diff", folder.str("a"), folder.str("empty")}).code == 2);
    const Outcome sizes = call({"diff", folder.str("a"), folder.str("wide")});
    CHECK(sizes.code == 2);
    CHECK(contains(sizes.err, "wide/one.png"));
    CHECK(call({"diff", folder.str("a"), folder.str("a/one.png")}).code == 2);
  }

  TEST_CASE("diff of a run folder compares its frames") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "slow")).code == 0);
    REQUIRE(call(tiny_run(folder, "fast", {"--set", "speed=3"})).code == 0);
    const Outcome outcome = call({"diff", folder.str("slow"), folder.str("fast")});
    CHECK(outcome.code == 1);
    CHECK(contains(outcome.out, "pictures compared           5"));
    CHECK(call({"diff", folder.str("slow"), folder.str("slow/frames"), "--max-difference", "0"}).code == 0);
  }

  TEST_CASE("a snapshot needs a baseline, creates it with --update, and finds differences from it") {
    const TemporaryFolder folder;
    const Outcome without = call(tiny_snapshot(folder));
    CHECK(without.code == 2);
    CHECK(contains(without.err, "--update"));
    CHECK_FALSE(fs::exists(folder / "out"));

    REQUIRE(call(tiny_snapshot(folder, {"--update"})).code == 0);
    CHECK(files_in(folder / "base") == 6);  // five frames and their look
    CHECK(call(tiny_snapshot(folder, {"--max-difference", "0"})).code == 0);
    CHECK_FALSE(fs::exists(folder / "out/difference.png"));

    const Outcome other = call(tiny_snapshot(folder, {"--set", "speed=3"}));
    CHECK(other.code == 1);
    CHECK(contains(other.out, "frame_0000"));
    CHECK(taut::render::read_png(folder / "out/difference.png").width == 160);
    CHECK(call(tiny_snapshot(folder, {"--frames", "2"})).code == 1);

    REQUIRE(call(tiny_snapshot(folder, {"--set", "speed=3", "--frames", "2", "--update"})).code == 0);
    CHECK(files_in(folder / "base") == 4);
    CHECK(files_in(folder.path()) == 3);
    CHECK(call(tiny_snapshot(folder, {"--set", "speed=3", "--frames", "2"})).code == 0);
    CHECK_FALSE(fs::exists(folder / "out/difference.png"));
  }

  TEST_CASE("a baseline keeps its view and range, so that a tiny change of speed is no difference") {
    const TemporaryFolder folder;
    const auto snapshot = [&](const std::vector<std::string>& more) {
      std::vector<std::string> words = tiny_snapshot(
          folder, {"--color", "displacement", "--range", "auto", "--view", "auto", "--size", "640x360"});
      words.insert(words.end(), more.begin(), more.end());
      return call(words);
    };
    REQUIRE(snapshot({"--update"}).code == 0);
    CHECK(snapshot({"--max-difference", "0"}).code == 0);
    const std::vector<std::string> faster{"--set", "speed=2.0014"};
    CHECK(snapshot(faster).code == 0);
    CHECK(text_of(folder / "out/frames/frame_00000.png") == text_of(folder / "base/frame_00000.png"));
    CHECK(snapshot({"--set", "speed=2.4"}).code == 1);
    // without look.json even the first frame differs
    fs::remove(folder / "base/look.json");
    CHECK(snapshot(faster).code == 1);
    CHECK(text_of(folder / "out/frames/frame_00000.png") != text_of(folder / "base/frame_00000.png"));
    std::ofstream(folder / "base/look.json") << R"({"color": "displacement", "range": [1]})";
    const Outcome damaged = snapshot({});
    CHECK(damaged.code == 2);
    CHECK(contains(damaged.err, "look.json"));
    CHECK(contains(damaged.err, "2 numbers"));
  }

  TEST_CASE("the update of a baseline that is a link replaces its target") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_snapshot(folder, {"--update"})).code == 0);
    fs::rename(folder / "base", folder / "shared");
    fs::create_directory_symlink("shared", folder / "base");
    REQUIRE(call(tiny_snapshot(folder, {"--frames", "2", "--update"})).code == 0);
    CHECK(fs::is_symlink(folder / "base"));
    CHECK(files_in(folder / "shared") == 4);
    CHECK(files_in(folder.path()) == 4);
  }

  TEST_CASE("a diverged or refused update leaves the baseline unchanged") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_snapshot(folder, {"--update"})).code == 0);
    const std::string frame = text_of(folder / "base/frame_00004.png");
    CHECK(call(tiny_snapshot(folder, {"--update", "--set", "cfl=20", "--until", "0.02"})).code == 3);
    CHECK(text_of(folder / "base/frame_00004.png") == frame);
    std::ofstream(folder / "base/mine.txt") << "mine";
    const Outcome outcome = call(tiny_snapshot(folder, {"--update"}));
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "mine.txt"));
    CHECK(text_of(folder / "base/mine.txt") == "mine");
    std::vector<std::string> inside = tiny_run(folder, "out", {"--baseline", folder.str("out/frames")});
    inside[0] = "snapshot";
    CHECK(call(inside).code == 2);
  }
}
