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
  if (is_last) out_.end();
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
        width_(image.width),
        stride_(3 * static_cast<std::size_t>(width_) + 1) {
    recent_.fill(none);
  }

  void add_row(int row);
  /// The row above once more, where that is not too far away.
  void repeat_row() { blocks_.copy(stride_, stride_); }
  bool can_repeat_row() const { return stride_ <= window; }

 private:
  static constexpr std::size_t recent_colors = 4096;
  static constexpr std::size_t far =
      8192;                          // bytes: a copy of one pixel from beyond costs more than its bytes
  static constexpr int enough = 16;  // pixels: nothing longer is looked for
  static constexpr std::uint32_t none = 0xffffffff;

  struct Copy {
    int pixels = 0;
    std::size_t distance = 0;
  };
  Copy recent(std::uint32_t color, int row, int column) const;
  static std::size_t slot(std::uint32_t color) { return color * 2654435761u >> 20; }

  const Image& image_;
  Blocks& blocks_;
  int width_;
  std::size_t stride_;                               // bytes
  std::array<std::uint32_t, recent_colors> recent_;  // the last place of a colour, row << 16 | column
};

/// Red in the highest byte but one.
std::uint32_t color_at(const std::uint8_t* pixel) {
  std::uint32_t color;
  std::memcpy(&color, pixel, 4);
  return color & 0xffffff;
}

/// How many pixels from `p` on are those from `q` on.
int alike(const std::uint8_t* p, const std::uint8_t* q, int most) {
  constexpr int at_once = 4;
  int count = 0;
  while (count + at_once <= most && std::memcmp(p + 4 * count, q + 4 * count, 4 * at_once) == 0)
    count += at_once;
  while (count < most && color_at(p + 4 * count) == color_at(q + 4 * count)) ++count;
  return count;
}

/// What can be copied from where this colour was seen last.
Search::Copy Search::recent(std::uint32_t color, int row, int column) const {
  const std::uint32_t place = recent_[slot(color)];
  if (place == none) return {};
  const int from_row = static_cast<int>(place >> 16), from_column = static_cast<int>(place & 0xffff);
  const auto back =
      static_cast<std::size_t>((row - from_row) * static_cast<int>(stride_) + 3 * (column - from_column));
  if (back > window) return {};
  const int pixels =
      alike(&image_.pixels[image_.offset(column, row)], &image_.pixels[image_.offset(from_column, from_row)],
            width_ - std::max(column, from_column));
  return {pixels > 1 || back < far ? pixels : 0, back};
}

void Search::add_row(int row) {
  blocks_.byte(0);  // no filter
  for (int column = 0; column < width_;) {
    const std::uint8_t* here = &image_.pixels[image_.offset(column, row)];
    const std::uint32_t color = color_at(here);
    Copy copy;
    if (column > 0 && color == color_at(here - 4)) copy = {alike(here, here - 4, width_ - column), 3};
    if (row > 0 && copy.pixels < enough && color == color_at(here - 4 * width_))
      if (const int pixels = alike(here, here - 4 * width_, width_ - column); pixels > copy.pixels)
        copy = {pixels, stride_ <= window ? stride_ : 0};
    if (copy.distance == 0) copy = recent(color, row, column);
    recent_[slot(color)] = static_cast<std::uint32_t>(row << 16 | column);
    if (copy.pixels > 0) {
      blocks_.copy(3 * static_cast<std::size_t>(copy.pixels), copy.distance);
    } else {
      for (const int shift : {16, 8, 0}) blocks_.byte(static_cast<std::uint8_t>(color >> shift));
    }
    column += std::max(copy.pixels, 1);
  }
}

}  // namespace

std::vector<std::uint8_t> deflate_pixels(const Image& image) {
  std::vector<std::uint8_t> bytes{0x78, 0x01};  // deflate with a window of 32 KiB, fast [RFC 1950 §2.2]
  const auto width = static_cast<std::size_t>(image.width);
  Checksum checksum;
  {
    Blocks blocks(bytes);
    Search search(image, blocks);
    for (int row = 0; row < image.height; ++row) {
      const std::uint8_t* pixels = &image.pixels[image.offset(0, row)];
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
  }
  for (const int shift : {24, 16, 8, 0})
    bytes.push_back(static_cast<std::uint8_t>(checksum.value() >> shift));
  return bytes;
}

}  // namespace taut::render
