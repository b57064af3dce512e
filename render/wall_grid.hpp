#pragma once

#include <span>
#include <utility>
#include <vector>

#include "engine/frame_view.hpp"
#include "render/camera.hpp"

namespace taut::render {

/// Grid lines on a 3D wall, m, fixed to it, with square cells around the points. None without points.
std::vector<std::pair<Vector, Vector>> grid_on(const WallFace& wall, std::span<const Vector> points,
                                               double cell);

}  // namespace taut::render
