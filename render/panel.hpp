#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/frame_view.hpp"
#include "render/image/image.hpp"
#include "render/look.hpp"

namespace taut::render {

/// Title in bold, note in gray below.
struct Heading {
  std::string title, note;
};

/// Pictures with equal colours and scales.
struct PanelOptions {
  Look look;  // without a size, the panel is legible at 1:1
  std::string title, note;
  std::string field, unit;
  std::vector<Heading> columns;
  std::vector<std::string> rows;  // labels, such as "t = 3 ms"
  int width = 0;                  // pixels; 0: legible at 1:1
};

class Panel {
 public:
  /// The look must have a view, and a range or categories. Throws UsageError if its size is out of bounds, or too small
  /// for so many pictures.
  explicit Panel(const PanelOptions& options);
  ~Panel();

  void draw(int column, int row, const FrameView& particles);
  void write_corner(int column, int row, const std::string& text);
  void write_middle(int column, int row, const std::string& text);
  const Image& finish();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace taut::render
