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

/// The columns of history.csv of a run of the scene.
std::vector<std::string> history_columns(const Scene& scene);
/// The unit of one of them, empty for numbers without one.
std::string history_unit(const std::string& column, const Scene& scene);

/// How long a file was when it was saved how far a run had got.
struct SavedLength {
  std::int64_t length = 0;  // bytes

  /// UsageError for a file that has lost lines since.
  template <class Archive>
  void serialize(Archive& archive, const AppendFile& file) {
    if (!Archive::loads) length = file.length();
    archive(length);
    archive.check("the length of a file", [&] { return length >= 0; });
    file.check_holds(length);
  }
};

/// history.csv: a row per history time, in SI units. Each row is complete in the file as soon as it is made.
class History {
 public:
  /// Anew, or to go on with the file of a run that is to be loaded.
  History(const std::filesystem::path& path, const Scene& scene,
          AppendFile::Start start = AppendFile::Start::empty);

  /// The step that the last row shows; −1: there is none.
  long last_step() const { return last_step_; }
  /// A row for the state at hand, unless the last row shows this very step.
  void add(const Simulation& simulation, const Balance& balance, int pieces, const Readings& readings);

  template <class Archive>
  void serialize(Archive& archive) {
    saved_.serialize(archive, file_);
    archive(last_step_);
  }
  /// The rows that were written after what was loaded had been saved. Throws OutputError.
  void take_back() { file_.cut(saved_.length); }
  void put_on_disk() const { file_.put_on_disk(); }

 private:
  AppendFile file_;
  SavedLength saved_;
  int dim_;
  bool works_, damps_;  // something from outside does work, the scene is damped
  long last_step_ = -1;
};

/// lines.csv: a row for each point of each sample of a scene's lines, in SI units, as soon as it is taken.
/// The column `reference` is what the exact solution of the method's law says, empty where there is none.
class LineSamplesFile {
 public:
  /// Anew, or to go on with the file of a run that is to be loaded.
  LineSamplesFile(const std::filesystem::path& path, const Scene& scene, const std::string& law,
                  AppendFile::Start start = AppendFile::Start::empty);

  /// Rows for the samples that were taken since the last call.
  void add(const std::vector<std::vector<LineSample>>& samples);

  template <class Archive>
  void serialize(Archive& archive) {
    saved_.serialize(archive, file_);
    for (Known& line : lines_) archive(line.written);
  }
  /// The rows that were written after what was loaded had been saved. Throws OutputError.
  void take_back() { file_.cut(saved_.length); }
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
