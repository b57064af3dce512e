#include "render/page/page_layout.hpp"

#include <algorithm>
#include <cmath>

namespace taut::render {
namespace {

// smaller pictures have no texts unless a font is chosen
constexpr int least_text_width = 240;
constexpr int least_text_height = 120;
constexpr double least_font = 9;

// Lengths in em.
constexpr double margin = 1.1;
constexpr double header = 3.0;
constexpr double footer = 2.3;
constexpr double key_gap = 1.1;
constexpr double most_of_width = 0.36;  // share of the picture

int pixels(double length) { return static_cast<int>(std::lround(length)); }

int top_of_plot(double em, const TextParts& parts) { return pixels((parts.header() ? header : margin) * em); }

/// Without a footer, the arrows of the colour bar still need the margin.
int below_plot(double em, const PageTexts& texts) {
  double room = texts.parts.scale ? footer : margin;
  if (texts.has_bar(BarPosition::bottom)) room += room_of_bar_below;
  if (texts.axes_outside && texts.parts.axes) room = std::max(room, room_of_axes);
  return pixels(room * em);
}

void place_all(PageLayout& layout, int width, int height, double room, const PageTexts& texts) {
  const double em = layout.font;
  const int left = pixels(margin * em), gap = pixels(key_gap * em);
  const int top = top_of_plot(em, texts.parts), below = below_plot(em, texts);
  layout.left = left, layout.right = width - margin * em;
  const int right = pixels(layout.right), bottom = height - below;
  const double wide = std::max(std::min(room * em, most_of_width * width), room_of_bar * em);
  layout.plot = {left, top, right - left, bottom - top};
  if (texts.has_bar(BarPosition::bottom)) {
    const int end = texts.axes_outside && texts.parts.axes ? right - pixels(room_of_axes * em) : right;
    const int high = pixels(room_of_bar_below * em);
    layout.key = {left, height - high, end - left, high};
  } else if (texts.has_bar(BarPosition::left)) {
    layout.key = {left, top, pixels(wide), bottom - top};
    layout.plot.x = left + pixels(wide) + gap;
    layout.plot.width = right - layout.plot.x;
  } else if (texts.has_bar(BarPosition::right)) {
    layout.key = {pixels(layout.right - wide), top, pixels(wide), bottom - top};
    layout.plot.width = layout.key.x - gap - left;
  }
}

}  // namespace

TextSize text_size(int width, int height, const PageTexts& texts) {
  const auto with_key = [&](double em) {
    return TextSize{em, height - below_plot(em, texts) - top_of_plot(em, texts.parts)};
  };
  if (texts.font > 0) return with_key(texts.font);
  if (width < least_text_width || height < least_text_height) return {};
  // 16 pixels at 1280 × 720
  const double scale = std::min(width / 1280.0, height / 720.0);
  const double area = std::sqrt((width / 1280.0) * (height / 720.0));
  const double em = std::max(16.0 * std::min(area, 1.3 * scale), least_font);
  return with_key(em);
}

PageLayout make_layout(int width, int height, const View& view, bool with_texts, double room,
                       const PageTexts& texts) {
  PageLayout layout;
  if (with_texts) layout.font = text_size(width, height, texts).font;
  if (layout.font > 0) {
    place_all(layout, width, height, room, texts);
  } else {
    layout.plot = {0, 0, width, height};
  }
  layout.pixels_per_metre =
      std::min(layout.plot.width / (view.x_max - view.x_min), layout.plot.height / (view.y_max - view.y_min));
  layout.x_origin = 0.5 * layout.plot.width - 0.5 * (view.x_min + view.x_max) * layout.pixels_per_metre;
  layout.y_origin = 0.5 * layout.plot.height + 0.5 * (view.y_min + view.y_max) * layout.pixels_per_metre;
  return layout;
}

}  // namespace taut::render
