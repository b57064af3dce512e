#include "cli/system/atomic_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>

#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

[[noreturn]] void fail(const fs::path& path, int error) {
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

/// A folder beside the one to be written, on the same file system; gone when done, with whatever is in it.
class Beside {
 public:
  Beside(const fs::path& folder, const char* what)
      : path_(folder.string() + "." + what + std::to_string(::getpid())) {
    remove();
  }
  ~Beside() { remove(); }
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;
  const fs::path& path() const { return path_; }

 private:
  void remove() const {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  fs::path path_;
};

/// 0 or an errno.
int rename_folder(const fs::path& from, const fs::path& to) {
  return std::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

/// 0 or an errno. In one step where the file system can; else `folder` is missing for a moment.
int put_in_place(const fs::path& fresh, const fs::path& folder) {
  if (!fs::exists(folder)) return rename_folder(fresh, folder);
  if (::renameat2(AT_FDCWD, fresh.c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS) return errno;
  const Beside old(folder, "old");
  if (const int error = rename_folder(folder, old.path())) return error;
  const int error = rename_folder(fresh, folder);
  if (error != 0) rename_folder(old.path(), folder);
  return error;
}

}  // namespace

void write_atomically(const fs::path& path, std::string_view text) {
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

std::optional<std::string> read_whole(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

AppendFile::AppendFile(fs::path path, Start start) : path_(std::move(path)) {
  const int how = start == Start::empty ? O_TRUNC : O_APPEND;
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | how, 0666);
  if (descriptor_ < 0) fail(path_, errno);
  length_ = std::max<std::int64_t>(0, ::lseek(descriptor_, 0, SEEK_END));
}

void AppendFile::check_holds(std::int64_t length) const {
  if (length <= length_) return;
  throw UsageError("'" + path_.string() + "' has lost lines: " + std::to_string(length_) +
                   " bytes, there were " + std::to_string(length));
}

void AppendFile::cut(std::int64_t length) {
  check_holds(length);
  if (length == length_) return;
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

void write_whole_folder(const fs::path& folder, const std::vector<fs::path>& files) {
  // "a/b/" and "a/b" are the same folder, but not with something behind
  const fs::path target = (fs::absolute(folder) / "").lexically_normal().parent_path();
  const Beside fresh(target, "tmp");
  std::error_code error;
  fs::create_directories(fresh.path(), error);
  for (const fs::path& file : files)
    if (!error) fs::copy_file(file, fresh.path() / file.filename(), error);
  if (!error) error.assign(put_in_place(fresh.path(), target), std::generic_category());
  if (error) throw OutputError(folder.string(), "cannot be written: " + error.message());
}

}  // namespace taut::cli
