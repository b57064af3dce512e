#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace taut::cli {

/// VTK's format: 8-byte integers (number of blocks, block size, size of a partial last block or 0, compressed sizes),
/// then the blocks (zlib).
std::string to_zlib_blocks(std::span<const std::byte> bytes);

/// Returns false for damaged data.
bool from_zlib_blocks(std::string_view text, std::span<std::byte> bytes);

}  // namespace taut::cli
