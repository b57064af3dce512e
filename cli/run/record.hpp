#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/system/build_info.hpp"
#include "cli/system/provenance.hpp"
#include "cli/system/stopwatch.hpp"
#include "cli/text/json_cursor.hpp"
#include "engine/diagnostics/conservation.hpp"
#include "engine/diagnostics/indicators.hpp"
#include "engine/diagnostics/measures.hpp"
#include "engine/judge/verdict.hpp"

namespace taut::cli {

/// Contents of run.json.
struct RunRecord {
  enum class Status { running, finished, interrupted, failed };

  std::string version{build_info.version};  // of taut
  std::string scene, method, material_law;
  std::string remark;                  // message about the reading of the scene, mostly empty
  std::optional<std::string> contact;  // contact law, if there are several bodies or walls
  std::string stepping;                // "dual" or "single"
  double cfl = 0;                      // factor of the time step
  std::vector<std::pair<std::string, double>> parameters;
  int dim = 2;
  double spacing = 0;                       // m, as used
  std::optional<double> requested_spacing;  // m, if different
  Jitter jitter;
  long particles = 0;
  double mass = 0;                // kg, in 2D per metre of depth
  double until = 0, reached = 0;  // s
  std::optional<Status> status = Status::running;
  std::string reason;  // of a failure
  long steps = 0;
  int threads = 1;
  std::string machine;  // processor, for `seconds`
  Seconds seconds;
  std::optional<Verdict> verdict = Verdict::stable;
  std::map<Verdict, double> since;  // s
  BeyondLaw beyond_law;
  Excess energy_gain, turn;
  int pieces = 0;
  std::array<IndicatorRecord, indicators.size()> indicator;
  std::string patch_body;  // body of the patch with the greatest hourglass error; empty: a body is worse
  std::vector<double> patch_place;  // its middle in the initial configuration, m
  Conservation conservation;
  std::vector<MeasureResult> measures;
  std::optional<double> other_load;  // cores that others used during the run; see Provenance
  Provenance provenance;

  /// Returns nullptr for other names.
  const MeasureResult* find_measure(std::string_view name) const;
  /// Returns an empty measure for other names.
  const MeasureResult& measure(std::string_view name) const;
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

/// A key of run.json, results.json and results.csv.
struct RecordField {
  enum class Place {
    everywhere,
    everywhere_if_known,  // omitted if null or empty
    last_in_results,      // varies between repetitions
    results,              // last in results, omitted if null
    run_json,
  };
  std::string_view key;
  Json (*write)(const RunRecord&);  // unknown and non-finite values are null
  void (*read)(const JsonCursor&,
               RunRecord&);  // throws UsageError for a wrong type; null is an empty or NaN member
  Place place = Place::everywhere;
};
/// All keys in reading order.
std::span<const RecordField> record_fields();

/// run.json.
Json to_json(const RunRecord& record);
/// The keys of a run in results.json.
Json to_results(const RunRecord& record);
/// Reads an object with the keys of run.json. Missing keys give empty members. Throws UsageError, with file and key,
/// for a record that taut cannot have written.
RunRecord record_from(const JsonCursor& json);

/// A run.json with all its text.
struct StoredRecord : RunRecord {
  Json all;
};

/// Time that a stored run took, s; 0 if unknown. Of a continued run, the time of the last part or of all steps.
double seconds_taken(const StoredRecord& record);

/// Returns nullopt without a file. Throws like record_from.
std::optional<StoredRecord> checked_record(const std::filesystem::path& file);
/// Same as checked_record, but returns nullopt for invalid records.
std::optional<StoredRecord> read_record(const std::filesystem::path& file);
/// Parses the text of `file`.
StoredRecord parse_record(const std::string& text, const std::string& file);

}  // namespace taut::cli
