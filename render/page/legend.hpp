#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "render/page/canvas.hpp"

namespace taut::render {

class Legend {
 public:
  struct Entry {
    std::string name;
    Rgb color;
  };
  /// `across`: entries from left to right.
  explicit Legend(std::vector<Entry> entries, bool across = false)
      : entries_(std::move(entries)), across_(across) {}

  /// Shortens long names, and counts entries that do not fit.
  void draw(Canvas& canvas, const Rect& room, double em, std::string_view title) const;
  double width(int height, double em) const;

 private:
  std::size_t shown(int height, double em) const;
  std::string rest(std::size_t shown) const;
  void draw_upright(Canvas& canvas, const Rect& room, double em) const;
  void draw_across(Canvas& canvas, const Rect& room, double em) const;

  std::vector<Entry> entries_;
  bool across_;
};

}  // namespace taut::render
