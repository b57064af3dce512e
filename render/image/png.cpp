#include "render/image/png.hpp"

#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <system_error>
#include <unistd.h>

#include <png.h>

#include "engine/error.hpp"

namespace taut::render {
namespace {

/// Keeps a forged header from asking for all of the memory; twice the largest size that is drawn.
constexpr png_uint_32 greatest_side = 16384;

// libpng's simplified API has no longjmp, but writes a colour space that costs bytes, takes no pixels with a
// filler, and converts what it reads to sRGB, so the classic one it is.

/// What libpng complained of. It leaves through longjmp, so this outlives the frames that are skipped.
struct Complaint {
  char message[128] = {0};
};

void on_error(png_structp png, png_const_charp message) {
  auto* complaint = static_cast<Complaint*>(png_get_error_ptr(png));
  std::snprintf(complaint->message, sizeof complaint->message, "%s", message);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

/// Calls `work`; false if libpng gave up in it. longjmp runs no destructors: nothing in `work` may need one.
template <class Work>
bool completes(png_structp png, const Work& work) {
  if (setjmp(png_jmpbuf(png))) return false;
  work();
  return true;
}

struct Writer : Complaint {
  std::FILE* file = nullptr;
  int error = 0;  // errno of the first failed write
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;

  explicit Writer(std::FILE* file_) : file(file_) {}
  ~Writer() { png_destroy_write_struct(&png, &info); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
};

void on_write(png_structp png, png_bytep data, std::size_t size) {
  auto* writer = static_cast<Writer*>(png_get_io_ptr(png));
  if (std::fwrite(data, 1, size, writer->file) == size) return;
  writer->error = errno;
  png_error(png, "write failed");
}

void on_flush(png_structp) {}

/// False if libpng or the file gave up.
bool encode(const Image& image, Writer& writer) {
  const png_structp png = writer.png;
  return writer.info && completes(png, [&] {
           png_set_write_fn(png, &writer, on_write, on_flush);
           png_set_IHDR(png, writer.info, static_cast<png_uint_32>(image.width),
                        static_cast<png_uint_32>(image.height), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                        PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
           // Flat colours: filters only cost time and bytes. 3.6 times as fast as libpng's defaults, and smaller.
           png_set_compression_level(png, 3);
           png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
           png_write_info(png, writer.info);
           png_set_bgr(png);
           png_set_filler(png, 0, PNG_FILLER_AFTER);
           for (int row = 0; row < image.height; ++row)
             png_write_row(png, &image.pixels[image.offset(0, row)]);
           png_write_end(png, writer.info);
         });
}

struct Reader : Complaint {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;

  Reader() = default;
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
};

void read_header(Reader& reader, std::FILE* file) {
  png_init_io(reader.png, file);
  png_set_user_limits(reader.png, greatest_side, greatest_side);
  png_read_info(reader.png, reader.info);
  // whatever the file holds becomes B, G, R, 255
  png_set_expand(reader.png);
  png_set_scale_16(reader.png);
  png_set_strip_alpha(reader.png);
  png_set_gray_to_rgb(reader.png);
  png_set_bgr(reader.png);
  png_set_filler(reader.png, 255, PNG_FILLER_AFTER);
  png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
}

[[noreturn]] void fail_to_write(const std::filesystem::path& path, const std::string& reason) {
  throw OutputError(path.string(), "cannot write " + path.string() + ": " + reason);
}

[[noreturn]] void fail_to_read(const std::filesystem::path& path, const std::string& reason) {
  throw UsageError("cannot read " + path.string() + ": " + reason);
}

}  // namespace

void write_png(const Image& image, const std::filesystem::path& path) {
  // In the same folder, so that the rename stays within one file system and is atomic.
  std::filesystem::path part = path;
  part += ".part" + std::to_string(getpid());

  std::FILE* const file = std::fopen(part.c_str(), "wb");
  if (!file) fail_to_write(path, std::strerror(errno));
  Writer writer(file);
  bool good = encode(image, writer);
  // a full disk may show only when the last bytes leave the buffer
  if (std::fclose(file) != 0 && good) writer.error = errno, good = false;

  std::error_code error;
  if (good) {
    std::filesystem::rename(part, path, error);
    if (!error) return;
    writer.error = error.value();
  }
  std::filesystem::remove(part, error);
  fail_to_write(path, writer.error ? std::strerror(writer.error) : writer.message);
}

Image read_png(const std::filesystem::path& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) fail_to_read(path, std::strerror(errno));
  png_byte signature[8] = {};
  if (std::fread(signature, 1, sizeof signature, file.get()) != sizeof signature ||
      png_sig_cmp(signature, 0, sizeof signature) != 0) {
    fail_to_read(path, "not a PNG file");
  }

  Reader reader;
  if (!reader.info) fail_to_read(path, "out of memory");
  png_set_sig_bytes(reader.png, sizeof signature);
  if (!completes(reader.png, [&] { read_header(reader, file.get()); })) fail_to_read(path, reader.message);

  Image image(static_cast<int>(png_get_image_width(reader.png, reader.info)),
              static_cast<int>(png_get_image_height(reader.png, reader.info)));
  std::vector<png_bytep> rows(static_cast<std::size_t>(image.height));
  for (int row = 0; row < image.height; ++row) rows[row] = &image.pixels[image.offset(0, row)];
  const auto read_rows = [&] {
    png_read_image(reader.png, rows.data());
    png_read_end(reader.png, nullptr);
  };
  if (!completes(reader.png, read_rows)) fail_to_read(path, reader.message);
  return image;
}

}  // namespace taut::render
