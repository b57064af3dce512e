#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/frame_view.hpp"
#include "render/image/image.hpp"
#include "render/look.hpp"

namespace taut::render {

/// Bold title, gray note below.
struct Heading {
  std::string title, note;
};

/// Pictures in rows and columns with equal colours and scales.
struct PanelOptions {
  Look look;                // an open size is chosen, legible at 1:1
  std::string title, note;  // of all pictures
  std::string field, unit;
  std::vector<Heading> columns;
  std::vector<std::string> rows;  // "t = 3 ms"
};

class Panel {
 public:
  /// Only the size may be open. A bare look omits texts. Throws UsageError for sizes out of bounds or too small.
  explicit Panel(const PanelOptions& options);
  ~Panel();

  void draw(int column, int row, const FrameView& particles);
  /// Writes at the top left.
  void write_corner(int column, int row, const std::string& text);
  /// Writes where no particles are.
  void write_middle(int column, int row, const std::string& text);
  /// Draws the surrounding texts.
  const Image& finish();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace taut::render
