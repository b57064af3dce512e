#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "engine/frame_view.hpp"
#include "render/image/image.hpp"
#include "render/look.hpp"

namespace taut::render {

struct Heading {
  std::string title, note;
};

/// Pictures with equal colours and scales.
struct PanelBlock {
  Look look;
  std::string field, unit;
};

struct PanelOptions : PanelBlock {
  std::vector<PanelBlock>
      beside{};  // the same columns with other looks, whose size, texts and background are ignored
  std::string title, note;
  std::vector<Heading> columns;   // of each block
  std::vector<std::string> rows;  // labels
  int width = 0;                  // of a panel without a size, pixels; 0: legible at 1:1
};

class Panel {
 public:
  /// The looks must be complete except for the size. Throws UsageError if the panel is too large, or too small for its
  /// pictures. Consecutive blocks with equal colours share a bar or legend.
  explicit Panel(const PanelOptions& options);
  ~Panel();

  /// `column` counts over all blocks.
  void draw(int column, int row, const FrameView& particles);
  void write_corner(int column, int row, const std::string& text);
  void write_middle(int column, int row, const std::string& text);
  const Image& finish();
  /// Texts of the finished panel that lack room.
  std::set<std::string> cut_texts() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace taut::render
