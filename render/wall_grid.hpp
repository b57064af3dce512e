#pragma once

#include <span>
#include <utility>
#include <vector>

#include "engine/frame_view.hpp"
#include "render/camera.hpp"

namespace taut::render {

/// Grid lines, `cell` (in m) apart, on the face of a 3D wall, as pairs of end points in m. The grid is fixed to the
/// wall and extends around the points.
std::vector<std::pair<Vector, Vector>> grid_on(const WallFace& wall, std::span<const Vector> points,
                                               double cell);

}  // namespace taut::render
