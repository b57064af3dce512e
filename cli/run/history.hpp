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

  /// Loading takes back the rows that were written after this was saved.
  template <class Archive>
  void serialize(Archive& archive) {
    std::int64_t length = file_.length();
    archive(length, last_step_);
    file_.cut(length);
  }

 private:
  AppendFile file_;
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
  std::size_t dim_;
  std::vector<Known> lines_;
};

}  // namespace taut::cli
