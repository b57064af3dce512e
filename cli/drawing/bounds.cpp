#include "cli/drawing/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace taut::cli {
namespace {

constexpr double outside = 0.01;       // share of values clipped at each end
constexpr double not_far = 0.25;       // share of the range; clipped values that widen it less are included
constexpr std::size_t most = 1 << 22;  // values in the sample

/// False for NaN and magnitudes whose products could overflow.
bool counts(double value) {
  constexpr double greatest = 1e100;
  return std::abs(value) < greatest;
}

render::Range ends_of(std::vector<double> values) {
  const auto place = static_cast<std::ptrdiff_t>(outside * static_cast<double>(values.size()));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  const double low = values[static_cast<std::size_t>(place)];
  std::nth_element(values.begin(), values.end() - 1 - place, values.end());
  return {low, *(values.end() - 1 - place)};
}

}  // namespace

SequenceBounds::SequenceBounds(const std::optional<render::Camera>& camera) {
  if (camera) axes_ = axes_of(*camera);
}

void SequenceBounds::Interval::add(double value, double margin) {
  if (!counts(value)) return;
  low = std::min(low, value - margin);
  high = std::max(high, value + margin);
}

void SequenceBounds::add_values(std::span<const double> values) {
  for (const double value : values) {
    if (!counts(value)) continue;
    values_.add(value);
    if (seen_++ % stride_ == 0) sample_.push_back(value);
    if (sample_.size() < most) continue;
    for (std::size_t k = 0; k < most / 2; ++k) sample_[k] = sample_[2 * k];
    sample_.resize(most / 2);
    stride_ *= 2;
  }
}

void SequenceBounds::add_positions(std::span<const double> x, int dim, double diameter) {
  const auto stride = static_cast<std::size_t>(dim);
  for (std::size_t i = 0; i + 1 < x.size(); i += stride) {
    if (!axes_) {
      x_.add(x[i], diameter / 2);
      y_.add(x[i + 1], diameter / 2);
      continue;
    }
    const render::Vector at{x[i], x[i + 1], x[i + 2]};
    x_.add(render::dot(axes_->right, at), diameter / 2);
    y_.add(render::dot(axes_->up, at), diameter / 2);
    z_.add(render::dot(axes_->back, at), diameter / 2);
  }
}

void SequenceBounds::add(const FrameView& particles) {
  if (particles.value.empty()) return;
  add_values(particles.value);
  add_positions(particles.x, particles.dim, std::ranges::max(particles.diameter));
}

render::Range SequenceBounds::range(std::optional<double> middle, double round_off) const {
  double low = 0, high = 0;
  if (!sample_.empty()) {
    const render::Range all = ends_of(sample_);
    low = all.low, high = all.high;
    std::vector<double> moved = sample_;
    std::erase_if(moved, [&](double value) { return std::abs(value) <= round_off; });
    if (const render::Range some = moved.empty() ? all : ends_of(std::move(moved)); true)
      low = std::min(low, some.low), high = std::max(high, some.high);
    const double room = not_far * (high - low);
    if (values_.low > low - room) low = values_.low;
    if (values_.high < high + room) high = values_.high;
  }
  if (middle) {
    const double half = std::max(std::abs(low - *middle), std::abs(high - *middle));
    low = *middle - half, high = *middle + half;
  }
  if (high > low) return {low, high};
  // uniform values
  if (low == 0 && !middle) return {0, 1};
  const double half = low != 0 ? 0.5 * std::abs(low) : 1;
  return {low - half, low + half};
}

render::View SequenceBounds::view() const {
  if (x_.low > x_.high) return {0, 1, 0, 1};
  const double margin = 0.05 * std::max(x_.high - x_.low, y_.high - y_.low);
  return {x_.low - margin, x_.high + margin, y_.low - margin, y_.high + margin};
}

render::View SequenceBounds::view_about_origin() const {
  if (x_.low > x_.high) return {-1, 1, -1, 1};
  const double x = 1.5 * std::max(std::abs(x_.low), std::abs(x_.high));
  const double y = 1.5 * std::max(std::abs(y_.low), std::abs(y_.high));
  return {-x, x, -y, y};
}

SequenceBounds::Orbit SequenceBounds::orbit() const {
  Orbit orbit{{-1, 1, -1, 1}, {}};
  if (!axes_ || x_.low > x_.high) return orbit;
  double square = 0;
  for (const auto& [interval, axis] :
       {std::pair(&x_, &axes_->right), std::pair(&y_, &axes_->up), std::pair(&z_, &axes_->back)}) {
    const double half = (interval->high - interval->low) / 2, centre = interval->low + half;
    square += half * half;
    for (std::size_t k = 0; k < 3; ++k) orbit.middle[k] += centre * (*axis)[k];
  }
  const double radius = std::sqrt(square);
  orbit.view = {-radius, radius, -radius, radius};
  return orbit;
}

double SequenceBounds::front() const { return z_.low > z_.high ? 0 : z_.high; }

namespace {

render::Range at_least(double width, render::Range range, std::optional<double> middle) {
  if (range.high - range.low >= width) return range;
  const double low = middle ? *middle - width / 2 : std::abs(range.low) < width ? 0 : range.low;
  return {low, low + width};
}

}  // namespace

Drawing fitted(Drawing drawing, const SequenceBounds& shown) {
  render::Look& look = drawing.look;
  const ColorMeaning colors = meaning(drawing);
  look.unit = colors.unit;
  if (look.categories.empty()) {
    const std::optional<double> middle = colors.middle;
    look.middle = middle.value_or(0);
    if (!look.colormap)
      look.colormap =
          &*std::ranges::find(render::colormaps(), middle.has_value(), &render::Colormap::diverging);
    if (!look.range) look.range = at_least(drawing.round_off, shown.range(middle, drawing.round_off), middle);
  }
  if (look.view) return drawing;
  look.view = drawing.followed ? shown.view_about_origin() : shown.view();
  if (look.camera) look.camera->front = shown.front();
  return drawing;
}

}  // namespace taut::cli
