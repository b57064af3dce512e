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
  explicit Legend(std::vector<Entry> entries) : entries_(std::move(entries)) {}

  /// Shortens long names, and counts entries that do not fit.
  void draw(Canvas& canvas, const Rect& room, double em, std::string_view title) const;
  double width(int height, double em) const;

 private:
  std::size_t shown(int height, double em) const;
  std::string rest(std::size_t shown) const;

  std::vector<Entry> entries_;
};

}  // namespace taut::render
