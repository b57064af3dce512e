#include "render/page/font.hpp"

#include <array>
#include <string>
#include <system_error>

#include <cairo-ft.h>
#include <ft2build.h>
#include FT_FREETYPE_H

#include "engine/error.hpp"

namespace taut::render {
namespace {

// Debian, Fedora, Arch, openSUSE
constexpr std::array<std::string_view, 4> folders = {"/usr/share/fonts/truetype/dejavu",
                                                     "/usr/share/fonts/dejavu-sans-fonts",
                                                     "/usr/share/fonts/TTF", "/usr/share/fonts/truetype"};

/// Lives as long as Cairo uses the face.
struct Face {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  ~Face() {
    if (face) FT_Done_Face(face);
    if (library) FT_Done_FreeType(library);
  }
};

const cairo_user_data_key_t face_key = {};

}  // namespace

std::filesystem::path find_font(Weight weight) {
  const std::string name = weight == Weight::bold ? "DejaVuSans-Bold.ttf" : "DejaVuSans.ttf";
  for (const std::string_view folder : folders) {
    std::filesystem::path file = std::filesystem::path(folder) / name;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored)) return file;
  }
  throw OutputError(name, "the font " + name + " is missing; install the package fonts-dejavu-core");
}

Font::Font(const std::filesystem::path& file) {
  auto owner = std::make_unique<Face>();
  if (FT_Init_FreeType(&owner->library) != 0 ||
      FT_New_Face(owner->library, file.c_str(), 0, &owner->face) != 0) {
    throw OutputError(file.string(),
                      "cannot read the font " + file.string() + "; reinstall the package fonts-dejavu-core");
  }
  face_.reset(cairo_ft_font_face_create_for_ft_face(owner->face, FT_LOAD_NO_HINTING));
  const auto destroy = [](void* data) { delete static_cast<Face*>(data); };
  // if memory runs out, the face leaks, since Cairo still uses it
  cairo_font_face_set_user_data(face_.get(), &face_key, owner.release(), destroy);
}

void Font::use(cairo_t* cairo, double size) const {
  cairo_set_font_face(cairo, face_.get());
  cairo_set_font_size(cairo, size);
}

}  // namespace taut::render
