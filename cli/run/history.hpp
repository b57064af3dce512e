#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/system/atomic_file.hpp"
#include "engine/diagnostics/balance.hpp"
#include "engine/diagnostics/indicators.hpp"
#include "engine/diagnostics/lines.hpp"
#include "engine/simulation.hpp"

namespace taut::cli {

std::vector<std::string> history_columns(const Scene& scene);
/// Empty for a plain number or an expression.
std::string history_unit(const std::string& column, const Scene& scene);

struct SavedLength {
  std::int64_t length = 0;  // bytes

  /// Throws UsageError if the file is now shorter.
  template <class Archive>
  void serialize(Archive& archive, const AppendFile& file) {
    if (!Archive::loads) length = file.length();
    archive(length);
    archive.check("the length of a file", [&] { return length >= 0; });
    file.check_holds(length);
  }
};

/// history.csv, in SI units: a row per history time and at the end.
class History {
 public:
  History(const std::filesystem::path& path, const Scene& scene,
          AppendFile::Start start = AppendFile::Start::empty);

  /// Step of the last row, or −1.
  long last_step() const { return last_step_; }
  /// Does nothing for a step that has a row.
  void add(const Simulation& simulation, const Balance& balance, int pieces, const Readings& readings);

  template <class Archive>
  void serialize(Archive& archive) {
    saved_.serialize(archive, file_);
    archive(last_step_);
  }
  /// Throws OutputError.
  void discard_newer() { file_.cut(saved_.length); }
  void put_on_disk() const { file_.put_on_disk(); }

 private:
  AppendFile file_;
  SavedLength saved_;
  int dim_;
  bool works_, damps_;  // has the column `work`, `damped`
  long last_step_ = -1;
};

/// lines.csv, in SI units: a row per point of each sample.
class LineSamplesFile {
 public:
  LineSamplesFile(const std::filesystem::path& path, const Scene& scene, const std::string& law,
                  AppendFile::Start start = AppendFile::Start::empty);

  void add(const std::vector<std::vector<LineSample>>& samples);

  template <class Archive>
  void serialize(Archive& archive) {
    saved_.serialize(archive, file_);
    for (Known& line : lines_) archive(line.written);
  }
  void discard_newer() { file_.cut(saved_.length); }
  void put_on_disk() const { file_.put_on_disk(); }

 private:
  struct Known {
    SampleLine line;
    Solution reference;  // may be empty
    std::size_t written = 0;
  };

  void add(const Known& known, const LineSample& sample);

  AppendFile file_;
  SavedLength saved_;
  std::size_t dim_;
  std::vector<Known> lines_;
};

}  // namespace taut::cli
