#include "render/solids.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "render/page/ticks.hpp"
#include "render/smooth_light.hpp"
#include "render/wall_grid.hpp"

namespace taut::render {
namespace {

Vector sum(const Vector& a, const Vector& b, double times = 1) {
  return {a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2]};
}

// closes the gaps of bent bodies
constexpr double overlap = 1.02, least_overlap = 0.7;  // factor; pixels

Vector widened(const Vector& half) {
  const double length = std::sqrt(dot(half, half));
  if (!(length > 0)) return half;
  return sum({}, half, std::max(overlap, 1 + 0.5 * least_overlap / length));
}

std::uint32_t dimmed(std::uint32_t color, float light) {
  auto bytes = std::bit_cast<std::array<std::uint8_t, 4>>(color);
  for (int k = 0; k < 3; ++k)
    bytes[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(
        std::lround(light * static_cast<float>(bytes[static_cast<std::size_t>(k)])));
  return std::bit_cast<std::uint32_t>(bytes);
}

Vector at(std::span<const double> of, std::size_t i) { return {of[3 * i], of[3 * i + 1], of[3 * i + 2]}; }

}  // namespace

double drawn_radius(double radius) {
  constexpr double full = 2.0;    // pixels; larger radii are kept
  constexpr double filled = 1.0;  // pixels; discs with smaller radii fill a square
  constexpr double rim = 0.25;    // half width, pixels
  const double small = std::clamp((full - radius) / (full - filled), 0.0, 1.0);
  return std::lerp(radius, std::numbers::sqrt2 * radius + rim, small);
}

// false for NaN
bool Solids::in_picture(double x, double y, double reach) const {
  return reach > 0 && x > -reach && x < layout_.plot.width + reach && y > -reach &&
         y < layout_.plot.height + reach;
}

void Solids::clear() {
  placed_.clear();
  balls_.clear();
  corners_.clear();
  surface_.clear();
}

void Solids::place_balls(const FrameView& frame, const Projection& projection,
                         std::span<const std::uint32_t> colors) {
  clear();
  for (std::size_t i = 0; i < frame.value.size(); ++i) {
    const Projection::Projected seen = projection(at(frame.x, i));
    const double x = layout_.column(seen.at[0]), y = layout_.row(seen.at[1]);
    const double size = 0.5 * glyph_ * frame.diameter[i] * seen.scale * layout_.pixels_per_metre;
    const double radius = drawn_radius(size);
    if (!(size > 0) || !in_picture(x, y, radius) || !std::isfinite(seen.at[2])) continue;
    placed_.push_back(i);
    balls_.push_back({static_cast<float>(x), static_cast<float>(y),
                      static_cast<float>(seen.at[2] * layout_.pixels_per_metre), static_cast<float>(radius),
                      colors[i]});
  }
  drop_hidden();
}

void Solids::drop_hidden() {
  constexpr std::size_t few = 2000;  // below, all are drawn
  if (balls_.size() < few) return;
  sort_roughly();
  cover_.clear();
  std::erase_if(balls_, [this](const Ball& ball) {
    if (cover_.hides(ball)) return true;
    cover_.add(ball);
    return false;
  });
}

/// Sorts balls into slices, the nearest first. Exact order would only find more hidden balls.
void Solids::sort_roughly() {
  constexpr std::size_t slices = 4096;
  const auto [far, near] = std::ranges::minmax(balls_, {}, &Ball::z);
  const float scale = static_cast<float>(slices - 1) / std::max(near.z - far.z, 1e-6f);
  const auto slice = [&, top = near.z](const Ball& ball) {
    return static_cast<std::size_t>((top - ball.z) * scale);
  };
  std::vector<std::size_t> first(slices + 1, 0);
  for (const Ball& ball : balls_) ++first[slice(ball) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<Ball> sorted(balls_.size());
  for (const Ball& ball : balls_) sorted[first[slice(ball)]++] = ball;
  balls_ = std::move(sorted);
}

void Solids::place_boxes(const FrameView& frame, const Projection& projection,
                         std::span<const std::uint32_t> colors) {
  clear();
  const double scale = layout_.pixels_per_metre, half_scale = 0.5 * scale;
  for (std::size_t i = 0; i < frame.value.size(); ++i) {
    const Projection::Projected seen = projection(at(frame.x, i));
    if (!(seen.scale > 0)) continue;
    const Vector centre{layout_.column(seen.at[0]), layout_.row(seen.at[1]), seen.at[2] * scale};
    std::array<Vector, 3> half;
    double reach = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector way = projection.project_vector(at(frame.cell, 3 * i + k), seen);
      half[k] = widened({half_scale * way[0], -half_scale * way[1], half_scale * way[2]});
      reach += std::hypot(half[k][0], half[k][1], half[k][2]);
    }
    if (!in_picture(centre[0], centre[1], reach)) continue;
    placed_.push_back(i);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector &a = half[(k + 1) % 3], &b = half[(k + 2) % 3];
      Vector normal = cross(a, b);
      const double length = std::sqrt(dot(normal, normal));
      if (!(length > 0)) continue;
      const double side = normal[2] < 0 ? -1 : 1;  // towards the camera
      for (double& component : normal) component *= side / length;
      const double towards = dot(half[k], normal) < 0 ? -1 : 1;
      add_face(sum(centre, half[k], towards), a, b,
               dimmed(colors[i], light_on(static_cast<float>(normal[0]), static_cast<float>(normal[1]),
                                          static_cast<float>(normal[2]))));
    }
  }
}

