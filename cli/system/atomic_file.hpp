#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// Writes a file that others see either in its old or in its new state, never half: a temporary file beside
/// it, renamed when complete. Throws OutputError and leaves no temporary file.
void write_atomically(const std::filesystem::path& path, std::string_view text);

/// All bytes of a file; none if it cannot be read.
std::optional<std::string> read_whole(const std::filesystem::path& path);

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

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::int64_t length_ = 0;
};

/// Makes a folder of copies of `files`, or puts them in place of all that is in it. Others see the folder
/// either in its old or in its new state, never half. Throws OutputError and leaves the old state.
void write_whole_folder(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files);

}  // namespace taut::cli
