#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "render/image/image.hpp"

namespace taut::render {

/// PNG file with 8 bits per channel: RGB, of a transparent picture RGBA.
std::vector<std::uint8_t> encode_png(const Image& image);

/// Writes the file completely or not at all. Throws OutputError.
void write_png(std::span<const std::uint8_t> bytes, const std::filesystem::path& path);
void write_png(const Image& image, const std::filesystem::path& path);

/// Fourth byte: opacity, or 255.
enum class Alpha : std::uint8_t { dropped, kept };

/// Reads at most 8192 × 8192 pixels in total and 16384 per side. Throws UsageError if the file is missing, damaged
/// or no PNG.
Image read_png(const std::filesystem::path& path, Alpha alpha = Alpha::dropped);

}  // namespace taut::render
