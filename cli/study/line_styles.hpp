#pragma once

#include <cstddef>
#include <string>

namespace taut::cli {

/// Colour and dashes of the k-th line of a picture, for gnuplot: eight colours, then the same dashed.
std::string line_style(std::size_t k);
/// Its marker.
std::string marker_style(std::size_t k);

}  // namespace taut::cli
