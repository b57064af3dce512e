#pragma once

#include <iosfwd>
#include <memory>
#include <string>

#include "render/image/image.hpp"
#include "render/look.hpp"

namespace taut::cli {

/// Converts pictures to pixels (kitty, iTerm2, sixels) if possible, else to block characters.
class Terminal {
 public:
  /// Throws UsageError unless `out` is std::cout and a terminal.
  explicit Terminal(const std::ostream& out);
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// Fits pictures to the terminal. Omits texts in character output.
  void adapt(render::Look& look) const;
  std::string text_of(const render::Image& image) const;

 private:
  struct Screen;
  std::unique_ptr<Screen> screen_;
};

}  // namespace taut::cli
