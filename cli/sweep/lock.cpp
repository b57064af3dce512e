#include "cli/sweep/lock.hpp"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <thread>
#include <unistd.h>

#include "cli/text/format.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

/// A lock of the open file, not of the process: children that are still at work hold it as well.
int try_to_lock(int descriptor, const std::string& run) {
  struct flock range {};
  range.l_type = F_WRLCK;
  range.l_whence = SEEK_SET;
  if (!run.empty()) {
    range.l_start = static_cast<off_t>(hash_of(run) >> 2);  // below 2^62
    range.l_len = 1;
  }
  return ::fcntl(descriptor, F_OFD_SETLK, &range) == 0 ? 0 : errno;
}

}  // namespace

SweepLock::SweepLock(const std::filesystem::path& folder, const std::string& run) {
  using namespace std::chrono_literals;
  constexpr auto patience = 1s;  // the children of a sweep that was killed need a moment to go
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (problem) throw OutputError(folder.string(), "the folder cannot be made: " + problem.message());
  const std::string path = folder / "sweep.lock";
  descriptor_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw OutputError(path, std::string("cannot be opened: ") + std::strerror(errno));
  int error = try_to_lock(descriptor_, run);
  for (auto waited = 0ms; (error == EAGAIN || error == EACCES) && waited < patience; waited += 50ms) {
    std::this_thread::sleep_for(50ms);
    error = try_to_lock(descriptor_, run);
  }
  if (error == 0) return;
  ::close(descriptor_);
  if (error == EAGAIN || error == EACCES)
    throw UsageError("another sweep is at work in '" + folder.string() +
                     "'; wait for its end or name another folder with --out");
  throw OutputError(path, std::string("cannot be locked: ") + std::strerror(error));
}

SweepLock::~SweepLock() { ::close(descriptor_); }

}  // namespace taut::cli
