#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "render/image/image.hpp"

namespace taut::render {

std::vector<std::uint8_t> encode_png(const Image& image);

/// Writes the whole file or nothing. Throws OutputError.
void write_png(std::span<const std::uint8_t> bytes, const std::filesystem::path& path);
void write_png(const Image& image, const std::filesystem::path& path);

/// Fourth byte of a pixel: 255 or opacity.
enum class Alpha : std::uint8_t { dropped, kept };

/// Reads any PNG of at most 8192 × 8192 pixels, 16384 per side, as RGB. Throws UsageError.
Image read_png(const std::filesystem::path& path, Alpha alpha = Alpha::dropped);

}  // namespace taut::render
