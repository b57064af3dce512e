#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/frame_view.hpp"
#include "render/image/image.hpp"
#include "render/look.hpp"

namespace taut::render {

/// Heading of a column: title in bold, note in gray below.
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
  int width = 0;                  // of the page, pixels, if the size of the look is open; 0: legible at 1:1
};

class Panel {
 public:
  /// Only the size of the look may be open. A bare look omits all texts. Throws UsageError if the size is out of
  /// bounds, or too small for so many pictures.
  explicit Panel(const PanelOptions& options);
  ~Panel();

  void draw(int column, int row, const FrameView& particles);
  /// Writes into the top left corner of a picture.
  void write_corner(int column, int row, const std::string& text);
  /// Writes into the middle of a picture without particles.
  void write_middle(int column, int row, const std::string& text);
  /// Draws the texts around the pictures.
  const Image& finish();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace taut::render
