#include "render/image/pixel_deflate.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "render/image/huffman.hpp"

namespace taut::render {
namespace {

constexpr std::size_t window = 32768;  // bytes that a copy may reach back
constexpr std::size_t least_copy = 3, most_copy = 258;
constexpr std::size_t end_of_block = 256;
constexpr int longest_code = 15, longest_code_of_lengths = 7;

/// A symbol, and the bits behind it that tell which of the numbers from `base` on is meant.
struct Symbol {
  std::uint16_t code, base, bits;
};

constexpr Symbol symbol_of_length(std::size_t length) {  // [RFC 1951 §3.2.5]
  if (length == most_copy) return {285, most_copy, 0};
  const unsigned rest = static_cast<unsigned>(length - least_copy);
  const int bits = rest < 8 ? 0 : std::bit_width(rest) - 3;
  const unsigned step = rest >> bits;  // 0 to 7
  return {static_cast<std::uint16_t>(257 + 4 * static_cast<unsigned>(bits) + step),
          static_cast<std::uint16_t>((step << bits) + least_copy), static_cast<std::uint16_t>(bits)};
}

constexpr Symbol symbol_of_distance(std::size_t distance) {
  const unsigned rest = static_cast<unsigned>(distance - 1);
  const int bits = rest < 4 ? 0 : std::bit_width(rest) - 2;
  const unsigned step = rest >> bits;  // 0 to 3
  return {static_cast<std::uint16_t>(2 * static_cast<unsigned>(bits) + step),
          static_cast<std::uint16_t>((step << bits) + 1), static_cast<std::uint16_t>(bits)};
}

/// Bytes, and copies of bytes before, in blocks that have a code each.
class Blocks {
 public:
  explicit Blocks(std::vector<std::uint8_t>& bytes) : out_(bytes) { tokens_.reserve(most_tokens + 16); }

  void byte(std::uint8_t value) {
    tokens_.push_back({0, value});
    ++symbols_[value];
  }
  /// Of as many bytes as one likes, at least 3.
  void copy(std::size_t length, std::size_t distance) {
    while (length > 0) {
      std::size_t part = std::min(length, most_copy);
      if (length > part && length - part < least_copy) part = length - least_copy;
      tokens_.push_back({static_cast<std::uint16_t>(distance), static_cast<std::uint16_t>(part)});
      ++symbols_[symbol_of_length(part).code];
      ++distances_[symbol_of_distance(distance).code];
      length -= part;
    }
  }
  /// To be asked now and then: a long block is written.
  void end_if_long() {
    if (tokens_.size() >= most_tokens) end(false);
  }
  void end(bool is_last);

 private:
  static constexpr std::size_t most_tokens = 1 << 16;  // so that a code suits its part of the picture
  struct Token {
    std::uint16_t distance;  // 0: it is a byte; 32768 fits
    std::uint16_t length;    // or the byte
  };
  void put_codes(const HuffmanCode& symbols, const HuffmanCode& distances);

  BitWriter out_;
  std::vector<Token> tokens_;
  std::array<std::uint32_t, 286> symbols_{};
  std::array<std::uint32_t, 30> distances_{};
};

void Blocks::end(bool is_last) {
  ++symbols_[end_of_block];
  const HuffmanCode symbols(symbols_, longest_code), distances(distances_, longest_code);
  out_.put(is_last, 1);
  put_codes(symbols, distances);
  for (const auto& [distance, length] : tokens_) {
    if (distance == 0) {
      symbols.put(out_, length);
      continue;
    }
    const Symbol of_length = symbol_of_length(length), of_distance = symbol_of_distance(distance);
    symbols.put(out_, of_length.code);
    out_.put(static_cast<std::uint32_t>(length - of_length.base), of_length.bits);
    distances.put(out_, of_distance.code);
    out_.put(static_cast<std::uint32_t>(distance - of_distance.base), of_distance.bits);
  }
  symbols.put(out_, end_of_block);
  if (is_last) out_.fill_byte();
  tokens_.clear();
  symbols_.fill(0);
  distances_.fill(0);
}

/// The lengths of all codes, in a code of their own [RFC 1951 §3.2.7]; its repetitions are not worth their while.
void Blocks::put_codes(const HuffmanCode& symbols, const HuffmanCode& distances) {
  constexpr std::array<std::size_t, 19> order = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                 11, 4,  12, 3, 13, 2, 14, 1, 15};
  std::array<std::uint32_t, 19> counts{};
  for (const HuffmanCode* code : {&symbols, &distances})
    for (const std::uint8_t length : code->lengths()) ++counts[length];
  const HuffmanCode of_lengths(counts, longest_code_of_lengths);
  out_.put(2, 2);  // codes of its own
  out_.put(286 - 257, 5), out_.put(30 - 1, 5), out_.put(19 - 4, 4);
  for (const std::size_t length : order) out_.put(of_lengths.lengths()[length], 3);
  for (const HuffmanCode* code : {&symbols, &distances})
    for (const std::uint8_t length : code->lengths()) of_lengths.put(out_, length);
}

/// Adler-32 of the rows [RFC 1950 §8.2].
class Checksum {
 public:
  /// A row of `width` pixels behind its filter byte, 0.
  void add_row(const std::uint8_t* pixels, std::size_t width) {
    sum_ = 0, weighted_ = 0;
    constexpr std::size_t at_once = 512;  // pixels whose weighted sum fits into 32 bits
    for (std::size_t from = 0; from < width; from += at_once) {
      const std::size_t count = std::min(at_once, width - from);
      add(pixels + 4 * from, static_cast<std::uint32_t>(count), 3 * (width - from - count));
    }
    repeat_row(width);
  }
  /// The row that came last once more.
  void repeat_row(std::size_t width) {
    b_ = (b_ + (3 * width + 1) * a_ + weighted_) % modulus;
    a_ = (a_ + sum_) % modulus;
  }
  std::uint32_t value() const { return static_cast<std::uint32_t>(b_ << 16 | a_); }

