#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// Keeps other programs out of a folder while one writes into it: a lock on a file there, whose text says who
/// has it. It goes with the program, however that ends, and holds between machines where the file system passes
/// locks on. Where there are no locks at all a warning says so.
class FolderLock {
 public:
  /// Whom it keeps out of what.
  enum class Of {
    run,            // all others of a run's folder; the file goes with the lock
    sweep,          // all others of a sweep's folder; its file stays
    part_of_sweep,  // of a sweep's folder who wants all of it, but not who wants another part
  };

  /// Makes the folder where there is none; `command` is what the others are told. Throws UsageError while
  /// another program has it, OutputError when there is no such folder to write into.
  FolderLock(const std::filesystem::path& folder, Of of, std::string_view command, std::ostream& err);
  /// Leaves no folder that it has made and nobody has filled.
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  /// 0 or the errno of the last attempt.
  int acquire();
  int try_once();
  void open();
  bool is_still_there() const;
  void say_who(std::string_view command) const;

  Of of_;
  std::filesystem::path file_;
  std::vector<std::filesystem::path> made_;  // folders, the innermost first
  int descriptor_ = -1;
};

/// Name of the file by which a run's folder is locked.
inline constexpr const char* run_lock_name = "run.lock";

}  // namespace taut::cli
