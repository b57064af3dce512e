// LD_PRELOAD library. Logs writes, renames and syncs in the file that TAUT_FILE_CALLS names. TAUT_NO_LOCKS makes folder
// locks fail, TAUT_LOCKED file locks. The first folder lock creates the file that TAUT_GATE names, and waits for its
// removal.

#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fcntl.h>
#include <string>
#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace {

std::string path_of(int descriptor) {
  std::array<char, 4096> path{};
  const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
  const ssize_t size = ::readlink(link.c_str(), path.data(), path.size());
  return {path.data(), size > 0 ? static_cast<std::size_t>(size) : 0};
}

void note(const std::string& call, const std::string& path, const std::string& other = "") {
  const char* const log = std::getenv("TAUT_FILE_CALLS");
  if (!log || path.empty() || path[0] != '/') return;  // such as "pipe:[42]"
  const int file = ::open(log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  const std::string line = call + '\t' + path + '\t' + other + '\n';
  ::syscall(SYS_write, file, line.data(), line.size());
  ::close(file);
}

void pass_gate() {
  const char* const gate = std::getenv("TAUT_GATE");
  static bool passed = false;
  if (!gate || passed) return;
  passed = true;
  ::close(::open(gate, O_WRONLY | O_CREAT | O_CLOEXEC, 0600));
  while (::access(gate, F_OK) == 0) ::usleep(1000);
}

long lock(int descriptor, int command, void* argument) {
  if (command == F_OFD_SETLK) {
    pass_gate();
    if (std::getenv("TAUT_NO_LOCKS")) {
      errno = ENOLCK;
      return -1;
    }
  }
  return ::syscall(SYS_fcntl, descriptor, command, argument);
}

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* bytes, std::size_t size) {
  note("write", path_of(descriptor));
  return ::syscall(SYS_write, descriptor, bytes, size);
}

int fsync(int descriptor) {
  note("sync", path_of(descriptor));
  return static_cast<int>(::syscall(SYS_fsync, descriptor));
}

int rename(const char* from, const char* to) {
  note("rename", from, to);
  return static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

int renameat2(int, const char* from, int, const char* to, unsigned how) {
  note("rename", from, to);
  return static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, how));
}

int flock(int descriptor, int how) noexcept {
  if (!std::getenv("TAUT_LOCKED")) return static_cast<int>(::syscall(SYS_flock, descriptor, how));
  errno = EWOULDBLOCK;
  return -1;
}

int nanosleep(const timespec* time, timespec* rest) {
  return std::getenv("TAUT_LOCKED") ? 0 : static_cast<int>(::syscall(SYS_nanosleep, time, rest));
}

int fcntl(int descriptor, int command, ...) {
  va_list more;
  va_start(more, command);
  void* const argument = va_arg(more, void*);
  va_end(more);
  return static_cast<int>(lock(descriptor, command, argument));
}

int fcntl64(int descriptor, int command, ...) {
  va_list more;
  va_start(more, command);
  void* const argument = va_arg(more, void*);
  va_end(more);
  return static_cast<int>(lock(descriptor, command, argument));
}
}
