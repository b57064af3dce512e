#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// `on_disk` survives power cuts but is slow: for files that cannot be made again or mark others as complete.
enum class Kept { from_crashes, on_disk };

/// Writes a temporary file and renames it, so other processes see the old or the new file. Throws OutputError.
void write_atomically(const std::filesystem::path& path, std::string_view text,
                      Kept kept = Kept::from_crashes);

/// Locks a file that another program writes, so that other writers wait. Throws OutputError.
class WriteTurn {
 public:
  explicit WriteTurn(const std::filesystem::path& path);
  ~WriteTurn();
  WriteTurn(const WriteTurn&) = delete;
  WriteTurn& operator=(const WriteTurn&) = delete;

 private:
  std::string temporary_;
  int descriptor_;
};

/// Waits for the disk; accepts a missing path. Throws OutputError.
void put_on_disk(const std::filesystem::path& path);

/// Returns the new folders, innermost first, after they are on disk. Throws OutputError.
std::vector<std::filesystem::path> make_folders(const std::filesystem::path& folder);

/// Throws OutputError.
void make_folder_of(const std::filesystem::path& file);

/// Returns nullopt for unreadable files, folders and devices.
std::optional<std::string> read_whole(const std::filesystem::path& path);

/// A file that grows by whole lines: crashes and full disks leave no partial line.
class AppendFile {
 public:
  enum class Start { empty, as_it_is };
  explicit AppendFile(std::filesystem::path path, Start start = Start::empty);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  /// Adds a line end. Throws OutputError.
  void append(std::string_view line);
  /// Size of the complete lines, bytes.
  std::int64_t length() const { return length_; }
  /// Throws UsageError if the file is shorter.
  void check_holds(std::int64_t length) const;
  /// Keeps the first `length` bytes. Throws UsageError if the file is shorter.
  void cut(std::int64_t length);
  void put_on_disk() const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::int64_t length_ = 0;
};

/// Fills a folder with copies of `files` only. Others see the old or the new folder, also after a power cut. Throws
/// OutputError.
void write_whole_folder(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files);

}  // namespace taut::cli
