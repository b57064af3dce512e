#include "render/page/page_layout.hpp"

#include <algorithm>
#include <cmath>

namespace taut::render {
namespace {

// smaller pictures have no texts
constexpr int least_text_width = 240;
constexpr int least_text_height = 120;
constexpr double least_font = 9;

// Lengths in em.
constexpr double margin = 1.1;
constexpr double header = 3.0;
constexpr double footer = 2.3;
constexpr double key_gap = 1.1;
constexpr double most_of_width = 0.36;

int pixels(double length) { return static_cast<int>(std::lround(length)); }

int top_of_plot(double em, const TextParts& parts) { return pixels((parts.header() ? header : margin) * em); }

/// Without a footer, the arrows of the colour bar still need the margin.
int below_plot(double em, const TextParts& parts) { return pixels((parts.scale ? footer : margin) * em); }

void place_all(PageLayout& layout, int width, int height, double room, const TextParts& parts) {
  const double em = layout.font;
  const int left = pixels(margin * em);
  const int top = top_of_plot(em, parts), below = below_plot(em, parts);
  layout.right = width - margin * em;
  if (!parts.bar) {
    layout.plot = {left, top, pixels(layout.right) - left, height - below - top};
    return;
  }
  const double wide = std::max(std::min(room * em, most_of_width * width), room_of_bar * em);
  const int key_left = pixels(layout.right - wide);
  layout.plot = {left, top, key_left - pixels(key_gap * em) - left, height - below - top};
  layout.key = {key_left, top, pixels(wide), layout.plot.height};
}

}  // namespace

TextSize text_size(int width, int height, const PageTexts& texts) {
  const auto with_key = [&](double em) {
    return TextSize{em, height - below_plot(em, texts.parts) - top_of_plot(em, texts.parts)};
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
    place_all(layout, width, height, room, texts.parts);
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
