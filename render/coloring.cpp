#include "render/coloring.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace taut::render {
namespace {

Range widened(const Range& range) {
  const double magnitude = std::max(std::abs(range.low), std::abs(range.high));
  if (range.high - range.low > 1e-9 * magnitude && range.high != range.low) return range;
  const double half = magnitude > 0 ? 0.05 * magnitude : 0.5;
  const double middle = 0.5 * (range.low + range.high);
  return {middle - half, middle + half};
}

std::uint32_t packed(Rgb color) {
  return std::bit_cast<std::uint32_t>(std::array<std::uint8_t, 4>{color[0], color[1], color[2], 255});
}

std::optional<Range> range_of(const Look& look) {
  return look.categories.empty() ? std::optional(widened(*look.range)) : std::nullopt;
}

/// If the range contains `look.middle`, a diverging map is symmetric about it.
std::array<Rgb, 256> colors_of(const Look& look, const Range& range) {
  const double below = look.middle - range.low, above = range.high - look.middle;
  if (!look.colormap->diverging || !(below > 0 && above > 0)) return look.colormap->table();
  const double most = std::max(below, above);
  return look.colormap->table(0.5 - 0.5 * below / most, 0.5 + 0.5 * above / most);
}

ColorKey key_of(const Look& look) {
  const bool across = look.texts.bar == BarPosition::bottom;
  if (const auto range = range_of(look))
    return ColorKey(ColorBar(range->low, range->high, colors_of(look, *range), not_a_number_color,
                             look.bar_format, across));
  std::vector<Legend::Entry> entries;
  for (std::size_t k = 0; k < look.categories.size(); ++k)
    if (std::ranges::find(look.unlisted, static_cast<int>(k)) == look.unlisted.end())
      entries.push_back({look.categories[k], category_color(k)});
  return ColorKey(Legend(std::move(entries), across));
}

}  // namespace

Coloring::Coloring(const Look& look) : range_(range_of(look)), key_(key_of(look)) {
  if (range_)
    for (const Rgb color : colors_of(look, *range_)) colors_.push_back(packed(color));
  for (std::size_t k = 0; k < look.categories.size(); ++k) colors_.push_back(packed(category_color(k)));
}

float Coloring::place(double value) const {
  if (std::isnan(value)) return no_place;
  const double place = range_ ? (value - range_->low) / (range_->high - range_->low)
                              : value / std::max(1.0, static_cast<double>(colors_.size() - 1));
  return std::clamp(static_cast<float>(place), -farthest_place, farthest_place);
}

std::uint32_t Coloring::operator()(double value) const {
  if (std::isnan(value)) return packed(not_a_number_color);
  const double last = static_cast<double>(colors_.size() - 1);
  const double place = range_ ? (value - range_->low) / (range_->high - range_->low) * last : value;
  return colors_[static_cast<std::size_t>(std::lround(std::clamp(place, 0.0, last)))];
}

std::vector<std::uint32_t> Coloring::palette() const {
  std::vector<std::uint32_t> all = colors_;
  all.push_back(packed(not_a_number_color));
  return all;
}

OffScale Coloring::off_scale(double value) const {
  if (!range_) return {};
  const double half = (range_->high - range_->low) / static_cast<double>(colors_.size()) / 2;
  return {.below = value<range_->low - half, .above = value> range_->high + half,
          .no_number = std::isnan(value)};
}

}  // namespace taut::render
