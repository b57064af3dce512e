#pragma once

#include <string>

#include "render/image/image.hpp"

namespace taut::cli {

/// Lossy. Throws UsageError for more than 16383 pixels a side.
std::string webp(const render::Image& image);

}  // namespace taut::cli
