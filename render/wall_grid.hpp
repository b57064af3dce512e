#pragma once

#include <span>
#include <utility>
#include <vector>

#include "engine/frame_view.hpp"
#include "render/camera.hpp"

namespace taut::render {

/// Lines on the face of a wall in 3D, from end to end, m: a grid of cells of this length that stays with the
/// wall, under and about the points. None where there is no point.
std::vector<std::pair<Vector, Vector>> grid_on(const WallFace& wall, std::span<const Vector> points,
                                               double cell);

}  // namespace taut::render
