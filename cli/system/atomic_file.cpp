#include "cli/system/atomic_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>

#include "engine/error.hpp"

namespace taut::cli {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw OutputError(path.string(), std::string("cannot be written: ") + std::strerror(error));
}

/// 0 or the errno of the failure; write(2) may take less than it was given.
int write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t taken = ::write(descriptor, text.data(), text.size());
    if (taken < 0 && errno == EINTR) continue;
    if (taken < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(taken));
  }
  return 0;
}

}  // namespace

void write_atomically(const std::filesystem::path& path, std::string_view text) {
  const std::string temporary = path.string() + ".tmp";
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) fail(path, errno);
  int error = write_all(descriptor, text);
  if (::close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error == 0) return;
  ::unlink(temporary.c_str());
  fail(path, error);
}

std::optional<std::string> read_whole(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

AppendFile::AppendFile(std::filesystem::path path, Start start) : path_(std::move(path)) {
  const int how = start == Start::empty ? O_TRUNC : O_APPEND;
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | how, 0666);
  if (descriptor_ < 0) fail(path_, errno);
  length_ = std::max<std::int64_t>(0, ::lseek(descriptor_, 0, SEEK_END));
}

void AppendFile::cut(std::int64_t length) {
  if (length == length_) return;
  if (length > length_)
    throw UsageError("'" + path_.string() + "' has lost lines: " + std::to_string(length_) +
                     " bytes, there were " + std::to_string(length));
  if (::ftruncate(descriptor_, length) != 0) fail(path_, errno);
  length_ = length;
}

AppendFile::~AppendFile() { ::close(descriptor_); }

void AppendFile::append(std::string_view line) {
  const std::string text = std::string(line) + '\n';
  if (const int error = write_all(descriptor_, text)) {
    // best effort: what is left of the line goes, the error is reported in any case
    if (::ftruncate(descriptor_, length_) != 0) fail(path_, error);
    fail(path_, error);
  }
  length_ += static_cast<std::int64_t>(text.size());
}

}  // namespace taut::cli
