#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "render/image/image.hpp"

namespace taut::render {

/// RGB with 8 bits per channel.
std::vector<std::uint8_t> encode_png(const Image& image);

/// Writes the file completely or not at all. OutputError on failure.
void write_png(std::span<const std::uint8_t> bytes, const std::filesystem::path& path);
void write_png(const Image& image, const std::filesystem::path& path);

/// Whether the fourth byte is the opacity or 255.
enum class Alpha : std::uint8_t { dropped, kept };

/// Reads any PNG of at most 8192 × 8192 pixels, and 16384 per side, as RGB. UsageError if it is missing or damaged.
Image read_png(const std::filesystem::path& path, Alpha alpha = Alpha::dropped);

}  // namespace taut::render
