#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/scene/scene_file.hpp"
#include "cli/system/provenance.hpp"
#include "cli/system/stopwatch.hpp"
#include "cli/text/json.hpp"
#include "engine/diagnostics/conservation.hpp"
#include "engine/diagnostics/indicators.hpp"
#include "engine/judge/verdict.hpp"

namespace taut::cli {

/// Contents of run.json.
struct RunRecord {
  enum class Status { running, finished, interrupted, failed };

  std::string scene, method, material_law;
  std::string remark;                  // message about the reading of the scene, mostly empty
  std::optional<std::string> contact;  // contact law, if there are several bodies or walls
  std::string stepping;                // "dual" or "single"
  double cfl = 0;                      // factor of the time step
  std::vector<Parameter> parameters;
  int dim = 2;
  double spacing = 0;                       // m, as used
  std::optional<double> requested_spacing;  // m, if different
  Jitter jitter;
  long particles = 0;
  double mass = 0;                // kg, in 2D per metre of depth
  double until = 0, reached = 0;  // s
  Status status = Status::running;
  std::string reason;  // of a failure
  long steps = 0;
  int threads = 1;
  std::string machine;  // processor, for `seconds`
  Seconds seconds;
  Verdict verdict = Verdict::stable;
  std::map<Verdict, double> since;  // s
  BeyondLaw beyond_law;
  Excess energy_gain, turn;
  int pieces = 0;
  std::array<IndicatorRecord, indicators.size()> indicator;
  std::string patch_body;  // with the patch of the greatest hourglass error; empty: no patch, but a body
  std::vector<double> patch_place;  // its middle in the initial configuration, m
  Conservation conservation;
  std::vector<MeasureResult> measures;
  Provenance provenance;

  /// Particles × steps / solve, 1/s; none before the first step.
  std::optional<double> particle_steps_per_second() const;
};

/// Fault of a run that does not change its verdict.
struct RunWarning {
  std::string key;   // in run.json
  std::string text;  // "gains energy since t = 0.1 s: …"
  Json figures;      // in run.json
};
/// "gains energy" and "loses energy" by more than a tenth, "turns by itself".
std::vector<RunWarning> warnings(const RunRecord& record);

/// Explains an energy drift of 1 % or more; else empty.
std::string energy_note(const RunRecord& record);

/// Keys are in reading order. Unknown and non-finite values become null.
Json to_json(const RunRecord& record);

/// Contents of another run's run.json. Missing and null keys give empty members.
struct StoredRecord {
  std::string version;  // of taut; may be empty
  std::optional<RunRecord::Status> status;
  std::optional<Verdict> verdict;
  std::optional<double> reached, until;     // s
  std::optional<double> requested_spacing;  // m
  Json all;
};

/// Time that a stored run took, s; 0 if unknown. Of a continued run, the time of the last part or of all steps.
double seconds_taken(const StoredRecord& record);

/// Returns nullopt without a file. Throws UsageError, with file and key, for a record that taut cannot have written.
std::optional<StoredRecord> checked_record(const std::filesystem::path& file);
/// Same as checked_record, but returns nullopt for invalid records.
std::optional<StoredRecord> read_record(const std::filesystem::path& file);

/// Name of the processor, or "unknown".
std::string machine_name();

}  // namespace taut::cli
