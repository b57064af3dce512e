#include "render/image/huffman.hpp"

#include <algorithm>

namespace taut::render {

HuffmanCode::HuffmanCode(std::span<const std::uint32_t> counts, int longest)
    : length_(counts.size()), code_(counts.size()) {
  // even counts make even lengths: a code that is too long is found from counts that are halved
  std::vector<std::uint32_t> evened(counts.begin(), counts.end());
  while (!find_lengths(evened, longest))
    for (std::uint32_t& count : evened) count = (count + 1) / 2;
  number_codes(longest);
}

/// The two rarest become one until one is left [Huffman 1952]; false if a code is too long.
bool HuffmanCode::find_lengths(std::span<const std::uint32_t> counts, int longest) {
  struct Node {
    std::uint32_t count;
    std::size_t parent;
  };
  std::vector<std::size_t> symbols;  // from the rarest on
  for (std::size_t s = 0; s < counts.size(); ++s)
    if (counts[s] > 0) symbols.push_back(s);
  std::ranges::stable_sort(symbols, {}, [&](std::size_t s) { return counts[s]; });
  std::ranges::fill(length_, std::uint8_t{0});
  if (symbols.size() == 1) length_[symbols[0]] = 1;
  if (symbols.size() < 2) return true;
  std::vector<Node> nodes;  // symbols, and what they become: both from the rarest on
  for (const std::size_t s : symbols) nodes.push_back({counts[s], 0});
  for (std::size_t leaf = 0, inner = symbols.size(); nodes.size() < 2 * symbols.size() - 1;) {
    const auto take_rarest = [&] {
      const bool is_leaf =
          leaf < symbols.size() && (inner == nodes.size() || nodes[leaf].count <= nodes[inner].count);
      Node& node = nodes[is_leaf ? leaf++ : inner++];
      node.parent = nodes.size();
      return node.count;
    };
    const std::uint32_t one = take_rarest(), other = take_rarest();
    nodes.push_back({one + other, 0});
  }
  std::vector<int> depth(nodes.size(), 0);  // of the last one, that is all of them, 0
  for (std::size_t k = nodes.size() - 1; k-- > 0;) depth[k] = depth[nodes[k].parent] + 1;
  for (std::size_t k = 0; k < symbols.size(); ++k) length_[symbols[k]] = static_cast<std::uint8_t>(depth[k]);
  return std::ranges::max(std::span(depth).first(symbols.size())) <= longest;
}

/// Of one length by their symbols, shorter ones first [RFC 1951 §3.2.2].
void HuffmanCode::number_codes(int longest) {
  unsigned next = 0;
  for (int length = 1; length <= longest; ++length, next <<= 1) {
    for (std::size_t s = 0; s < length_.size(); ++s) {
      if (length_[s] != length) continue;
      unsigned reversed = 0;
      for (int bit = 0; bit < length; ++bit) reversed |= (next >> bit & 1) << (length - 1 - bit);
      code_[s] = static_cast<std::uint16_t>(reversed);
      ++next;
    }
  }
}

}  // namespace taut::render
