#include <cstdlib>

#include <doctest/doctest.h>

#include "render/image/png.hpp"
#include "tests/support/path_variable.hpp"
#include "tests/support/program_runner.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

void write_ffmpeg(const TemporaryFolder& folder, const std::string& script) {
  fs::create_directories(folder / "bin");
  std::ofstream(folder / "bin/ffmpeg") << "#!/bin/sh\n" << script;
  fs::permissions(folder / "bin/ffmpeg", fs::perms::owner_all);
}

void write_frames(const fs::path& folder, int count, int width = 64) {
  fs::create_directories(folder);
  for (int k = 0; k < count; ++k) {
    taut::render::Image image(width, 65);
    for (int row = 0; row < 65; ++row) image.set(k, row, {200, 0, 0});
    taut::render::write_png(image, folder / ("frame_0000" + std::to_string(k) + ".png"));
  }
}

bool there_is(const std::string& program) {
  return std::system((program + " -version >/dev/null 2>&1").c_str()) == 0;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("ffmpeg gets the frames in order, and the movie gets its name when it is complete") {
    const TemporaryFolder folder;
    const fs::path frames = folder / "50%d of it; 'all'";
    write_frames(frames, 3);
    write_ffmpeg(folder,
                 "for last; do :; done\n"
                 "printf '%s\\n' \"$PWD\" \"$@\" > \"${last#file:}\"\n");
    const OnlyPath path(folder / "bin");
    const Outcome outcome = call({"movie", frames, "--out", folder.str("a b:c.mp4"), "--fps", "12.5"});
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.out, "3 frames, 0.24 s"));
    const std::vector<std::string> seen = lines_of(folder / "a b:c.mp4");
    REQUIRE(seen.size() > 5);
    CHECK(seen[0] == fs::canonical(frames).string());
    CHECK(seen.back() == "file:" + folder.str("a b:c.mp4.part/a b:c.mp4"));
    CHECK(contains(text_of(folder / "a b:c.mp4"), "-framerate\n12.5\n-i\nframe_%05d.png\n"));
    CHECK(files_in(folder.path()) == 3);
  }

  TEST_CASE("a missing or failing ffmpeg gives exit code 4 and leaves no movie") {
    const TemporaryFolder folder;
    write_frames(folder / "frames", 1);
    fs::create_directories(folder / "bin");
    const OnlyPath path(folder / "bin");
    const std::vector<std::string> arguments{"movie", folder.str("frames"), "--out", folder.str("m.gif")};
    const Outcome missing = call(arguments);
    CHECK(missing.code == 4);
    CHECK(contains(missing.err, "apt-get install ffmpeg"));
    write_ffmpeg(folder,
                 "for last; do :; done\n"
                 "echo half > \"${last#file:}\"\n"
                 "for k in 1 2 3 4 5 6 7; do echo reason $k >&2; done\nexit 7\n");
    const Outcome failed = call(arguments);
    CHECK(failed.code == 4);
    CHECK(contains(failed.err, "exit code 7"));
    CHECK(contains(failed.err, "reason 7"));
    CHECK_FALSE(contains(failed.err, "reason 2"));
    CHECK(files_in(folder.path()) == 2);
  }

  TEST_CASE("missing frames, devices as frames and unknown formats are refused") {
    const TemporaryFolder folder;
    write_frames(folder / "frames", 4);
    fs::create_symlink("/dev/null", folder / "frames/frame_00004.png");
    CHECK(contains(call({"movie", folder.str("frames"), "--out", folder.str("m.mp4")}).err,
                   "frame_00004.png in " + folder.str("frames") + " is not a regular file"));
    fs::remove(folder / "frames/frame_00004.png");
    fs::create_directories(folder / "empty");
    CHECK(call({"movie", folder.str("empty"), "--out", folder.str("m.mp4")}).code == 2);
    CHECK(call({"movie", folder.str("frames"), "--out", folder.str("m.avi")}).code == 2);
    fs::remove(folder / "frames/frame_00002.png");
    const Outcome gap = call({"movie", folder.str("frames"), "--out", folder.str("m.mp4")});
    CHECK(gap.code == 2);
    CHECK(contains(gap.err, "frame_00002.png is missing"));
    fs::remove(folder / "frames/frame_00000.png");
    fs::remove(folder / "frames/frame_00001.png");
    CHECK(contains(call({"movie", folder.str("frames"), "--out", folder.str("m.mp4")}).err,
                   "frame_00000.png is missing"));
  }

  TEST_CASE("the real ffmpeg makes movies of frames with odd sides") {
    if (!there_is("ffmpeg") || !there_is("ffprobe")) {
      MESSAGE("skipped: ffmpeg is not installed");
      return;
    }
    const TemporaryFolder folder;
    write_frames(folder / "frames", 5, 75);
    const std::string probe =
        "ffprobe -v error -count_frames -show_entries stream=width,height,nb_read_frames -of csv=p=0 ";
    for (const auto& [name, expected] : {std::pair{"m.mp4", "76,66,5"}, {"m.gif", "75,65,5"}}) {
      const Outcome outcome = call({"movie", folder.str("frames"), "--out", folder.str(name)});
      CHECK_MESSAGE(outcome.code == 0, outcome.err);
      REQUIRE(std::system((probe + folder.str(name) + " > " + folder.str("probe")).c_str()) == 0);
      CHECK(contains(text_of(folder / "probe"), expected));
    }
  }
}
