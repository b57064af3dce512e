#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace taut::cli {

/// `bytes` compressed as VTK's XML files hold an array: the number of blocks, the size of a block, the size
/// of a last block that is not full, the compressed size of each block (8 bytes each), then the blocks
/// (zlib).
std::string to_zlib_blocks(std::span<const std::byte> bytes);

/// Unpacks what stands at the beginning of `text` into `bytes`. False if it is broken or of another length.
bool from_zlib_blocks(std::string_view text, std::span<std::byte> bytes);

}  // namespace taut::cli
