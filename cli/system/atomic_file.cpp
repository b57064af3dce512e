#include "cli/system/atomic_file.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <iterator>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

#include <fmt/core.h>

#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

[[noreturn]] void fail(const fs::path& path, int error) {
  const bool taken = error == EWOULDBLOCK;
  throw OutputError(path.string(),
                    std::string("cannot be written: ") +
                        (taken ? "another process has locked it for a minute" : std::strerror(error)));
}

/// Returns 0 or an errno.
int write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t taken = ::write(descriptor, text.data(), text.size());
    if (taken < 0 && errno == EINTR) continue;
    if (taken < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(taken));
  }
  return 0;
}

/// TAUT_FSYNC=off: files need not survive a power cut.
bool waits_for_the_disk() {
  static const char* const asked = std::getenv("TAUT_FSYNC");
  return !asked || std::string_view(asked) != "off";
}

/// Returns 0 or an errno. Ignores file systems without fsync.
int sync(int descriptor) {
  if (!waits_for_the_disk()) return 0;
  if (::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOSYS || errno == ENOTSUP) return 0;
  return errno;
}

/// Returns 0 or an errno. Ignores unreadable paths.
int sync(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return errno == EACCES ? 0 : errno;
  const int error = sync(descriptor);
  ::close(descriptor);
  return error;
}

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : "."; }

/// Locks the file until it is closed, if the file system has locks. Returns false after a minute.
bool wait_for_lock(int descriptor) {
  using namespace std::chrono_literals;
  constexpr auto longest = 60000ms, pause = 1ms;
  for (auto waited = 0ms; ::flock(descriptor, LOCK_EX | LOCK_NB) != 0; waited += pause) {
    if (errno != EWOULDBLOCK) return true;
    if (waited >= longest) return false;
    std::this_thread::sleep_for(pause);
  }
  return true;
}

bool still_named(int descriptor, const std::string& path) {
  struct stat own {
  }, named{};
  return ::fstat(descriptor, &own) == 0 && ::lstat(path.c_str(), &named) == 0 && own.st_dev == named.st_dev &&
         own.st_ino == named.st_ino;
}

int give_up(int descriptor, int error) {
  if (descriptor >= 0) ::close(descriptor);
  errno = error;
  return -1;
}

/// Creates and locks a file. Replaces a link or the file of a killed program; waits for other writers. Returns −1 and
/// sets errno on failure.
int open_new(const std::string& path) {
  constexpr int most = 1000;
  for (int k = 0; k < most; ++k) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno != EEXIST) return descriptor;
    if (descriptor >= 0) {
      const bool locked = wait_for_lock(descriptor), own = still_named(descriptor, path);
      if (locked && own) return descriptor;  // else removed by another writer
      if (!locked && own) ::unlink(path.c_str());
      if (!locked) return give_up(descriptor, EWOULDBLOCK);
      ::close(descriptor);
      continue;
    }
    const int other = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (other < 0 && errno == ENOENT) continue;  // the other writer has finished
    if (other >= 0 && !wait_for_lock(other)) return give_up(other, EWOULDBLOCK);
    const bool left_behind = other < 0 || still_named(other, path);
    if (left_behind && ::unlink(path.c_str()) != 0 && errno != ENOENT) return give_up(other, errno);
    if (other >= 0) ::close(other);
  }
  errno = EEXIST;
  return -1;
}

