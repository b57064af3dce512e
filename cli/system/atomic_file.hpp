#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// What a file that has been written outlives. On disk it is there after a power cut too, at the cost of waiting
/// for the disk: for what cannot be made again, or says that other files are complete.
enum class Kept { from_crashes, on_disk };

/// Writes a file that others see either in its old or in its new state, never half: a temporary file beside
/// it, renamed when complete. Throws OutputError and leaves no temporary file.
void write_atomically(const std::filesystem::path& path, std::string_view text,
                      Kept kept = Kept::from_crashes);

/// While it lives, others who write this file wait: for a file that another program makes. Throws OutputError.
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

/// Waits until what a file holds, or what a folder lists, is on disk; not where somebody has taken it away.
/// Throws OutputError.
void put_on_disk(const std::filesystem::path& path);

/// Makes a folder and those that it is in; what was made is on disk. Gives those that were not there, the
/// innermost first. Throws OutputError.
std::vector<std::filesystem::path> make_folders(const std::filesystem::path& folder);

/// The folder that a file is to stand in. Throws OutputError.
void make_folder_of(const std::filesystem::path& file);

/// All bytes of a file; none if it cannot be opened, or is no regular file. Throws UsageError for a file of more than
/// `most_bytes`, and OutputError if the system fails to read.
constexpr std::uint64_t most_bytes_of_text = 64 << 20;
std::optional<std::string> read_whole(const std::filesystem::path& path,
                                      std::uint64_t most_bytes = most_bytes_of_text);

/// A file that grows by whole lines: each one is handed to the system at once, and a line that did not fit is
/// taken back, so that neither a crash nor a full disk leaves half a line.
class AppendFile {
 public:
  enum class Start { empty, as_it_is };
  explicit AppendFile(std::filesystem::path path, Start start = Start::empty);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  /// `line` without its end. Throws OutputError.
  void append(std::string_view line);
  /// Bytes of the lines that are complete.
  std::int64_t length() const { return length_; }
  /// UsageError if there are not as many bytes.
  void check_holds(std::int64_t length) const;
  /// Takes back what stands behind the first `length` bytes. UsageError if there are not as many.
  void cut(std::int64_t length);
  /// Waits until all lines are on disk.
  void put_on_disk() const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::int64_t length_ = 0;
};

/// Makes a folder of copies of `files`, or puts them in place of all that is in it. Others see the folder
/// either in its old or in its new state, never half, after a power cut too. Throws OutputError and leaves the
/// old state.
void write_whole_folder(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files);

}  // namespace taut::cli
