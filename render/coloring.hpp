#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/look.hpp"
#include "render/page/annotation.hpp"

namespace taut::render {

/// The look must have a range and a colour map, or categories.
class Coloring {
 public:
  explicit Coloring(const Look& look);

  std::uint32_t operator()(double value) const;  // bytes R, G, B, 255
  /// Place among the colours, 0 to 1 unless off-scale; `no_place` for NaN.
  float place(double value) const;
  static constexpr float no_place = -1e6f, farthest_place = 100;
  bool has_categories() const { return !range_; }
  /// The last colour is for NaN.
  std::vector<std::uint32_t> palette() const;
  /// Whether the value is NaN, or out of range by over half a colour step; never for categories.
  OffScale off_scale(double value) const;
  const ColorKey& key() const { return key_; }

 private:
  std::optional<Range> range_;  // none: categories
  std::vector<std::uint32_t> colors_;
  ColorKey key_;
};

}  // namespace taut::render
