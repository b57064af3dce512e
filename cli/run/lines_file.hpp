#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/system/atomic_file.hpp"
#include "engine/diagnostics/lines.hpp"

namespace taut::cli {

/// lines.csv: a row for each point of each sample of a scene's lines, in SI units, as soon as it is taken.
/// The column `reference` is what the exact solution of the method's law says, empty where there is none.
class LineSamplesFile {
 public:
  /// Anew, or to go on with the file of a run that is to be loaded.
  LineSamplesFile(const std::filesystem::path& path, const Scene& scene, const std::string& law,
                  AppendFile::Start start = AppendFile::Start::empty);

  /// Rows for the samples that were taken since the last call.
  void add(const std::vector<std::vector<LineSample>>& samples);

  /// Loading takes back the rows that were written after this was saved.
  template <class Archive>
  void serialize(Archive& archive) {
    std::int64_t length = file_.length();
    archive(length);
    for (Known& line : lines_) archive(line.written);
    file_.cut(length);
  }

 private:
  struct Known {
    SampleLine line;
    Solution reference;  // may be empty
    std::size_t written = 0;
  };

  void add(const Known& known, const LineSample& sample);

  AppendFile file_;
  std::vector<Known> lines_;
};

}  // namespace taut::cli
