#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include <cairo.h>

namespace taut::render {

enum class Weight { regular, bold };

/// Finds DejaVu Sans in the system's folders. Throws OutputError.
std::filesystem::path find_font(Weight weight);

/// Uses neither fontconfig nor hinting, so letters are equal on all machines.
class Font {
 public:
  explicit Font(const std::filesystem::path& file);

  void use(cairo_t* cairo, double size) const;

 private:
  struct Deleter {
    void operator()(cairo_font_face_t* face) const { cairo_font_face_destroy(face); }
  };
  std::unique_ptr<cairo_font_face_t, Deleter> face_;
};

}  // namespace taut::render