 private:
  static constexpr std::uint64_t modulus = 65521;
  void add(const std::uint8_t* pixels, std::uint32_t count, std::uint64_t bytes_behind) {
    std::uint32_t sum = 0, weighted = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t blue = pixels[4 * k], green = pixels[4 * k + 1], red = pixels[4 * k + 2];
      sum += red + green + blue;
      weighted += 3 * (count - k) * (red + green + blue) - green - 2 * blue;
    }
    sum_ += sum;
    weighted_ += weighted + bytes_behind * sum;
  }

  std::uint64_t a_ = 1, b_ = 0;
  std::uint64_t sum_ = 0, weighted_ = 0;  // of a row: of its bytes, and of each times those from it on
};

/// Goes through the rows.
class Search {
 public:
  Search(const Image& image, Blocks& blocks)
      : image_(image),
        blocks_(blocks),
        width_(static_cast<std::size_t>(image.width)),
        stride_(3 * width_ + 1) {}

  void add_row(std::size_t row);
  /// The row above once more, where that is not too far away.
  void repeat_row() { blocks_.copy(stride_, stride_); }
  bool can_repeat_row() const { return stride_ <= window; }

 private:
  static constexpr std::size_t recent_colors = 4096;
  static constexpr std::size_t far =
      8192;  // bytes: a copy of one pixel from beyond costs more than its bytes

  std::uint32_t pixel(std::size_t at) const {
    std::uint32_t color = 0;
    std::memcpy(&color, &image_.pixels[4 * at], 3);
    return color;
  }
  std::size_t byte_of(std::size_t at) const { return at / width_ * stride_ + 1 + at % width_ * 3; }
  std::size_t alike(std::size_t a, std::size_t b, std::size_t most) const;
  std::uint32_t& recent(std::uint32_t color) { return recent_[color * 2654435761u >> 20]; }

  const Image& image_;
  Blocks& blocks_;
  std::size_t width_, stride_;                         // pixels, bytes
  std::array<std::uint32_t, recent_colors> recent_{};  // the last pixel of a colour, + 1; 0: none
};

/// How many pixels from `a` on are those from `b` on.
std::size_t Search::alike(std::size_t a, std::size_t b, std::size_t most) const {
  constexpr std::size_t at_once = 4;
  const std::uint8_t *p = &image_.pixels[4 * a], *q = &image_.pixels[4 * b];
  std::size_t count = 0;
  while (count + at_once <= most && std::memcmp(p + 4 * count, q + 4 * count, 4 * at_once) == 0)
    count += at_once;
  while (count < most && std::memcmp(p + 4 * count, q + 4 * count, 3) == 0) ++count;
  return count;
}

void Search::add_row(std::size_t row) {
  blocks_.byte(0);  // no filter
  const std::size_t end = (row + 1) * width_;
  for (std::size_t at = row * width_; at < end;) {
    const std::size_t left = end - at;
    std::size_t length = 0, distance = 0;
    const auto try_from = [&](std::size_t from, std::size_t most) {
      const std::size_t count = alike(at, from, most), back = byte_of(at) - byte_of(from);
      if (count > length && back <= window && (count > 1 || back < far)) length = count, distance = back;
    };
    if (at > row * width_) try_from(at - 1, left);
    if (row > 0) try_from(at - width_, left);
    const std::uint32_t color = pixel(at), last = recent(color);
    if (length == 0 && last > 0) try_from(last - 1, std::min(left, width_ - (last - 1) % width_));
    recent(color) = static_cast<std::uint32_t>(at + 1);
    if (length > 0) {
      blocks_.copy(3 * length, distance);
      at += length;
    } else {
      for (const int shift : {16, 8, 0}) blocks_.byte(static_cast<std::uint8_t>(color >> shift));
      ++at;
    }
  }
}

}  // namespace

std::vector<std::uint8_t> deflate_pixels(const Image& image) {
  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  std::vector<std::uint8_t> bytes{0x78, 0x01};  // deflate with a window of 32 KiB, fast [RFC 1950 §2.2]
  Blocks blocks(bytes);
  Search search(image, blocks);
  Checksum checksum;
  for (std::size_t row = 0; row < height; ++row) {
    const std::uint8_t* pixels = &image.pixels[4 * row * width];
    if (row > 0 && search.can_repeat_row() && std::memcmp(pixels, pixels - 4 * width, 4 * width) == 0) {
      search.repeat_row();
      checksum.repeat_row(width);
    } else {
      search.add_row(row);
      checksum.add_row(pixels, width);
    }
    blocks.end_if_long();
  }
  blocks.end(true);
  for (const int shift : {24, 16, 8, 0})
    bytes.push_back(static_cast<std::uint8_t>(checksum.value() >> shift));
  return bytes;
}

}  // namespace taut::render