void Solids::place_surface(const FrameView& frame, const Projection* projection,
                           std::span<const float> places, std::span<const std::uint32_t> colors,
                           bool uniform) {
  clear();
  const double metre = layout_.pixels_per_metre;
  std::vector<Vector> seen(frame.value.size());  // pixels
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Projection::Projected p = projection
                                        ? (*projection)(at(frame.x, i))
                                        : Projection::Projected{{frame.x[2 * i], frame.x[2 * i + 1], 0}, 1};
    constexpr double behind = std::numeric_limits<double>::quiet_NaN();
    seen[i] = {layout_.column(p.at[0]), layout_.row(p.at[1]), p.scale > 0 ? p.at[2] * metre : behind};
    const double radius = drawn_radius(0.5 * frame.diameter[i] * p.scale * metre);
    if (!in_picture(seen[i][0], seen[i][1], std::max(radius, 1.0)) || !std::isfinite(seen[i][2])) continue;
    placed_.push_back(i);
    if (frame.diameter[i] > 0)
      balls_.push_back({static_cast<float>(seen[i][0]), static_cast<float>(seen[i][1]),
                        static_cast<float>(seen[i][2]), static_cast<float>(radius), colors[i]});
  }
  const std::vector<float> light = projection ? smooth_light(seen, frame.triangle) : std::vector<float>{};
  for (std::size_t k = 0; k < frame.triangle.size(); k += 3) {
    const auto corners = frame.triangle.subspan(k, 3);
    // OpenGL does not clip points at an infinite distance
    constexpr double farthest = 1e6;  // pixels
    if (!std::ranges::all_of(corners, [&](std::uint32_t i) {
          return std::abs(seen[i][0]) < farthest && std::abs(seen[i][1]) < farthest &&
                 std::isfinite(seen[i][2]);
        }))
      continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t i = corners[c];
      surface_.push_back({static_cast<float>(seen[i][0]), static_cast<float>(seen[i][1]),
                          static_cast<float>(seen[i][2]), places[uniform ? corners[0] : i],
                          light.empty() ? 1 : light[k + c]});
    }
  }
}

void Solids::place_walls(const FrameView& frame, const Projection& projection, std::uint32_t color) {
  if (frame.walls.empty()) return;
  constexpr double cells = 7;
  const double scale = layout_.pixels_per_metre;
  const double cell = nice_length(std::min(layout_.plot.width, layout_.plot.height) / scale / cells);
  std::vector<Vector> seen;
  for (std::size_t i = 0; i < frame.value.size(); ++i) {
    const Projection::Projected p = projection(at(frame.x, i));
    if (p.scale > 0 && in_picture(layout_.column(p.at[0]), layout_.row(p.at[1]), cell * scale))
      seen.push_back(at(frame.x, i));
  }
  for (const WallFace& wall : frame.walls)
    for (const auto& [from, to] : grid_on(wall, seen, cell)) add_line(from, to, projection, color);
}

/// In short pieces of constant width, without those behind the camera.
void Solids::add_line(const Vector& from, const Vector& to, const Projection& projection,
                      std::uint32_t color) {
  constexpr int pieces = 16;
  constexpr double half_width = 0.6;  // pixels
  const auto placed = [&](int k) {
    Vector x{};
    for (std::size_t c = 0; c < 3; ++c) x[c] = std::lerp(from[c], to[c], static_cast<double>(k) / pieces);
    return projection(x);
  };
  for (int k = 0; k < pieces; ++k) {
    const Projection::Projected a = placed(k), b = placed(k + 1);
    if (!(a.scale > 0 && b.scale > 0)) continue;
    const double scale = layout_.pixels_per_metre;
    const Vector half{0.5 * scale * (b.at[0] - a.at[0]), -0.5 * scale * (b.at[1] - a.at[1]),
                      0.5 * scale * (b.at[2] - a.at[2])};
    const Vector middle{layout_.column(0.5 * (a.at[0] + b.at[0])), layout_.row(0.5 * (a.at[1] + b.at[1])),
                        0.5 * scale * (a.at[2] + b.at[2])};
    const double length = std::hypot(half[0], half[1]);
    if (!(length > 0) || !in_picture(middle[0], middle[1], length + 1)) continue;
    add_face(middle, half, {-half[1] / length * half_width, half[0] / length * half_width, 0}, color);
  }
}

void Solids::place_parallelograms(const FrameView& frame, std::span<const std::uint32_t> colors) {
  clear();
  const double half_scale = 0.5 * layout_.pixels_per_metre;
  for (std::size_t i = 0; i < frame.value.size(); ++i) {
    const Vector centre{layout_.column(frame.x[2 * i]), layout_.row(frame.x[2 * i + 1]), 0};
    std::array<Vector, 2> half;
    double reach = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      const double* way = &frame.cell[4 * i + 2 * k];
      half[k] = widened({half_scale * way[0], -half_scale * way[1], 0});
      reach += std::hypot(half[k][0], half[k][1]);
    }
    if (!in_picture(centre[0], centre[1], reach)) continue;
    placed_.push_back(i);
    add_face(centre, half[0], half[1], colors[i]);
  }
}

void Solids::add_face(const Vector& centre, const Vector& a, const Vector& b, std::uint32_t color) {
  const auto corner = [&](double of_a, double of_b) {
    const Vector place = sum(sum(centre, a, of_a), b, of_b);
    return Corner{static_cast<float>(place[0]), static_cast<float>(place[1]), static_cast<float>(place[2]),
                  color};
  };
  const std::array<Corner, 4> around{corner(-1, -1), corner(1, -1), corner(-1, 1), corner(1, 1)};
  for (const std::size_t k : {0u, 1u, 2u, 2u, 1u, 3u}) corners_.push_back(around[k]);
}

}  // namespace taut::render
