#pragma once

#include <iosfwd>
#include <memory>
#include <string>

#include "render/image/image.hpp"
#include "render/look.hpp"

namespace taut::cli {

/// The terminal on stdout as a screen for pictures: of pixels where it can show them (kitty, iTerm2, sixels),
/// else of coloured characters.
class Terminal {
 public:
  /// UsageError if `out` is no terminal.
  explicit Terminal(const std::ostream& out);
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// Gives the look the size of a picture here. Characters are too coarse for texts: it becomes bare for
  /// them.
  void suit(render::Look& look) const;
  /// What the terminal makes the picture of, with the end of its last line.
  std::string text_of(const render::Image& image) const;

 private:
  struct Screen;
  std::unique_ptr<Screen> screen_;
};

}  // namespace taut::cli
