#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/camera.hpp"

namespace taut::render {

/// Colour factors at corners, from the mean normal of the triangles around a corner that have a similar direction.
/// `points` in pixels: x to the right, y downwards, z towards the camera; triangles are anticlockwise from outside,
/// seen with y upwards.
std::vector<float> smooth_light(std::span<const Vector> points, std::span<const std::uint32_t> triangles);

}  // namespace taut::render
