#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "render/image/image.hpp"

namespace taut::render {

/// 8 bits per channel: RGB, or RGBA if transparent.
std::vector<std::uint8_t> encode_png(const Image& image);

/// Writes the whole file or none. Throws OutputError, also for a device or a pipe.
void write_png(std::span<const std::uint8_t> bytes, const std::filesystem::path& path);
void write_png(const Image& image, const std::filesystem::path& path);

enum class Alpha : std::uint8_t { dropped, kept };

inline constexpr int greatest_side = 16384;  // pixels
inline constexpr std::int64_t most_pixels = std::int64_t{8192} * 8192;

/// Throws UsageError if the file is missing, damaged, too large or not a PNG file.
Image read_png(const std::filesystem::path& path, Alpha alpha = Alpha::dropped);

}  // namespace taut::render
