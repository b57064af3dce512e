#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

#include <png.h>

#include "engine/error.hpp"
#include "render/image/image.hpp"

namespace taut::render {
namespace {

/// Keeps a forged header from asking for all of the memory; twice the largest size that is drawn.
constexpr png_uint_32 greatest_size = 16384;

/// libpng leaves through longjmp, so what must outlive that is kept here.
struct Source {
  png_structp png = nullptr;
  png_infop info = nullptr;
  char message[128] = {0};  // what libpng complained of
  ~Source() { png_destroy_read_struct(&png, &info, nullptr); }
};

void on_error(png_structp png, png_const_charp message) {
  auto* source = static_cast<Source*>(png_get_error_ptr(png));
  std::snprintf(source->message, sizeof source->message, "%s", message);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

bool read_header(Source& source, std::FILE* file) {
  if (setjmp(png_jmpbuf(source.png))) return false;
  png_init_io(source.png, file);
  png_set_user_limits(source.png, greatest_size, greatest_size);
  png_read_info(source.png, source.info);
  // whatever the file holds becomes B, G, R, 255
  png_set_expand(source.png);
  png_set_scale_16(source.png);
  png_set_strip_alpha(source.png);
  png_set_gray_to_rgb(source.png);
  png_set_bgr(source.png);
  png_set_filler(source.png, 255, PNG_FILLER_AFTER);
  png_set_interlace_handling(source.png);
  png_read_update_info(source.png, source.info);
  return true;
}

bool read_rows(Source& source, png_bytepp rows) {
  if (setjmp(png_jmpbuf(source.png))) return false;
  png_read_image(source.png, rows);
  png_read_end(source.png, nullptr);
  return true;
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
  throw UsageError("cannot read " + path.string() + ": " + reason);
}

}  // namespace

Image read_png(const std::filesystem::path& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) fail(path, std::strerror(errno));
  png_byte signature[8] = {};
  if (std::fread(signature, 1, sizeof signature, file.get()) != sizeof signature ||
      png_sig_cmp(signature, 0, sizeof signature) != 0) {
    fail(path, "not a PNG file");
  }

  Source source;
  source.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, on_error, on_warning);
  if (source.png) source.info = png_create_info_struct(source.png);
  if (!source.info) fail(path, "out of memory");
  png_set_sig_bytes(source.png, sizeof signature);
  if (!read_header(source, file.get())) fail(path, source.message);

  Image image(static_cast<int>(png_get_image_width(source.png, source.info)),
              static_cast<int>(png_get_image_height(source.png, source.info)));
  std::vector<png_bytep> rows(static_cast<std::size_t>(image.height));
  for (int row = 0; row < image.height; ++row) rows[row] = &image.pixels[image.offset(0, row)];
  if (!read_rows(source, rows.data())) fail(path, source.message);
  return image;
}

}  // namespace taut::render
