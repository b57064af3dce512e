#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace taut::render {

/// Bits one after the other, the lowest of each byte first [RFC 1951 §3.1.1].
class BitWriter {
 public:
  explicit BitWriter(std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}
  ~BitWriter() { bytes_.resize(size_); }
  BitWriter(const BitWriter&) = delete;
  BitWriter& operator=(const BitWriter&) = delete;

  /// At most 32.
  void put(std::uint32_t bits, int count) {
    waiting_ |= std::uint64_t{bits} << count_;
    count_ += count;
    if (count_ >= 32) pass_on(4);
  }
  /// The last byte is filled with 0.
  void end() { pass_on((count_ + 7) / 8); }

 private:
  void pass_on(int bytes) {
    if (bytes_.size() < size_ + 8) bytes_.resize(2 * size_ + 4096);
    for (int k = 0; k < bytes; ++k, waiting_ >>= 8) bytes_[size_++] = static_cast<std::uint8_t>(waiting_);
    count_ = std::max(count_ - 8 * bytes, 0);
  }

  std::vector<std::uint8_t>& bytes_;  // longer than what is in them while this lives
  std::size_t size_ = bytes_.size();
  std::uint64_t waiting_ = 0;
  int count_ = 0;  // of the bits that are waiting
};

/// A code that gives frequent symbols few bits.
class HuffmanCode {
 public:
  /// `counts` of each symbol; those that are 0 have no code. No code is longer than `longest` bits.
  HuffmanCode(std::span<const std::uint32_t> counts, int longest);

  void put(BitWriter& out, std::size_t symbol) const { out.put(code_[symbol], length_[symbol]); }
  /// Bits of each symbol; they tell the code.
  std::span<const std::uint8_t> lengths() const { return length_; }

 private:
  bool find_lengths(std::span<const std::uint32_t> counts, int longest);
  void number_codes(int longest);

  std::vector<std::uint8_t> length_;
  std::vector<std::uint16_t> code_;  // its first bit is the lowest
};

}  // namespace taut::render
