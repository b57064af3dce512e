#include "cli/drawing/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace taut::cli {

SequenceBounds::SequenceBounds(const std::optional<render::Camera>& camera) {
  if (camera) axes_ = axes_of(*camera);
}

void SequenceBounds::Interval::add(double value, double margin) {
  if (!std::isfinite(value)) return;
  low = std::min(low, value - margin);
  high = std::max(high, value + margin);
}

void SequenceBounds::add_values(std::span<const float> values) {
  for (const float value : values) values_.add(value);
}

void SequenceBounds::add_positions(std::span<const float> x, int dim, double diameter) {
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
  add_values(std::vector<float>(particles.value.begin(), particles.value.end()));
  add_positions(std::vector<float>(particles.x.begin(), particles.x.end()), particles.dim,
                std::ranges::max(particles.diameter));
}

render::Range SequenceBounds::range(bool is_signed) const {
  double low = values_.low, high = values_.high;
  if (low > high) low = high = 0;  // no finite value at all
  if (is_signed) {
    high = std::max(std::abs(low), std::abs(high));
    low = -high;
  }
  // a field that is the same everywhere still needs a scale to be drawn on
  if (high <= low) high = low + (low != 0 ? std::abs(low) : 1.0);
  return {low, high};
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

Drawing fitted(Drawing drawing, const SequenceBounds& shown) {
  render::Look& look = drawing.look;
  const bool is_signed = drawing.field->is_signed;
  // the first map of the table that suits the field
  if (!look.colormap)
    look.colormap = &*std::ranges::find(render::colormaps(), is_signed, &render::Colormap::diverging);
  if (!look.range) look.range = shown.range(is_signed);
  if (look.view) return drawing;
  look.view = drawing.followed ? shown.view_about_origin() : shown.view();
  if (look.camera) look.camera->front = shown.front();
  return drawing;
}

}  // namespace taut::cli
