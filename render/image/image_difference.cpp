#include "render/image/image_difference.hpp"

#include <algorithm>
#include <string>

#include "engine/error.hpp"
#include "render/image/color_space.hpp"

namespace taut::render {
namespace {

constexpr int window_size = 16;

void require_same_size(const Image& a, const Image& b) {
  if (a.width == b.width && a.height == b.height) return;
  const auto size = [](const Image& image) {
    return std::to_string(image.width) + "x" + std::to_string(image.height);
  };
  throw UsageError("the images differ in size: " + size(a) + " and " + size(b) +
                   "; draw both with the same --size");
}

class DensestWindow {
 public:
  DensestWindow(int width, int height)
      : width_(std::min(width, window_size)),
        height_(std::min(height, window_size)),
        column_sums_(static_cast<std::size_t>(width)),
        history_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height_)) {}

  void add_row(int row, const std::vector<std::uint8_t>& differs) {
    std::uint8_t* slot = &history_[static_cast<std::size_t>(row % height_) * differs.size()];
    for (std::size_t i = 0; i < differs.size(); ++i) {
      column_sums_[i] += differs[i] - slot[i];
      slot[i] = differs[i];
    }
    if (row + 1 < height_) return;
    int sum = 0;
    for (int i = 0; i < static_cast<int>(differs.size()); ++i) {
      sum += column_sums_[static_cast<std::size_t>(i)];
      if (i >= width_) sum -= column_sums_[static_cast<std::size_t>(i - width_)];
      if (i + 1 >= width_ && sum > most_) {
        most_ = sum;
        column_ = i + 1 - width_;
        top_ = row + 1 - height_;
      }
    }
  }

  void store(ImageDifference& result) const {
    result.densest = static_cast<double>(most_) / (width_ * height_);
    result.column = column_, result.row = top_;
    result.width = width_, result.height = height_;
  }

 private:
  int width_, height_;
  int most_ = 0, column_ = 0, top_ = 0;
  std::vector<int> column_sums_;
  std::vector<std::uint8_t> history_;
};

Rgb mix(Rgb a, Rgb b, double f) {
  Rgb c;
  for (std::size_t k = 0; k < 3; ++k) c[k] = static_cast<std::uint8_t>((1 - f) * a[k] + f * b[k] + 0.5);
  return c;
}

void frame(Image& image, const ImageDifference& at, Rgb color) {
  const int left = std::max(at.column - 2, 0);
  const int top = std::max(at.row - 2, 0);
  const int right = std::min(at.column + at.width + 1, image.width - 1);
  const int bottom = std::min(at.row + at.height + 1, image.height - 1);
  for (int x = left; x <= right; ++x) image.set(x, top, color), image.set(x, bottom, color);
  for (int y = top; y <= bottom; ++y) image.set(left, y, color), image.set(right, y, color);
}

}  // namespace

ImageDifference compare(const Image& a, const Image& b, double tolerance) {
  require_same_size(a, b);
  ImageDifference result;
  if (a.pixels.empty()) return result;
  DensestWindow window(a.width, a.height);
  std::vector<std::uint8_t> differs(static_cast<std::size_t>(a.width));
  long count = 0;
  for (int row = 0; row < a.height; ++row) {
    for (int column = 0; column < a.width; ++column) {
      const double difference = color_difference(a.at(column, row), b.at(column, row));
      result.greatest = std::max(result.greatest, difference);
      differs[static_cast<std::size_t>(column)] = difference > tolerance;
      count += difference > tolerance;
    }
    window.add_row(row, differs);
  }
  result.share = static_cast<double>(count) / (static_cast<double>(a.width) * a.height);
  window.store(result);
  return result;
}

double excess(const ImageDifference& difference, const DifferenceLimit& limit) {
  const auto times = [](double value, double most) { return value > 0 ? value / most : 0.0; };
  return std::max({times(difference.share, limit.share), times(difference.densest, limit.densest),
                   times(difference.greatest, limit.greatest)});
}

bool alike(const ImageDifference& difference, const DifferenceLimit& limit) {
  return excess(difference, limit) <= 1;
}

Image difference_picture(const Image& a, const Image& b, double tolerance) {
  constexpr Rgb slight = {0xfd, 0x8d, 0x3c};
  constexpr Rgb strong = {0x80, 0x00, 0x26};
  constexpr double strong_at = 50;  // ΔE*ab of the darkest colour
  const ImageDifference difference = compare(a, b, tolerance);
  Image picture(a.width, a.height);
  for (int row = 0; row < a.height; ++row) {
    for (int column = 0; column < a.width; ++column) {
      const double d = color_difference(a.at(column, row), b.at(column, row));
      if (d > tolerance) {
        picture.set(column, row, mix(slight, strong, std::min(d / strong_at, 1.0)));
      } else {
        const auto pale = static_cast<std::uint8_t>(195 + 0.6 * lab_of(a.at(column, row)).L);
        picture.set(column, row, {pale, pale, pale});
      }
    }
  }
  if (difference.densest > 0) frame(picture, difference, {0x20, 0x60, 0xc0});
  return picture;
}

}  // namespace taut::render
