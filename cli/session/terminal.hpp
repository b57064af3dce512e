#pragma once

#include <iosfwd>
#include <memory>
#include <string>

#include "render/image/image.hpp"
#include "render/look.hpp"

namespace taut::cli {

/// Shows pixels (kitty, iTerm2, sixels) or coloured characters.
class Terminal {
 public:
  /// Throws UsageError without a terminal.
  explicit Terminal(const std::ostream& out);
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// Sets the size. Pictures of characters become bare.
  void suit(render::Look& look) const;
  std::string text_of(const render::Image& image) const;

 private:
  struct Screen;
  std::unique_ptr<Screen> screen_;
};

}  // namespace taut::cli
