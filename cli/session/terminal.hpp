#pragma once

#include <iosfwd>
#include <memory>
#include <string>

#include "render/image/image.hpp"
#include "render/look.hpp"

namespace taut::cli {

/// Shows pictures in the terminal on stdout: as pixels if it can (kitty, iTerm2, sixels), else as coloured
/// characters.
class Terminal {
 public:
  /// Throws UsageError if `out` is no terminal.
  explicit Terminal(const std::ostream& out);
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// Sets the picture's size for this terminal. Pictures of characters become bare: they are too coarse for texts.
  void adapt(render::Look& look) const;
  /// Escape sequences or characters that show the picture, with the last line end.
  std::string text_of(const render::Image& image) const;

 private:
  struct Screen;
  std::unique_ptr<Screen> screen_;
};

}  // namespace taut::cli
