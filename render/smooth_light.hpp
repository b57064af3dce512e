#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/camera.hpp"

namespace taut::render {

/// Light at each corner of the triangles, as a factor of the colour. A corner takes the mean normal of the triangles
/// around its point that differ little in direction, so that edges stay sharp. `points` are in pixels: x to the right,
/// y downwards, z towards the camera; triangles are anticlockwise from outside, seen with y upwards.
std::vector<float> smooth_light(std::span<const Vector> points, std::span<const std::uint32_t> triangles);

}  // namespace taut::render
