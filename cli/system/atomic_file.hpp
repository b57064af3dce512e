#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// `on_disk` survives power cuts but is slow: for files that cannot be made again or mark others as complete.
enum class Durability { from_crashes, on_disk };

/// Writes a temporary file and renames it, so other processes see the old or the new file, never a
/// part. Throws OutputError after it has removed the temporary file.
void write_atomically(const std::filesystem::path& path, std::string_view text,
                      Durability durability = Durability::from_crashes);

/// Locks a file that another program writes, as long as the object exists. Other writers wait. Throws OutputError.
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

/// Waits until the contents of a file, or the list of files in a folder, are on disk. Ignores a missing path.
/// Throws OutputError.
void put_on_disk(const std::filesystem::path& path);

/// Creates a folder and its missing parents on disk. Returns the new folders, innermost first. Throws OutputError.
std::vector<std::filesystem::path> make_folders(const std::filesystem::path& folder);

/// Creates the folder that will contain `file`. Throws OutputError, also if a folder of the root directory is missing:
/// a path such as /ou/picture.png is mostly a slip.
void make_folder_of(const std::filesystem::path& file);

/// Returns nullopt for files that cannot be opened, folders, devices and pipes. Throws UsageError for more than
/// `most_bytes`, and OutputError if the system fails to read.
constexpr std::uint64_t most_bytes_of_text = 64 << 20;
std::optional<std::string> read_whole(const std::filesystem::path& path,
                                      std::uint64_t most_bytes = most_bytes_of_text);

/// A file that grows by whole lines. Each line is passed to the system at once, and a line that does not fit is
/// removed: crashes and full disks leave no partial line.
class AppendFile {
 public:
  enum class Start { empty, as_it_is };
  explicit AppendFile(std::filesystem::path path, Start start = Start::empty);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  /// Appends `line` and a line end. Throws OutputError.
  void append(std::string_view line);
  /// Size of the complete lines, bytes.
  std::int64_t length() const { return length_; }
  /// Throws UsageError if the file is shorter.
  void check_holds(std::int64_t length) const;
  /// Keeps the first `length` bytes. Throws UsageError if the file is shorter.
  void cut(std::int64_t length);
  /// Waits until all lines are on disk.
  void put_on_disk() const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::int64_t length_ = 0;
};

/// Creates a folder of copies of `files`, or replaces all its contents by them. Others see the old or the new folder,
/// also after a power cut. Throws OutputError and keeps the old folder then.
void write_whole_folder(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files);

}  // namespace taut::cli
