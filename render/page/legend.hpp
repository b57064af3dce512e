#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "render/page/canvas.hpp"

namespace taut::render {

/// Colours and the names of what has them, below each other.
class Legend {
 public:
  struct Entry {
    std::string name;
    Rgb color;
  };
  explicit Legend(std::vector<Entry> entries) : entries_(std::move(entries)) {}

  /// Names that are too long are shortened; for entries that find no room a line says how many they are.
  void draw(Canvas& canvas, const Rect& room, double em, std::string_view title) const;
  /// About as wide as what is written where it is `height` pixels high, em.
  double width(int height, double em) const;

 private:
  std::size_t shown(int height, double em) const;
  std::string rest(std::size_t shown) const;

  std::vector<Entry> entries_;
};

}  // namespace taut::render
