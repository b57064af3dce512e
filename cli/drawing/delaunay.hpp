#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace taut::cli {

/// Triangles (in 3D tetrahedra), dim + 1 point numbers each; empty for at most `dim` points. `x`: `dim` coordinates per
/// point, in spacings. Moves its copy of them by up to 1e-4, which makes the triangles of a lattice unique. Throws
/// std::runtime_error.
std::vector<std::uint32_t> delaunay(int dim, std::span<const double> x);

}  // namespace taut::cli
