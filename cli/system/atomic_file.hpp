#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// `on_disk` survives power cuts but is slow.
enum class Durability { from_crashes, on_disk };

/// Throws OutputError. Devices, pipes and links in /dev and /proc are written to, not replaced.
void write_atomically(const std::filesystem::path& path, std::string_view text,
                      Durability durability = Durability::from_crashes);

/// Other writers wait until destruction. Throws OutputError.
class FileLock {
 public:
  explicit FileLock(const std::filesystem::path& path);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  std::string temporary_;
  int descriptor_;
};

/// Waits until a file, or the list of files of a folder, is on disk. Ignores a missing path. Throws OutputError.
void put_on_disk(const std::filesystem::path& path);

/// Returns the new folders, innermost first. Throws OutputError.
std::vector<std::filesystem::path> make_folders(const std::filesystem::path& folder);

/// Throws OutputError, also for a missing top-level folder.
void make_folder_of(const std::filesystem::path& file);

constexpr std::uint64_t most_bytes_of_text = 64 << 20;
/// Returns nullopt unless `path` is a readable regular file. Throws UsageError above `most_bytes`, and OutputError.
std::optional<std::string> read_whole(const std::filesystem::path& path,
                                      std::uint64_t most_bytes = most_bytes_of_text);

/// Crashes and full disks leave no partial line.
class AppendFile {
 public:
  enum class Start { empty, as_it_is };
  /// Throws OutputError, and UsageError for a missing file with `as_it_is`.
  explicit AppendFile(std::filesystem::path path, Start start = Start::empty);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  /// Adds a line end. Throws OutputError.
  void append(std::string_view line);
  std::int64_t length() const { return length_; }
  /// Throws UsageError if the file is shorter.
  void check_holds(std::int64_t length) const;
  /// Keeps `length` bytes. Throws UsageError if the file is shorter, and OutputError.
  void cut(std::int64_t length);
  void put_on_disk() const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::int64_t length_ = 0;
};

/// Replaces a folder by copies of `files`. Atomic if the file system can exchange folders. Throws OutputError.
void write_whole_folder(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files);

}  // namespace taut::cli
