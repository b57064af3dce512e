#include <set>
#include <vector>

#include <doctest/doctest.h>

#include "cli/drawing/frames.hpp"
#include "engine/error.hpp"
#include "render/image/image_difference.hpp"
#include "render/image/png.hpp"
#include "tests/support/files.hpp"
#include "tests/support/synthetic.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace fs = std::filesystem;

namespace {

constexpr int count = 20;  // exceeds the number drawn concurrently

struct Sequence {
  render::Look look;
  Particles particles = two_rings();
  Origins origins;

  Sequence() {
    look.size = render::Size{320, 180};
    look.colormap = render::find_colormap("viridis");
    look.range = render::Range{0, 1};
    look.view = rings_view;
    const std::size_t n = particles.value.size();
    origins = {2, particles.x, std::vector<double>(n, 1), particles.diameter, std::vector<int>(n, 0)};
  }
  Drawing drawing() const {
    Drawing drawing;
    drawing.look = look;
    return drawing;
  }
  void add_next(Frames& frames) {
    for (double& x : particles.x) x += 0.0005;
    for (double& value : particles.value) value = 0.9 * value;
    frames.add(particles.frame());
  }
};

std::string all_bytes(const fs::path& folder, int most = count) {
  std::string bytes;
  for (int k = 0; k < most; ++k) bytes += frame_name(k) + text_of(folder / frame_name(k));
  return bytes;
}

}  // namespace

TEST_SUITE("image") {
  TEST_CASE("frames are the same bytes for any number of threads, drawn immediately or after the run") {
    for (const bool kept : {false, true}) {
      std::string first;
      for (const int threads : {1, 2, 3, 8}) {
        const TemporaryFolder folder;
        const fs::path out = folder / ".";
        Sequence sequence;
        if (kept) sequence.look.range.reset();
        Seconds seconds;
        Frames frames(sequence.drawing(), sequence.origins, out, {"rings", "enog", 1}, threads, seconds);
        for (int k = 0; k < count; ++k) sequence.add_next(frames);
        CHECK(frames.draw_kept([](int) { return true; }));
        frames.finish();
        CHECK(frames.written() == count);
        CHECK(files_in(out) == count);
        CHECK(seconds.render > 0);
        CHECK(seconds.write > 0);
        const std::string bytes = all_bytes(out);
        if (first.empty()) first = bytes;
        CHECK(bytes == first);
      }
    }
  }

  TEST_CASE("at any time during a run, all frames counted as written exist") {
    const TemporaryFolder folder;
    const fs::path out = folder / ".";
    Sequence sequence;
    Seconds seconds;
    Frames frames(sequence.drawing(), sequence.origins, out, {}, 3, seconds);
    for (int k = 0; k < count; ++k) {
      sequence.add_next(frames);
      const int written = frames.written();
      for (int j = 0; j < written; ++j) CHECK(fs::exists(out / frame_name(j)));
    }
    frames.finish();
    CHECK(frames.written() == count);
  }

  TEST_CASE("a stopped sequence leaves complete frames from the first one on") {
    for (const int threads : {1, 3}) {
      const TemporaryFolder folder;
      const fs::path out = folder / ".";
      Sequence sequence;
      sequence.look.range.reset();
      Seconds seconds;
      Frames frames(sequence.drawing(), sequence.origins, out, {}, threads, seconds);
      for (int k = 0; k < count; ++k) sequence.add_next(frames);
      CHECK_FALSE(frames.draw_kept([](int drawn) { return drawn < 7; }));
      CHECK(frames.written() == 7);
      CHECK(files_in(out) == 7);
    }
  }

  TEST_CASE("a frame that cannot be written is an error, and earlier frames stay") {
    for (const int threads : {1, 2, 3}) {
      const TemporaryFolder folder;
      const fs::path out = folder / ".";
      fs::create_directories(out / frame_name(5) / "something");
      Sequence sequence;
      Seconds seconds;
      Frames frames(sequence.drawing(), sequence.origins, out, {}, threads, seconds);
      const auto draw_all = [&] {
        for (int k = 0; k < count; ++k) sequence.add_next(frames);
        frames.finish();
      };
      CHECK_THROWS_AS(draw_all(), OutputError);
      CHECK(frames.written() == 5);
      CHECK(files_in(out) == 6);
      CHECK_NOTHROW(render::read_png(out / frame_name(4)));
    }
  }

  TEST_CASE("pictures so large that one is drawn at a time have the same bytes for one thread and eight") {
    std::string first;
    for (const int threads : {1, 8}) {
      const TemporaryFolder folder;
      const fs::path out = folder / ".";
      Sequence sequence;
      sequence.look.size = render::Size{4000, 3000};
      Seconds seconds;
      Frames frames(sequence.drawing(), sequence.origins, out, {}, threads, seconds);
      for (int k = 0; k < 3; ++k) sequence.add_next(frames);
      frames.finish();
      const std::string bytes = all_bytes(out, 3);
      if (first.empty()) first = bytes;
      CHECK(bytes == first);
    }
  }

  TEST_CASE("a body far from the origin looks like one at the origin, with an automatic range and view") {
    const auto frame_at = [](double x, double y) {
      const TemporaryFolder folder;
      Sequence sequence;
      sequence.look.range.reset(), sequence.look.view.reset();
      for (std::size_t k = 0; k < sequence.particles.x.size(); k += 2) {
        sequence.particles.x[k] = x + sequence.particles.x[k] / 64;
        sequence.particles.x[k + 1] = y + sequence.particles.x[k + 1] / 64;
      }
      for (double& diameter : sequence.particles.diameter) diameter /= 64;
      sequence.origins.x0 = sequence.particles.x, sequence.origins.diameter = sequence.particles.diameter;
      Seconds seconds;
      Frames frames(sequence.drawing(), sequence.origins, folder / ".", {}, 1, seconds);
      frames.add(sequence.particles.frame());
      frames.draw_kept([](int) { return true; });
      return render::read_png(folder / frame_name(0));
    };
    // single precision would round by 1e-4 m; a ring has an outer radius of 6e-4 m
    const render::ImageDifference difference = compare(frame_at(1000, 2000), frame_at(0, 0));
    CHECK(difference.share < 0.001);
  }

  TEST_CASE("values that differ little have many colours with an automatic range") {
    const TemporaryFolder folder;
    Sequence sequence;
    sequence.look.range.reset();
    for (double& value : sequence.particles.value) value = 1200 + 1e-5 * value;
    Seconds seconds;
    Frames frames(sequence.drawing(), sequence.origins, folder / ".", {}, 1, seconds);
    frames.add(sequence.particles.frame());
    frames.draw_kept([](int) { return true; });
    const render::Image image = render::read_png(folder / frame_name(0));
    const render::PageLayout layout = render::make_layout(image.width, image.height, rings_view);
    std::set<render::Rgb> colors;
    for (int row = layout.plot.y; row < layout.plot.y + layout.plot.height; ++row)
      for (int column = layout.plot.x; column < layout.plot.x + layout.plot.width / 2; ++column)
        colors.insert(image.at(column, row));
    const auto is_seen = [&](const render::Rgb& color) { return colors.contains(color); };
    // blended rims rarely match a colour of the map
    CHECK(std::ranges::count_if(sequence.look.colormap->table(), is_seen) > 50);
  }
}
