#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include <cairo.h>

namespace taut::render {

enum class Weight { regular, bold };

/// The file of DejaVu Sans, from the folders where systems keep it. OutputError naming the package if it is
/// missing.
std::filesystem::path find_font(Weight weight);

/// A font for Cairo, straight from its file: no fontconfig, no hinting, so letters are the same on every
/// machine.
class Font {
 public:
  explicit Font(const std::filesystem::path& file);

  /// Makes it the current font; size in pixels.
  void use(cairo_t* cairo, double size) const;

 private:
  struct Deleter {
    void operator()(cairo_font_face_t* face) const { cairo_font_face_destroy(face); }
  };
  std::unique_ptr<cairo_font_face_t, Deleter> face_;
};

}  // namespace taut::render