/// Temporary folder.
class Beside {
 public:
  Beside(const fs::path& folder, const char* what)
      : path_(fmt::format("{}.{}{}", folder.string(), what, ::getpid())) {
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

int rename_folder(const fs::path& from, const fs::path& to) {
  return std::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

/// Returns 0 or an errno.
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

/// Whether a rename would destroy a name of the system: a device, a pipe, or a link such as /dev/stdout.
bool is_special(const fs::path& path) {
  struct stat found {};
  if (::lstat(path.c_str(), &found) != 0) return false;
  if (S_ISCHR(found.st_mode) || S_ISFIFO(found.st_mode)) return true;
  std::error_code error;
  const fs::path folder = fs::canonical(folder_of(path), error);
  const auto below = [&](const char* of_system) { return !error && *std::next(folder.begin()) == of_system; };
  return S_ISLNK(found.st_mode) && folder != folder.root_path() && (below("dev") || below("proc"));
}

/// Returns 0 or an errno. Opening a pipe does not wait for a reader.
int write_through(const fs::path& path, std::string_view text) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_APPEND | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return errno;
  ::fcntl(descriptor, F_SETFL, ::fcntl(descriptor, F_GETFL) & ~O_NONBLOCK);
  const int error = write_all(descriptor, text);
  return ::close(descriptor) != 0 && error == 0 ? errno : error;
}

}  // namespace

void write_atomically(const fs::path& path, std::string_view text, Durability durability) {
  if (is_special(path)) {
    if (const int error = write_through(path, text)) fail(path, error);
    return;
  }
  const std::string temporary = path.string() + ".tmp";
  const int descriptor = open_new(temporary);
  if (descriptor < 0) fail(path, errno);
  int error = write_all(descriptor, text);
  if (error == 0 && durability == Durability::on_disk) error = sync(descriptor);
  // closing a copy reports late errors and keeps the lock
  if (const int other = ::dup(descriptor); other >= 0 && ::close(other) != 0 && error == 0) error = errno;
  if (error == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) ::unlink(temporary.c_str());
  ::close(descriptor);
  if (error == 0 && durability == Durability::on_disk) error = sync(folder_of(path));
  if (error != 0) fail(path, error);
}

FileLock::FileLock(const fs::path& path)
    : temporary_(path.string() + ".tmp"), descriptor_(open_new(temporary_)) {
  if (descriptor_ < 0) fail(path, errno);
}
FileLock::~FileLock() {
  ::unlink(temporary_.c_str());
  ::close(descriptor_);
}

void put_on_disk(const fs::path& path) {
  if (const int error = sync(path); error != 0 && error != ENOENT) fail(path, error);
}

std::vector<fs::path> make_folders(const fs::path& folder) {
  std::vector<fs::path> made;
  std::error_code error;
  fs::path inner = folder.has_filename() ? folder : folder.parent_path();
  for (; !inner.empty() && !fs::exists(inner, error); inner = inner.parent_path()) made.push_back(inner);
  // another process may remove an empty folder
  constexpr int most = 100;
  for (int k = 0; k < most; ++k)
    if (fs::create_directories(folder, error);
        error != std::errc::no_such_file_or_directory && error != std::errc::file_exists)
      break;
  if (error) throw OutputError(folder.string(), "the folder cannot be created: " + error.message());
  for (const fs::path& each : made) put_on_disk(folder_of(each));
  return made;
}

void make_folder_of(const fs::path& file) {
  const fs::path folder = fs::absolute(file).lexically_normal().parent_path();
  const fs::path first =
      folder == folder.root_path() ? folder : folder.root_path() / *folder.relative_path().begin();
  if (std::error_code error; !fs::exists(first, error))
    throw OutputError(file.string(), fmt::format("the folder {} does not exist; create it, or name another",
                                                 first.string()));
  make_folders(folder);
}

std::optional<std::string> read_whole(const fs::path& path, std::uint64_t most_bytes) {
  constexpr std::size_t at_once = 1 << 20;
  struct Descriptor {
    int number;
    ~Descriptor() {
      if (number >= 0) ::close(number);
    }
  };
  // a device has no end, and opening a pipe must not wait
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  struct stat found {};
  if (file.number < 0 || ::fstat(file.number, &found) != 0 || !S_ISREG(found.st_mode)) return std::nullopt;
  const auto refuse_beyond = [&](std::uint64_t bytes) {
    constexpr std::uint64_t mebibyte = 1 << 20;
    if (bytes > most_bytes)
      throw UsageError(fmt::format("'{}' has {} MiB; at most {} MiB are allowed", path.string(),
                                   (bytes + mebibyte - 1) / mebibyte, most_bytes / mebibyte));
  };
  refuse_beyond(static_cast<std::uint64_t>(found.st_size));
  std::string text;
  while (true) {
    const std::size_t size = text.size();
    text.resize(size +
                std::clamp<std::size_t>(static_cast<std::size_t>(found.st_size) - size + 1, 4096, at_once));
    const ssize_t count = ::read(file.number, text.data() + size, text.size() - size);
    const int error = errno;
    text.resize(size + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    refuse_beyond(text.size());
    if (count == 0) return text;
    if (count < 0 && error != EINTR)
      throw OutputError(path.string(), fmt::format("cannot be read: {}", std::strerror(error)));
  }
}

AppendFile::AppendFile(fs::path path, Start start) : path_(std::move(path)) {
  constexpr int how = O_WRONLY | O_APPEND | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
  descriptor_ = ::open(path_.c_str(), how | (start == Start::empty ? O_CREAT : 0), 0666);
  if (descriptor_ < 0 && errno == ENOENT && start == Start::as_it_is)
    throw UsageError(fmt::format(
        "'{}' is missing, and --resume does not write it again; put it back, or start again without --resume",
        path_.string()));
  if (descriptor_ < 0) fail(path_, errno);
  struct stat found {};
  const bool known = ::fstat(descriptor_, &found) == 0, regular = known && S_ISREG(found.st_mode);
  // a second name of the file would change too
  const bool allowed = regular ? found.st_nlink == 1 : known && S_ISCHR(found.st_mode);
  if (allowed && (!regular || start == Start::as_it_is || ::ftruncate(descriptor_, 0) == 0)) {
    length_ = std::max<std::int64_t>(0, ::lseek(descriptor_, 0, SEEK_END));
    return;
  }
  const int error = errno;
  ::close(descriptor_);
  if (allowed) fail(path_, error);
  throw OutputError(path_.string(),
                    "cannot be written: it is no regular file, or has a second name (hard link); "
                    "replace it with a copy");
}

void AppendFile::check_holds(std::int64_t length) const {
  if (length <= length_) return;
  throw UsageError(fmt::format("'{}' has lost lines: it has {} bytes, but the checkpoint needs {}",
                               path_.string(), length_, length));
}

void AppendFile::cut(std::int64_t length) {
  check_holds(length);
  if (length == length_) return;
  if (::ftruncate(descriptor_, length) != 0) fail(path_, errno);
  length_ = length;
}

void AppendFile::put_on_disk() const {
  if (const int error = sync(descriptor_)) fail(path_, error);
}

AppendFile::~AppendFile() { ::close(descriptor_); }

void AppendFile::append(std::string_view line) {
  const std::string text = std::string(line) + '\n';
  if (const int error = write_all(descriptor_, text)) {
    if (::ftruncate(descriptor_, length_) != 0) fail(path_, error);
    fail(path_, error);
  }
  length_ += static_cast<std::int64_t>(text.size());
}

void write_whole_folder(const fs::path& folder, const std::vector<fs::path>& files) {
  // resolves links and drops a final slash
  std::error_code no_target;
  const fs::path real = fs::weakly_canonical(folder, no_target);
  const fs::path target = ((no_target ? fs::absolute(folder) : real) / "").lexically_normal().parent_path();
  const Beside fresh(target, "tmp");
  std::error_code error;
  fs::create_directories(fresh.path(), error);
  const auto check = [&error](int problem) {
    if (!error) error.assign(problem, std::generic_category());
  };
  for (const fs::path& file : files) {
    const fs::path copy = fresh.path() / file.filename();
    if (!error) fs::copy_file(file, copy, error);
    if (!error) check(sync(copy));
  }
  if (!error) check(sync(fresh.path()));
  if (!error) check(put_in_place(fresh.path(), target));
  if (!error) check(sync(folder_of(target)));
  if (error) throw OutputError(folder.string(), "cannot be written: " + error.message());
}

}  // namespace taut::cli
