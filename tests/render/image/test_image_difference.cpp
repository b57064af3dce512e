#include <algorithm>

#include <doctest/doctest.h>

#include "engine/error.hpp"
#include "render/image/image_difference.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/synthetic.hpp"

using namespace taut;
using namespace taut::render;
using namespace taut::test;

TEST_SUITE("unit") {
  TEST_CASE("a picture and itself are alike") {
    Image image(50, 40);
    image.set(3, 4, {10, 20, 30});
    const ImageDifference difference = compare(image, image);
    CHECK(difference.share == 0);
    CHECK(difference.greatest == 0);
    CHECK(difference.densest == 0);
    CHECK(alike(difference));
  }

  TEST_CASE("only pixels beyond the tolerance are counted") {
    const Image a(100, 50);
    Image b = a;
    b.set(10, 10, {254, 254, 254});  // invisible
    for (int i = 0; i < 25; ++i) b.set(i, 49, {0, 0, 0});
    const ImageDifference difference = compare(a, b);
    CHECK(difference.share == Approx(25.0 / 5000));
    CHECK(difference.greatest == Approx(100).epsilon(1e-3));
    CHECK_FALSE(alike(difference));
    CHECK(compare(a, b, 101).share == 0);
    CHECK(compare(a, b, 0).share == Approx(26.0 / 5000));
    CHECK(compare(b, a).share == difference.share);
  }

  TEST_CASE("the densest window is found") {
    const Image a(200, 100);
    Image b = a;
    for (int i = 0; i < 8; ++i) b.set(25 * i, 10, {0, 0, 0});
    for (int row = 70; row < 74; ++row) {
      for (int column = 150; column < 158; ++column) b.set(column, row, {0, 0, 0});
    }
    const ImageDifference difference = compare(a, b);
    CHECK(difference.densest == Approx(32.0 / 256));
    CHECK(difference.column <= 150);
    CHECK(difference.column + 16 >= 158);
    CHECK(difference.row <= 70);
    CHECK(difference.row + 16 >= 74);
  }

  TEST_CASE("a window is 16 pixels wide and high") {
    const Image a(64, 64);
    for (const int start : {0, 20, 47}) {
      for (const int apart : {15, 16}) {
        Image across = a, along = a;
        for (const int i : {start, start + apart}) {
          across.set(i, 30, {0, 0, 0});
          along.set(30, i, {0, 0, 0});
        }
        const double expected = (apart < 16 ? 2.0 : 1.0) / 256;
        CHECK(compare(a, across).densest == Approx(expected));
        CHECK(compare(a, along).densest == Approx(expected));
      }
    }
  }

  TEST_CASE("a change spread thinly over the picture is found by its share of pixels") {
    const Image a(160, 160);
    Image b = a;
    for (int i = 0; i < 400; ++i) b.set(8 * (i % 20), 8 * (i / 20), {0, 0, 0});
    const ImageDifference difference = compare(a, b);
    CHECK(difference.densest < DifferenceLimit{}.densest);
    CHECK_FALSE(alike(difference));
    CHECK(alike(difference, {.share = 0.02}));
  }

  TEST_CASE("a window fits into small pictures and reaches every corner") {
    for (const auto& [width, height] : {std::pair{1, 1}, {5, 40}, {40, 5}, {16, 16}, {17, 33}}) {
      const Image a(width, height);
      for (const int column : {0, width - 1}) {
        for (const int row : {0, height - 1}) {
          Image b = a;
          b.set(column, row, {0, 0, 0});
          const ImageDifference difference = compare(a, b);
          CHECK(difference.densest == Approx(1.0 / (std::min(width, 16) * std::min(height, 16))));
          CHECK(difference.column <= column);
          CHECK(difference.column + difference.width > column);
          CHECK(difference.row <= row);
          CHECK(difference.row + difference.height > row);
        }
      }
    }
  }

  TEST_CASE("the excess of a difference is its worst ratio to a limit") {
    const ImageDifference difference{.share = 0.01, .greatest = 30, .densest = 0.02};
    CHECK(excess(difference, {.share = 0.005, .densest = 0.04}) == Approx(2));
    CHECK(excess(difference, {.share = 0.02, .densest = 0.005}) == Approx(4));
    CHECK(excess(difference, {.share = 1, .densest = 1, .greatest = 10}) == Approx(3));
    CHECK(alike(difference, {.share = 1, .densest = 1, .greatest = 30}));
    CHECK_FALSE(alike(difference, {.share = 1, .densest = 1, .greatest = 29}));
    CHECK_FALSE(alike(difference, {.share = 1, .densest = 1, .greatest = 0}));
    CHECK(alike({}, {.share = 0, .densest = 0, .greatest = 0}));
  }

  TEST_CASE("different sizes are refused") {
    CHECK_THROWS_WITH_AS(compare(Image(4, 5), Image(5, 4)),
                         "the images differ in size: 4x5 and 5x4; draw both with the same --size",
                         UsageError);
    CHECK_THROWS_AS(difference_picture(Image(4, 5), Image(4, 6)), UsageError);
  }

  TEST_CASE("a difference picture shows a different pixel in red and an equal one in gray") {
    const Image a(60, 60);
    Image b = a;
    b.set(30, 31, {0, 0, 0});
    const Image picture = difference_picture(a, b);
    const Rgb mark = picture.at(30, 31);
    CHECK(mark[0] > mark[1] + 50);
    CHECK(picture.at(29, 31)[0] == picture.at(29, 31)[1]);
    CHECK(difference_picture(a, a).at(30, 31) == picture.at(29, 31));
  }
}

TEST_SUITE("image") {
  TEST_CASE("one particle moved by its radius, in a picture of many, is found") {
    Particles particles = two_rings();
    Renderer renderer(look(640, 360, rings_view));
    const Image right = renderer.draw(particles.frame());
    particles.x[2 * 100] += 0.001;
    const ImageDifference difference = compare(right, renderer.draw(particles.frame()));
    CHECK_FALSE(alike(difference));
    CHECK(difference.share < 0.002);  // the share alone would accept it
  }

  TEST_CASE("one particle of another colour is found in a picture of many") {
    Particles particles = two_rings();
    Renderer renderer(look(640, 360, rings_view));
    const Image right = renderer.draw(particles.frame());
    particles.value[100] += particles.value[100] > 0.5 ? -0.3 : 0.3;
    CHECK_FALSE(alike(compare(right, renderer.draw(particles.frame()))));
  }

  TEST_CASE("a shift of colours too small to be seen is accepted") {
    Particles particles = two_rings();
    Renderer renderer(look(640, 360, rings_view));
    const Image right = renderer.draw(particles.frame());
    for (double& value : particles.value) value += 1e-4;
    CHECK(alike(compare(right, renderer.draw(particles.frame()))));
  }
}
