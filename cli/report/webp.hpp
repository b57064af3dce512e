#pragma once

#include <string>

#include "render/image/image.hpp"

namespace taut::cli {

/// The bytes of a WebP file, a third of a PNG file or less, with losses that are hardly visible. Throws
/// UsageError for a picture wider or higher than 16383 pixels.
std::string webp(const render::Image& image);

}  // namespace taut::cli
