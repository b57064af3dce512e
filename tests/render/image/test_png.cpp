#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>

#include <doctest/doctest.h>

#include "engine/error.hpp"
#include "render/image/png.hpp"
#include "tests/support/files.hpp"
#include "tests/support/synthetic.hpp"

using namespace taut;
using namespace taut::render;
using namespace taut::test;

namespace {

Image gradient(int width, int height) {
  Image image(width, height);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      image.set(column, row,
                {static_cast<std::uint8_t>(column), static_cast<std::uint8_t>(row),
                 static_cast<std::uint8_t>(7 * column + 13 * row)});
    }
  }
  return image;
}

Image noise(int width, int height) {
  Image image(width, height);
  std::uint32_t state = 1;
  for (std::uint8_t& byte : image.pixels)
    byte = static_cast<std::uint8_t>((state = state * 1664525u + 1013904223u) >> 24);
  return image;
}

std::uint32_t checksum(const std::string& bytes) {
  std::uint32_t crc = 0xffffffffu;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0);
  }
  return ~crc;
}

/// Simulates a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit = {bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_;
};

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a picture is read back as it was written") {
    const TemporaryFolder folder;
    for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {97, 64}, {200, 133}}) {
      const Image image = gradient(width, height);
      write_png(image, folder / "a.png");
      CHECK(read_png(folder / "a.png") == image);
    }
    CHECK(files_in(folder.path()) == 1);
  }

  TEST_CASE("noise, long rows and pictures of several blocks are read back as they were written") {
    const TemporaryFolder folder;
    const auto comes_back = [&](const Image& image) {
      write_png(image, folder / "a.png");
      const Image read = read_png(folder / "a.png");
      bool same = read.width == image.width && read.height == image.height;
      for (int row = 0; same && row < image.height; ++row)
        for (int column = 0; column < image.width; ++column)
          same = same && read.at(column, row) == image.at(column, row);
      return same;
    };
    CHECK(comes_back(Image(1, 1)));
    CHECK(comes_back(noise(300, 200)));  // several blocks
    CHECK(comes_back(noise(1, 3000)));
    CHECK(comes_back(Image(12000, 3)));  // exceeds the maximum match distance
    CHECK(comes_back(gradient(12000, 3)));
    CHECK(comes_back(Image(700, 9000)));
  }

  TEST_CASE("flat colours make small files") {
    CHECK(encode_png(Image(1280, 720)).size() < 24000);
    Image discs(1280, 720);
    for (int row = 0; row < 720; ++row)
      for (int column = 0; column < 1280; ++column)
        if (std::hypot(row % 16 - 8, column % 16 - 8) < 7) discs.set(column, row, {30, 60, 90});
    CHECK(encode_png(discs).size() < 110000);
  }

  TEST_CASE("the file is RGB of 8 bits, and the same each time") {
    const TemporaryFolder folder;
    write_png(gradient(60, 40), folder / "a.png");
    write_png(gradient(60, 40), folder / "b.png");
    const std::string bytes = text_of(folder / "a.png");
    CHECK(bytes == text_of(folder / "b.png"));
    REQUIRE(bytes.size() > 26);
    CHECK(bytes[24] == 8);
    CHECK(bytes[25] == 2);
  }

  TEST_CASE("the bytes of a picture do not depend on the pictures that were encoded before") {
    const std::vector<std::uint8_t> first = encode_png(gradient(400, 300));
    encode_png(noise(1280, 720));
    encode_png(Image(1280, 720));
    CHECK(encode_png(gradient(400, 300)) == first);
  }

  TEST_CASE("a picture replaces the file of that name") {
    const TemporaryFolder folder;
    write_png(gradient(9, 9), folder / "a.png");
    write_png(gradient(5, 4), folder / "a.png");
    CHECK(read_png(folder / "a.png") == gradient(5, 4));
  }

  TEST_CASE("a symbolic link with the name of the temporary file is not followed") {
    const TemporaryFolder folder;
    std::ofstream(folder / "mine") << "mine";
    std::filesystem::create_symlink("mine", folder / ("a.png.part" + std::to_string(::getpid())));
    write_png(gradient(5, 4), folder / "a.png");
    CHECK(text_of(folder / "mine") == "mine");
    CHECK_FALSE(std::filesystem::is_symlink(folder / "a.png"));
    CHECK(read_png(folder / "a.png") == gradient(5, 4));
    CHECK(files_in(folder.path()) == 2);
  }

  TEST_CASE("a missing folder is an error with the path of the picture") {
    const TemporaryFolder folder;
    try {
      write_png(gradient(4, 4), folder / "none/a.png");
      FAIL("nothing was thrown");
    } catch (const OutputError& error) {
      CHECK(error.path == (folder / "none/a.png").string());
      CHECK(std::string(error.what()) == "cannot be written: No such file or directory");
    }
  }

  TEST_CASE("a failed write to a name taken by a folder leaves nothing behind") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "a.png");
    CHECK_THROWS_WITH_AS(write_png(gradient(4, 4), folder / "a.png"), "cannot be written: it is a folder",
                         OutputError);
    CHECK(files_in(folder.path()) == 1);
  }

  TEST_CASE("a pipe with the name of a picture is refused, not replaced, also behind a link") {
    const TemporaryFolder folder;
    REQUIRE(::mkfifo((folder / "pipe.png").c_str(), 0600) == 0);
    std::filesystem::create_symlink("pipe.png", folder / "link.png");
    for (const char* name : {"pipe.png", "link.png"})
      CHECK_THROWS_WITH_AS(write_png(gradient(4, 4), folder / name),
                           "cannot be written: it is not a regular file", OutputError);
    CHECK(std::filesystem::is_fifo(folder / "pipe.png"));
    CHECK(std::filesystem::is_symlink(folder / "link.png"));
    CHECK(files_in(folder.path()) == 2);
  }

  TEST_CASE("a full disk leaves the old file and nothing else") {
    const TemporaryFolder folder;
    write_png(gradient(5, 4), folder / "a.png");
    // writing fails at the flush or earlier
    for (const rlim_t bytes : {rlim_t{0}, rlim_t{20000}}) {
      const FileSizeLimit limit(bytes);
      try {
        write_png(bytes ? noise(200, 200) : gradient(4, 4), folder / "a.png");
        FAIL("nothing was thrown");
      } catch (const OutputError& error) {
        CHECK(std::string(error.what()).find("File too large") != std::string::npos);
      }
    }
    CHECK(files_in(folder.path()) == 1);
    CHECK(read_png(folder / "a.png") == gradient(5, 4));
  }

  TEST_CASE("a file that is not a PNG picture is refused") {
    const TemporaryFolder folder;
    CHECK_THROWS_AS(read_png(folder / "missing.png"), UsageError);
    std::ofstream(folder / "text.png") << "this is a text, not a picture";
    CHECK_THROWS_WITH_AS(read_png(folder / "text.png"),
                         ("cannot read " + (folder / "text.png").string() + ": not a PNG file").c_str(),
                         UsageError);
    std::ofstream(folder / "empty.png").flush();
    CHECK_THROWS_AS(read_png(folder / "empty.png"), UsageError);
  }

  TEST_CASE("a picture that is cut off is refused") {
    const TemporaryFolder folder;
    write_png(noise(40, 30), folder / "a.png");
    const std::string bytes = text_of(folder / "a.png");
    for (const std::size_t size :
         {std::size_t{8}, std::size_t{20}, std::size_t{40}, bytes.size() / 2, bytes.size() - 1}) {
      CAPTURE(size);
      std::ofstream(folder / "b.png", std::ios::binary) << bytes.substr(0, size);
      CHECK_THROWS_AS(read_png(folder / "b.png"), UsageError);
    }
  }

  TEST_CASE("a header that claims a huge picture is refused") {
    const TemporaryFolder folder;
    write_png(gradient(4, 4), folder / "a.png");
    std::string bytes = text_of(folder / "a.png");
    bytes[18] = 0x4e, bytes[19] = 0x20;  // width 20000, big-endian
    const std::uint32_t sum = checksum(bytes.substr(12, 17));
    for (int i = 0; i < 4; ++i) bytes[29 + i] = static_cast<char>(sum >> (24 - 8 * i));
    std::ofstream(folder / "b.png", std::ios::binary) << bytes;
    CHECK_THROWS_WITH_AS(read_png(folder / "b.png"),
                         ("cannot read " + (folder / "b.png").string() + ": Invalid IHDR data").c_str(),
                         UsageError);
  }

  TEST_CASE("a picture with more pixels than the limit is refused before its rows are read") {
    const TemporaryFolder folder;
    write_png(gradient(4, 4), folder / "a.png");
    std::string bytes = text_of(folder / "a.png");
    bytes[18] = bytes[22] = 0x40, bytes[19] = bytes[23] = 0;
    const std::uint32_t sum = checksum(bytes.substr(12, 17));
    for (int i = 0; i < 4; ++i) bytes[29 + i] = static_cast<char>(sum >> (24 - 8 * i));
    std::ofstream(folder / "b.png", std::ios::binary) << bytes;
    CHECK_THROWS_WITH_AS(
        read_png(folder / "b.png"),
        ("cannot read " + (folder / "b.png").string() +
         ": it has 16384 x 16384 pixels; at most 67 million are allowed, such as 8192 x 8192")
            .c_str(),
        UsageError);
  }
}
