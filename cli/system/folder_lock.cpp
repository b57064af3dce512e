#include "cli/system/folder_lock.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <ostream>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

#include <fmt/core.h>

#include "cli/system/atomic_file.hpp"
#include "cli/system/provenance.hpp"
#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

struct Kind {
  const char* file;
  short lock;
  bool stays;  // the file remains
};
constexpr std::array kinds = {Kind{run_lock_name, F_WRLCK, false},  // by FolderLock::Of
                              Kind{"sweep.lock", F_WRLCK, true}, Kind{"sweep.lock", F_RDLCK, true}};

const Kind& kind(FolderLock::Of of) { return kinds[static_cast<std::size_t>(of)]; }

/// Running children hold the lock, too.
int lock(int descriptor, short type) {
  struct flock whole {};
  whole.l_type = type;
  whole.l_whence = SEEK_SET;
  return ::fcntl(descriptor, F_OFD_SETLK, &whole) == 0 ? 0 : errno;
}

bool is_taken(int error) { return error == EAGAIN || error == EACCES; }

bool knows_no_locks(int error) {
  const auto all = {ENOLCK, ENOSYS, EINVAL, ENOTSUP, ENOTTY};
  return std::ranges::find(all, error) != all.end();
}

/// Contents of a lock file, a line per member.
struct Holder {
  std::string command, process, host, since;

  /// True if only a dying child process can still hold the lock.
  bool has_ended() const {
    pid_t id = 0;
    std::from_chars(process.data(), process.data() + process.size(), id);
    return id > 0 && host == host_name() && ::kill(id, 0) != 0 && errno == ESRCH;
  }
};

Holder read_holder(int descriptor) {
  std::array<char, 1024> text{};
  const ssize_t size = ::pread(descriptor, text.data(), text.size(), 0);
  std::string_view rest(text.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  Holder holder;
  for (std::string* line : {&holder.command, &holder.process, &holder.host, &holder.since}) {
    const std::size_t end = rest.find('\n');
    *line = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  }
  return holder;
}

std::string in_use(const fs::path& folder, const Holder& holder) {
  const std::string by = holder.since.empty()
                             ? "another taut"
                             : fmt::format("`{}` (process {} on {}, since {})", holder.command,
                                           holder.process, holder.host, holder.since);
  return fmt::format("'{}' is in use by {}; wait until it ends, or name another folder", folder.string(), by);
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder, Of of, std::string_view command, std::ostream& err)
    : of_(of), file_(folder / kind(of).file) {
  const int error = acquire();
  if (error == 0) {
    write_holder(command);
  } else if (knows_no_locks(error)) {
    err << "taut: '" << folder.string() << "' is on a file system without locks; make sure that no other "
        << "taut process writes to it\n";
  } else {
    const Holder holder = read_holder(descriptor_);
    ::close(descriptor_);
    if (is_taken(error)) throw UsageError(in_use(folder, holder));
    throw OutputError(file_.string(), fmt::format("cannot be locked: {}", std::strerror(error)));
  }
}

FolderLock::~FolderLock() {
  // removed before close() unlocks it
  if (!kind(of_).stays && is_still_there()) ::unlink(file_.c_str());
  ::close(descriptor_);
  std::error_code filled;
  for (const fs::path& folder : made_)
    if (!fs::remove(folder, filled)) break;
}

/// Waits, since children of a killed program end late.
int FolderLock::acquire() {
  using namespace std::chrono_literals;
  for (auto waited = 0ms;; waited += 20ms) {
    const int error = try_once();
    if (!is_taken(error) || waited >= (read_holder(descriptor_).has_ended() ? 1000ms : 100ms)) return error;
    std::this_thread::sleep_for(20ms);
    ::close(descriptor_);
  }
}

int FolderLock::try_once() {
  while (true) {
    open();
    const int error = lock(descriptor_, kind(of_).lock);
    if (error != 0 || is_still_there()) return error;
    ::close(descriptor_);  // the former holder removed the file
  }
}

/// Refuses links and pipes: the folder may belong to another user.
void FolderLock::open() {
  const auto fail = [this](const std::string& reason) { throw OutputError(file_.string(), reason); };
  constexpr int how = O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
  constexpr int most = 100;
  descriptor_ = -1;
  for (int k = 0; k < most && descriptor_ < 0; ++k) {
    const std::vector<fs::path> made = make_folders(file_.parent_path());
    made_.insert(made_.begin(), made.begin(), made.end());
    descriptor_ = ::open(file_.c_str(), how, 0666);
    if (descriptor_ < 0 && errno != ENOENT) break;  // the former holder may have removed the folder
  }
  if (descriptor_ < 0) fail(fmt::format("cannot be opened: {}", std::strerror(errno)));
  struct stat found {};
  if (::fstat(descriptor_, &found) == 0 && S_ISREG(found.st_mode) && found.st_nlink < 2) return;
  ::close(descriptor_);
  fail("is not a lock file of taut");
}

bool FolderLock::is_still_there() const {
  struct stat ours {
  }, there{};
  return ::fstat(descriptor_, &ours) == 0 && ::lstat(file_.c_str(), &there) == 0 &&
         ours.st_ino == there.st_ino && ours.st_dev == there.st_dev;
}

/// Writers of parts share the lock, so they write no holder.
void FolderLock::write_holder(std::string_view command) const {
  std::array<char, 32> since{};
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  ::localtime_r(&now, &local);
  std::strftime(since.data(), since.size(), "%F %T", &local);
  const std::string text = fmt::format("{}\n{}\n{}\n{}\n", command, ::getpid(), host_name(), since.data());
  const bool told = ::ftruncate(descriptor_, 0) == 0 &&
                    (of_ == Of::part_of_sweep || ::pwrite(descriptor_, text.data(), text.size(), 0) > 0);
  static_cast<void>(told);  // the lock works without text
}

}  // namespace taut::cli
