#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/frame_view.hpp"
#include "render/image/image.hpp"
#include "render/look.hpp"

namespace taut::render {

/// What stands above a column: what tells it from the others, in bold, and more of that below in gray.
struct Heading {
  std::string title, note;
};

/// A figure of many pictures in rows and columns, all with the same scales of colours and lengths.
struct PanelOptions {
  Look look;                // an open size: from the view, legible at 1:1
  std::string title, note;  // what holds for all pictures
  std::string field, unit;
  std::vector<Heading> columns;
  std::vector<std::string> rows;  // "t = 3 ms"
};

class Panel {
 public:
  /// Nothing of the look but its size may be open. A bare look leaves only the pictures, side by side.
  /// UsageError if the size is out of bounds or too small for so many pictures.
  explicit Panel(const PanelOptions& options);
  ~Panel();

  void draw(int column, int row, const FrameView& particles);
  /// In the corner of a picture.
  void write_corner(int column, int row, const std::string& text);
  /// In the middle, where there are no particles.
  void write_middle(int column, int row, const std::string& text);
  /// Draws the texts about the pictures.
  const Image& finish();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace taut::render
