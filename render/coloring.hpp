#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/look.hpp"
#include "render/page/annotation.hpp"

namespace taut::render {

class Coloring {
 public:
  explicit Coloring(const Look& look);

  std::uint32_t operator()(double value) const;  // bytes R, G, B, 255
  /// Tests for NaN, and values more than half a colour step out of range.
  OffScale off_scale(double value) const;
  const ColorKey& key() const { return key_; }

 private:
  std::optional<Range> range_;  // none: categories
  std::vector<std::uint32_t> colors_;
  ColorKey key_;
};

}  // namespace taut::render
