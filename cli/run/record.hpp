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

struct SavedParticles {
  std::string format, precision;  // "vtp", "double"
  std::vector<std::string> fields;

  bool operator==(const SavedParticles&) const = default;
};

/// Contents of run.json.
struct RunRecord {
  enum class Status { running, finished, interrupted, failed };

  std::string version{build_info.version};
  std::string scene, method, material_law;
  std::string remark;
  std::optional<std::string> contact;  // if there are several bodies, or a wall
  std::string stepping;                // "dual" or "single"
  double cfl = 0;
  std::vector<std::pair<std::string, double>> parameters;
  int dim = 2;
  double spacing = 0;                       // m, as used
  std::optional<double> requested_spacing;  // m, if different
  Jitter jitter;
  std::string file_checksum;  // empty without named files, or from an older version
  std::optional<SavedParticles> saved_particles;
  long particles = 0;
  double mass = 0;                // kg, in 2D per metre
  double until = 0, reached = 0;  // s
  std::optional<Status> status = Status::running;
  std::string reason;  // of a failure
  long steps = 0;
  int threads = 1;
  std::string machine;  // processor
  Seconds seconds;
  std::optional<Verdict> verdict = Verdict::stable;
  std::map<Verdict, double> since;  // start of each failure, s
  BeyondLaw beyond_law;
  Excess energy_gain, turn;
  int pieces = 0;
  std::array<IndicatorRecord, indicators.size()> indicator;
  std::string patch_body;           // of the worst patch; empty: none is worse than a whole body
  std::vector<double> patch_place;  // initial middle, m
  Conservation conservation;
  std::vector<MeasureResult> measures;
  std::optional<double> other_load;  // cores used by other processes
  Provenance provenance;

  const MeasureResult* find_measure(std::string_view name) const;
  /// Empty for an unknown name.
  const MeasureResult& measure(std::string_view name) const;
  /// Particles × steps / solve, 1/s.
  std::optional<double> particle_steps_per_second() const;
};

/// A warning does not change the verdict.
struct RunWarning {
  std::string key;   // in run.json
  std::string text;  // "gains energy since t = 0.1 s: …"
  Json figures;
};
std::vector<RunWarning> warnings(const RunRecord& record);

/// Explains an energy drift of 1 % or more; else empty.
std::string energy_note(const RunRecord& record);

/// A key of run.json, results.json or results.csv.
struct RecordField {
  enum class Place {
    everywhere,
    everywhere_if_known,  // omitted if null or empty
    last_in_results,      // varies between repetitions
    results,              // last, omitted if null
    run_json,             // omitted if null or empty
  };
  std::string_view key;
  Json (*write)(const RunRecord&);              // non-finite values are null
  void (*read)(const JsonCursor&, RunRecord&);  // accepts null; throws UsageError
  Place place = Place::everywhere;
};
std::span<const RecordField> record_fields();

Json to_json(const RunRecord& record);
/// Keys of results.json.
Json to_results(const RunRecord& record);
/// Missing keys give empty members or defaults. Throws UsageError.
RunRecord record_from(const JsonCursor& json);

/// With all keys of run.json.
struct StoredRecord : RunRecord {
  Json all;
};

/// Run time in s, or 0. After --resume, a lower bound: the stored wall time covers the last part only.
double seconds_taken(const StoredRecord& record);

/// Returns nullopt without a file. Throws like record_from.
std::optional<StoredRecord> checked_record(const std::filesystem::path& file);
/// Returns nullopt for a missing or invalid file.
std::optional<StoredRecord> read_record(const std::filesystem::path& file);
StoredRecord parse_record(const std::string& text, const std::string& file);

}  // namespace taut::cli
