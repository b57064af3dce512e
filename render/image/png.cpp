#include "render/image/png.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <isa-l/crc.h>
#include <isa-l/igzip_lib.h>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include <png.h>

#include "engine/error.hpp"

namespace taut::render {
namespace {

constexpr png_alloc_size_t max_chunk_bytes = 8 << 20;  // against forged headers

// The simplified API of libpng would convert to sRGB.

/// Outlives the stack frames that longjmp skips.
struct Complaint {
  char message[128] = {0};
};

void on_error(png_structp png, png_const_charp message) {
  auto* complaint = static_cast<Complaint*>(png_get_error_ptr(png));
  std::snprintf(complaint->message, sizeof complaint->message, "%s", message);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

/// False if libpng failed. longjmp runs no destructors: `work` must not need any.
template <class Work>
bool completes(png_structp png, const Work& work) {
  if (setjmp(png_jmpbuf(png))) return false;
  work();
  return true;
}

struct Reader : Complaint {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;

  Reader() = default;
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
};

void read_header(Reader& reader, std::FILE* file, Alpha alpha) {
  png_init_io(reader.png, file);
  png_set_user_limits(reader.png, greatest_side, greatest_side);
  png_set_chunk_malloc_max(reader.png, max_chunk_bytes);
  png_read_info(reader.png, reader.info);
  // B, G, R and opacity or 255
  png_set_expand(reader.png);
  png_set_scale_16(reader.png);
  if (alpha == Alpha::dropped) png_set_strip_alpha(reader.png);
  png_set_gray_to_rgb(reader.png);
  png_set_bgr(reader.png);
  png_set_add_alpha(reader.png, 255, PNG_FILLER_AFTER);
  png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
}

void append_number(std::vector<std::uint8_t>& bytes, std::uint32_t number) {
  for (const int shift : {24, 16, 8, 0}) bytes.push_back(static_cast<std::uint8_t>(number >> shift));
}

/// [PNG §5.3].
void append_chunk(std::vector<std::uint8_t>& file, std::string_view kind,
                  std::span<const std::uint8_t> holds) {
  append_number(file, static_cast<std::uint32_t>(holds.size()));
  const std::size_t from = file.size();
  file.insert(file.end(), kind.begin(), kind.end());
  file.insert(file.end(), holds.begin(), holds.end());
  append_number(file, crc32_gzip_refl(0, &file[from], file.size() - from));
}

/// Invisible pixels are white, for readers that ignore opacity.
std::uint8_t divided(std::uint8_t channel, std::uint8_t opacity) {
  if (opacity == 0) return 255;
  return static_cast<std::uint8_t>(std::min((255 * channel + opacity / 2) / opacity, 255));
}

int channels(const Image& image) { return image.transparent ? 4 : 3; }

/// Filter type none suits flat colours.
void put_row(const Image& image, int row, std::uint8_t* to) {
  *to++ = PNG_FILTER_VALUE_NONE;
  const std::uint8_t* from = &image.pixels[image.offset(0, row)];
  if (image.transparent) {
    for (int column = 0; column < image.width; ++column, from += 4, to += 4)
      to[0] = divided(from[2], from[3]), to[1] = divided(from[1], from[3]), to[2] = divided(from[0], from[3]),
      to[3] = from[3];
    return;
  }
  for (int column = 0; column < image.width; ++column, from += 4, to += 3)
    to[0] = from[2], to[1] = from[1], to[2] = from[0];
}

/// ISA-L at level 0: in 2.30, the output of levels 1 and 2 may depend on memory addresses. A Deflater is too
/// large for the stack.
struct Deflater {
  isal_zstream stream;
  isal_hufftables code;
  std::uint8_t deflated[1 << 16];

  explicit Deflater(isal_huff_histogram& seen) {
    isal_deflate_init(&stream);
    stream.gzip_flag = IGZIP_ZLIB;
    stream.level = 0;
    if (isal_create_hufftables(&code, &seen) != 0 ||
        isal_deflate_set_hufftables(&stream, &code, IGZIP_HUFFTABLE_CUSTOM) != COMP_OK)
      throw std::logic_error("the compression code of a picture cannot be set up");
  }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  void add(std::span<std::uint8_t> bytes, bool at_end, std::vector<std::uint8_t>& out) {
    stream.next_in = bytes.data();
    stream.avail_in = static_cast<std::uint32_t>(bytes.size());
    stream.end_of_stream = at_end ? 1 : 0;
    do {
      stream.next_out = deflated;
      stream.avail_out = sizeof deflated;
      if (isal_deflate(&stream) != COMP_OK) throw std::logic_error("a picture cannot be compressed");
      out.insert(out.end(), deflated, stream.next_out);
    } while (stream.avail_out == 0);
  }
};

class Bands {
 public:
  explicit Bands(const Image& image)
      : image_(image),
        width_(static_cast<std::size_t>(channels(image)) * static_cast<std::size_t>(image.width) + 1),
        rows_(rows_at_once * width_) {}

  int count() const { return (image_.height + rows_at_once - 1) / rows_at_once; }
  /// Valid until the next call.
  std::span<std::uint8_t> operator()(int band) {
    const int first = band * rows_at_once, rows = std::min(rows_at_once, image_.height - first);
    for (int k = 0; k < rows; ++k) put_row(image_, first + k, &rows_[static_cast<std::size_t>(k) * width_]);
    return std::span(rows_).first(static_cast<std::size_t>(rows) * width_);
  }

 private:
  static constexpr int rows_at_once = 16;
  const Image& image_;
  std::size_t width_;
  std::vector<std::uint8_t> rows_;
};

std::unique_ptr<isal_huff_histogram> histogram(Bands& bands) {
  constexpr int apart = 6;
  auto seen = std::make_unique<isal_huff_histogram>();
  for (int k = std::min(apart, bands.count()) / 2; k < bands.count(); k += apart) {
    const std::span<std::uint8_t> bytes = bands(k);
    isal_update_histogram(bytes.data(), static_cast<int>(bytes.size()), seen.get());
  }
  return seen;
}

std::vector<std::uint8_t> compressed_rows(const Image& image) {
  Bands bands(image);
  const auto deflater = std::make_unique<Deflater>(*histogram(bands));
  std::vector<std::uint8_t> out;
  for (int k = 0; k < bands.count(); ++k) deflater->add(bands(k), k + 1 == bands.count(), out);
  return out;
}

[[noreturn]] void fail_to_write(const std::filesystem::path& path, const std::string& reason) {
  throw OutputError(path.string(), "cannot be written: " + reason);
}

[[noreturn]] void fail_to_read(const std::filesystem::path& path, const std::string& reason) {
  throw UsageError("cannot read " + path.string() + ": " + reason);
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Image& image) {
  std::vector<std::uint8_t> file{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  std::vector<std::uint8_t> header;
  for (const int side : {image.width, image.height}) append_number(header, static_cast<std::uint32_t>(side));
  const std::uint8_t kind = image.transparent ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB;
  header.insert(header.end(), {8, kind, 0, 0, PNG_INTERLACE_NONE});
  append_chunk(file, "IHDR", header);
  append_chunk(file, "IDAT", compressed_rows(image));
  append_chunk(file, "IEND", {});
  return file;
}

void write_png(const Image& image, const std::filesystem::path& path) { write_png(encode_png(image), path); }

void write_png(std::span<const std::uint8_t> bytes, const std::filesystem::path& path) {
  // a rename would replace a device or a pipe
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
    fail_to_write(path,
                  std::filesystem::is_directory(path, error) ? "it is a folder" : "it is not a regular file");
  // renames are atomic only within a file system
  std::filesystem::path part = path;
  part += ".part" + std::to_string(getpid());

  // another user may have made a link of this name
  ::unlink(part.c_str());
  const int descriptor = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  std::FILE* const file = descriptor < 0 ? nullptr : ::fdopen(descriptor, "wb");
  if (!file) fail_to_write(path, std::strerror(errno));
  const bool all = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  int reason = all ? 0 : errno;
  // fclose may be the first to report a full disk
  if (std::fclose(file) != 0 && all) reason = errno;

  if (reason == 0) {
    std::filesystem::rename(part, path, error);
    if (!error) return;
    reason = error.value();
  }
  std::filesystem::remove(part, error);
  fail_to_write(path, std::strerror(reason));
}

Image read_png(const std::filesystem::path& path, Alpha alpha) {
  // O_NONBLOCK: does not wait for another user's pipe
  const bool of_system = path.string().starts_with("/dev/");
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | (of_system ? 0 : O_NONBLOCK));
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
      descriptor < 0 ? nullptr : ::fdopen(descriptor, "rb"), std::fclose);
  if (!file) fail_to_read(path, std::strerror(errno));
  struct stat found {};
  if (!of_system && ::fstat(descriptor, &found) == 0 && !S_ISREG(found.st_mode))
    fail_to_read(path, S_ISDIR(found.st_mode) ? "it is a folder" : "it is not a regular file");
  png_byte signature[8] = {};
  if (std::fread(signature, 1, sizeof signature, file.get()) != sizeof signature ||
      png_sig_cmp(signature, 0, sizeof signature) != 0) {
    fail_to_read(path, "not a PNG file");
  }

  Reader reader;
  if (!reader.info) fail_to_read(path, "out of memory");
  png_set_sig_bytes(reader.png, sizeof signature);
  if (!completes(reader.png, [&] { read_header(reader, file.get(), alpha); }))
    fail_to_read(path, reader.message);

  const auto width = static_cast<int>(png_get_image_width(reader.png, reader.info)),
             height = static_cast<int>(png_get_image_height(reader.png, reader.info));
  if (std::int64_t{width} * height > most_pixels)
    fail_to_read(path, "it has " + std::to_string(width) + " x " + std::to_string(height) +
                           " pixels; at most 67 million are allowed, such as 8192 x 8192");
  Image image(width, height);
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
