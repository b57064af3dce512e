#pragma once

#include <filesystem>
#include <string>

namespace taut::cli {

/// Keeps two programs from working at the same runs of a sweep: a lock on the file sweep.lock in its folder,
/// of one byte per run, so that single runs go on beside each other (also from several machines, where the
/// file system passes locks on). It goes with the program, however that ends.
class SweepLock {
 public:
  /// Locks one run, or all that there could ever be (`run` empty). Throws UsageError while another program
  /// has it, OutputError when there is no such folder to write into.
  SweepLock(const std::filesystem::path& folder, const std::string& run);
  ~SweepLock();
  SweepLock(const SweepLock&) = delete;
  SweepLock& operator=(const SweepLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace taut::cli
