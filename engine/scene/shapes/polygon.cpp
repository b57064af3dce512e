#include "engine/scene/shapes/polygon.hpp"

#include <algorithm>

#include "engine/scene/contours.hpp"

namespace taut {
namespace {

double area_of(const Chain& contour) {
  double twice = 0;
  for (std::size_t k = 0; k < contour.size(); ++k)
    twice += turn(contour.front(), contour[k], contour[(k + 1) % contour.size()]);
  return 0.5 * twice;
}

double distance_to_side(const Point& x, const Point& a, const Point& b) {
  const double length2 = (b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]);
  const double along = (x[0] - a[0]) * (b[0] - a[0]) + (x[1] - a[1]) * (b[1] - a[1]);
  const double share = length2 > 0 ? std::clamp(along / length2, 0.0, 1.0) : 0;
  return distance_between(x, {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), 0}, 2);
}

/// Requires x on line ab.
bool within(const Point& x, const Point& a, const Point& b) {
  const std::size_t k = std::abs(b[0] - a[0]) > std::abs(b[1] - a[1]) ? 0 : 1;
  return (x[k] - a[k]) * (b[k] - x[k]) > 0;
}

/// Returns where two sides cross or overlap, not where they touch.
std::optional<Point> crossing(const Point& a, const Point& b, const Point& c, const Point& d) {
  const double of_c = turn(a, b, c), of_d = turn(a, b, d), of_a = turn(c, d, a), of_b = turn(c, d, b);
  if (of_c == 0 && of_d == 0) {
    for (const auto& [x, from, to] : {std::array{c, a, b}, {d, a, b}, {a, c, d}, {b, c, d}})
      if (within(x, from, to)) return x;
    if ((a == c && b == d) || (a == d && b == c)) return a;
    return {};
  }
  if (!(of_c * of_d < 0 && of_a * of_b < 0)) return {};
  const double share = of_c / (of_c - of_d);
  return Point{c[0] + share * (d[0] - c[0]), c[1] + share * (d[1] - c[1]), 0};
}

template <class Visit>
void each_side(const std::vector<Chain>& contours, const Visit& visit) {
  for (const Chain& contour : contours)
    for (std::size_t k = 0; k < contour.size(); ++k) visit(contour[k], contour[(k + 1) % contour.size()]);
}

}  // namespace

std::optional<Point> crossing(const std::vector<Chain>& contours) {
  std::vector<std::array<Point, 2>> sides;
  each_side(contours, [&](const Point& a, const Point& b) {
    sides.push_back(a[0] <= b[0] ? std::array{a, b} : std::array{b, a});
  });
  std::ranges::sort(sides, {}, [](const auto& side) { return side[0][0]; });
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const auto& [a, b] = sides[i];
    for (std::size_t j = i + 1; j < sides.size() && sides[j][0][0] <= b[0]; ++j) {
      const auto& [c, d] = sides[j];
      if (std::max(c[1], d[1]) < std::min(a[1], b[1]) || std::min(c[1], d[1]) > std::max(a[1], b[1]))
        continue;
      if (const auto found = crossing(a, b, c, d)) return found;
    }
  }
  return {};
}

Polygon::Polygon(std::vector<Chain> contours, const std::optional<Point>& centre)
    : contours_(std::move(contours)), from_(centre.value_or(Point{})), about_centre_(centre.has_value()) {
  constexpr std::size_t most_strips = 1024;
  std::size_t sides = 0;
  box_ = {contours_.front().front(), contours_.front().front()};
  each_side(contours_, [&](const Point& a, const Point&) {
    box_ = joined(box_, {a, a});
    ++sides;
  });
  strips_.resize(std::min(sides, most_strips));
  each_side(contours_, [&](const Point& a, const Point& b) {
    const std::size_t first = strip_of(std::min(a[1], b[1])), last = strip_of(std::max(a[1], b[1]));
    for (std::size_t strip = first; strip <= last; ++strip) strips_[strip].push_back({a, b});
  });
  // puts the solid on the left
  for (Chain& contour : contours_) {
    std::size_t k = 0;
    while (k + 1 < contour.size() && contour[k] == contour[k + 1]) ++k;
    const Point &a = contour[k], &b = contour[(k + 1) % contour.size()];
    const double off = 1e-6;
    const Point left{0.5 * (a[0] + b[0]) - off * (b[1] - a[1]), 0.5 * (a[1] + b[1]) + off * (b[0] - a[0]), 0};
    if (!is_inside(left)) std::ranges::reverse(contour);
    area_ += area_of(contour);
  }
}

Bounds Polygon::bounds() const {
  Bounds box = box_;
  for (std::size_t k = 0; k < 2; ++k) box.low[k] += from_[k], box.high[k] += from_[k];
  return box;
}

std::size_t Polygon::strip_of(double y) const {
  const double count = static_cast<double>(strips_.size());
  const double strip = std::floor((y - box_.low[1]) / (box_.high[1] - box_.low[1]) * count);
  return static_cast<std::size_t>(std::clamp(strip, 0.0, count - 1));
}

bool Polygon::is_inside(const Point& x) const {
  bool inside = false;
  for (const auto& [a, b] : strips_[strip_of(x[1])]) {
    if ((a[1] > x[1]) == (b[1] > x[1])) continue;
    if (x[0] < a[0] + (x[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) inside = !inside;
  }
  return inside;
}

bool Polygon::holds(const Point& at, int, double tolerance) const {
  const Point x{at[0] - from_[0], at[1] - from_[1], 0};
  const double reach = std::abs(tolerance);
  for (std::size_t k = 0; k < 2; ++k)
    if (x[k] < box_.low[k] - reach || x[k] > box_.high[k] + reach) return false;
  if (reach > 0)
    for (std::size_t strip = strip_of(x[1] - reach); strip <= strip_of(x[1] + reach); ++strip)
      for (const auto& [a, b] : strips_[strip])
        if (distance_to_side(x, a, b) <= reach) return tolerance > 0;
  return is_inside(x);
}

std::vector<Chain> Polygon::outline(int dim, double dp) const {
  if (dim != 2) return {};
  std::vector<Chain> chains;
  for (const Chain& contour : contours_) {
    chains.push_back(evenly_spaced(contour, dp));
    for (Point& x : chains.back())
      for (std::size_t k = 0; k < 2; ++k) x[k] += from_[k];
  }
  return chains;
}

}  // namespace taut
