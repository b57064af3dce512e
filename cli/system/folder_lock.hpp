#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// The lock ends with the process and its children. Warns if the file system has no locks.
class FolderLock {
 public:
  enum class Of {
    run,            // excludes all writers
    sweep,          // excludes all writers, also of parts
    part_of_sweep,  // excludes writers of the whole sweep
  };

  /// Creates a missing folder. Messages of other processes can name `command`. Throws UsageError if another process
  /// holds the lock, and OutputError.
  FolderLock(const std::filesystem::path& folder, Of of, std::string_view command, std::ostream& err);
  /// Removes created folders, if empty.
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  /// Waits at most 1 s. Returns 0 or an errno.
  int acquire();
  int try_once();
  void open();
  bool is_still_there() const;
  void write_holder(std::string_view command) const;

  Of of_;
  std::filesystem::path file_;
  std::vector<std::filesystem::path> made_;  // created, innermost first
  int descriptor_ = -1;
};

inline constexpr const char* run_lock_name = "run.lock";

}  // namespace taut::cli
