#include "render/renderer.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/error.hpp"
#include "render/gl/disc_painter.hpp"
#include "render/gl/gl_context.hpp"
#include "render/page/annotation.hpp"

namespace taut::render {
namespace {

DrawOptions checked(DrawOptions options) {
  const auto size_in_bounds = [](int size) { return size >= least_size && size <= greatest_size; };
  if (!size_in_bounds(options.width) || !size_in_bounds(options.height)) {
    throw UsageError("size " + std::to_string(options.width) + "x" + std::to_string(options.height) +
                     " is out of bounds; width and height are from " + std::to_string(least_size) + " to " +
                     std::to_string(greatest_size));
  }
  const View& view = options.view;
  const double view_width = view.x_max - view.x_min;
  const double view_height = view.y_max - view.y_min;
  if (!(view_width > 0) || !(view_height > 0) || !std::isfinite(view_width) || !std::isfinite(view_height)) {
    throw UsageError("the view is empty or not finite; it needs x_min < x_max and y_min < y_max");
  }
  if (!(options.low <= options.high) || !std::isfinite(options.high - options.low)) {
    throw UsageError("the range " + std::to_string(options.low) + ":" + std::to_string(options.high) +
                     " is reversed or not finite; write LO:HI with LO < HI");
  }
  if (!options.colormap) throw UsageError("no colour map is given; `taut list colormaps` names them");
  // A constant field has the middle colour, on a bar that is wide enough for ticks.
  const double magnitude = std::max(std::abs(options.low), std::abs(options.high));
  if (options.high - options.low <= 1e-9 * magnitude || options.high == options.low) {
    const double half = magnitude > 0 ? 0.05 * magnitude : 0.5;
    const double middle = 0.5 * (options.low + options.high);
    options.low = middle - half;
    options.high = middle + half;
  }
  return options;
}

std::uint32_t packed(Rgb color) {
  return std::bit_cast<std::uint32_t>(std::array<std::uint8_t, 4>{color[0], color[1], color[2], 255});
}

/// A gap narrower than a pixel cannot be drawn: it comes out as moiré and washes the colour out. So a disc
/// grows, by less than 0.7 pixel, until at a diameter of 2 pixels it fills the square about its particle.
double drawn_radius(double radius) {
  constexpr double full = 2.0;    // pixels, radius from which the size is kept
  constexpr double filled = 1.0;  // pixels, radius up to which the square is filled
  constexpr double rim = 0.25;    // pixels, half the width of the antialiased rim
  const double small = std::clamp((full - radius) / (full - filled), 0.0, 1.0);
  return std::lerp(radius, std::numbers::sqrt2 * radius + rim, small);
}

}  // namespace

struct Renderer::Parts {
  DrawOptions options;
  PageLayout layout;
  Image image;
  GlContext context;
  std::optional<DiscPainter> painter;
  std::optional<Annotation> annotation;  // none in pictures too small for text
  std::array<std::uint32_t, 256> colors;
  std::uint32_t not_a_number = packed(not_a_number_color);
  std::vector<Dot> discs;

  explicit Parts(const DrawOptions& options_);
  void place_discs(const FrameView& frame);
  std::uint32_t color_of(double value) const;
};

Renderer::Parts::Parts(const DrawOptions& options_)
    : options(checked(options_)),
      layout(make_layout(options.width, options.height, options.view, !options.bare)),
      image(options.width, options.height),
      context(options.width, options.height) {
  std::ranges::transform(options.colormap->table(), colors.begin(), packed);
  if (layout.font > 0) annotation.emplace(image, layout, options);
  const GlContext::Current current(context, image);
  painter.emplace(options.width, options.height, layout.plot);
}

std::uint32_t Renderer::Parts::color_of(double value) const {
  if (std::isnan(value)) return not_a_number;
  const double t = (value - options.low) / (options.high - options.low);
  return colors[static_cast<std::size_t>(std::lround(255 * std::clamp(t, 0.0, 1.0)))];
}

void Renderer::Parts::place_discs(const FrameView& frame) {
  const double width = layout.plot.width;
  const double height = layout.plot.height;
  discs.clear();
  discs.reserve(frame.value.size());
  for (std::size_t i = 0; i < frame.value.size(); ++i) {
    // doubles up to here: single precision would not tell the particles of a view far from the origin apart
    const double x = layout.column(frame.x[2 * i]);
    const double y = layout.row(frame.x[2 * i + 1]);
    const double size = 0.5 * frame.diameter[i] * layout.pixels_per_metre;
    const double radius = drawn_radius(size);
    const double reach = radius + 1;  // with the antialiased rim
    // written so that a NaN is left out
    const bool seen = size > 0 && x > -reach && x < width + reach && y > -reach && y < height + reach;
    if (!seen) continue;
    discs.push_back(
        {static_cast<float>(x), static_cast<float>(y), static_cast<float>(radius), color_of(frame.value[i])});
  }
}

Renderer::Renderer(const DrawOptions& options) : parts_(std::make_unique<Parts>(options)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

const Image& Renderer::draw(const FrameView& frame) {
  if (frame.dim == 3) throw UsageError("3D drawing is not available");
  if (frame.dim != 2 || frame.x.size() != 2 * frame.value.size() ||
      frame.diameter.size() != frame.value.size()) {
    throw std::logic_error("the arrays of a frame do not have the same number of particles");
  }
  Parts& parts = *parts_;
  parts.place_discs(frame);
  {
    const GlContext::Current current(parts.context, parts.image);
    parts.painter->draw(parts.discs);
  }
  if (parts.annotation) parts.annotation->draw(frame);
  return parts.image;
}

}  // namespace taut::render
