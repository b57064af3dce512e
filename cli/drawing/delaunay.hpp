#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace taut::cli {

/// Triangles (in 3D tetrahedra) of the Delaunay triangulation of points: dim + 1 point numbers each. `x` has `dim`
/// coordinates per point, in units of their spacing. Points are moved by up to 1e-4, which makes the triangulation of
/// lattices unique. Empty if there are at most `dim` points. Throws std::runtime_error.
std::vector<std::uint32_t> delaunay(int dim, std::span<const double> x);

}  // namespace taut::cli
