#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "render/image/image.hpp"

namespace taut::render {

/// The bytes of an RGB file of 8 bits per channel.
std::vector<std::uint8_t> encode_png(const Image& image);

/// Writes such bytes to a file. The file appears whole or not at all; OutputError if it cannot.
void write_png(std::span<const std::uint8_t> bytes, const std::filesystem::path& path);
void write_png(const Image& image, const std::filesystem::path& path);

/// Whether the fourth byte of a pixel is how opaque it is, or 255.
enum class Alpha : std::uint8_t { dropped, kept };

/// Reads any PNG of at most 8192 × 8192 pixels in all, and 16384 on a side, as RGB.
/// UsageError if it is missing, broken or not a PNG.
Image read_png(const std::filesystem::path& path, Alpha alpha = Alpha::dropped);

}  // namespace taut::render
