#include "cli/formats/zlib_blocks.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>
#include <zlib.h>

namespace taut::cli {
namespace {

static_assert(std::endian::native == std::endian::little, "the file header declares little-endian data");

constexpr std::size_t block_size = 1 << 16;
constexpr int level = 1;

const Bytef* input(const void* data) { return static_cast<const Bytef*>(data); }

std::string compressed(std::span<const std::byte> block) {
  uLongf size = compressBound(block.size());
  std::string text(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(text.data()), &size, input(block.data()), block.size(), level) !=
      Z_OK)
    throw std::runtime_error("zlib failed to compress");
  text.resize(size);
  return text;
}

class Numbers {
 public:
  explicit Numbers(std::string_view text) : text_(text) {}
  bool take(std::uint64_t& number) {
    if (text_.size() < sizeof number) return false;
    std::memcpy(&number, text_.data(), sizeof number);
    text_.remove_prefix(sizeof number);
    return true;
  }
  std::string_view rest() const { return text_; }

 private:
  std::string_view text_;
};

}  // namespace

std::string to_zlib_blocks(std::span<const std::byte> bytes) {
  const std::size_t count = (bytes.size() + block_size - 1) / block_size;
  std::vector<std::uint64_t> header{count, block_size, bytes.size() % block_size};
  std::string blocks;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t from = k * block_size;
    const std::string block = compressed(bytes.subspan(from, std::min(block_size, bytes.size() - from)));
    header.push_back(block.size());
    blocks += block;
  }
  return std::string(reinterpret_cast<const char*>(header.data()), header.size() * sizeof header[0]) + blocks;
}

bool from_zlib_blocks(std::string_view text, std::span<std::byte> bytes) {
  Numbers header(text);
  std::uint64_t count = 0, size = 0, last = 0;
  if (!header.take(count) || !header.take(size) || !header.take(last)) return false;
  if (count > text.size() / 8 || (count > 0 && (size == 0 || last >= size))) return false;
  std::vector<std::uint64_t> packed(count);
  for (std::uint64_t& length : packed)
    if (!header.take(length)) return false;
  std::string_view blocks = header.rest();
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint64_t length = k + 1 == count && last > 0 ? last : size;
    if (packed[k] > blocks.size() || length > bytes.size()) return false;
    uLongf unpacked = length;
    if (uncompress(reinterpret_cast<Bytef*>(bytes.data()), &unpacked, input(blocks.data()), packed[k]) !=
            Z_OK ||
        unpacked != length)
      return false;
    blocks.remove_prefix(packed[k]);
    bytes = bytes.subspan(length);
  }
  return bytes.empty();
}

}  // namespace taut::cli
