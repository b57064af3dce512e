#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/look.hpp"
#include "render/page/annotation.hpp"

namespace taut::render {

/// What stands for which value. Nothing of the look may be open.
class Coloring {
 public:
  explicit Coloring(const Look& look);

  std::uint32_t operator()(double value) const;  // bytes R, G, B, 255 in memory
  /// Whether it lies beyond an end by more than half a colour, or is no number.
  OffScale off_scale(double value) const;
  /// The bar or the legend.
  const ColorKey& key() const { return key_; }

 private:
  std::optional<Range> range_;  // none: values count things that have a colour each
  std::vector<std::uint32_t> colors_;
  ColorKey key_;
};

}  // namespace taut::render
