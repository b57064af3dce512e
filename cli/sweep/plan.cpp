#include "cli/sweep/plan.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/core.h>

#include "cli/run/history.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/system/build_info.hpp"
#include "cli/text/format.hpp"
#include "engine/diagnostics/measure_kinds.hpp"
#include "engine/error.hpp"
#include "engine/methods/catalogue.hpp"
#include "engine/simulation.hpp"

namespace taut::cli {
namespace {

namespace fs = std::filesystem;

/// `drawn`: settings of the drawing must also agree.
bool are_of_one_run(const std::string& one, const std::string& other, bool drawn) try {
  return one == other || (!drawn && without_drawing(one) == without_drawing(other));
} catch (const SceneError&) {
  return false;
}

/// Records of older versions contain neither key and agree.
bool has_same_files(const RunRecord& found, const SweepRun& planned) {
  const bool same_input = found.file_checksum.empty() || found.file_checksum == planned.file_checksum;
  const bool same_particles = planned.options.save_particles.empty() || !found.saved_particles ||
                              found.saved_particles == planned.saved_particles;
  return same_input && same_particles;
}

RunOptions options_of(const SweepRequest& request, const GridRow& row, const Setting* without = nullptr) {
  RunOptions options = request.base;
  for (const GridRow* settings : {&request.set, &row})
    for (const Setting& s : *settings)
      if (&s != without) options.settings.push_back(s);
  options.out = (request.folder / folder_name(row)).string();
  options.out_named = false;
  return options;
}

void check_particles(const SceneFile& file) try {
  Settings settings = file.settings;
  settings.threads = 1;  // a process that has had threads cannot be forked
  make_simulation(file.scene, settings);
} catch (const SceneError& error) {
  throw locate(file, error);
}

bool is_wrong(const RunOptions& options) try {
  check_particles(make_plan(options).file);
  return false;
} catch (const UsageError&) {
  return true;
} catch (const SceneError&) {
  return true;
}

/// The setting without which the run is valid, or nullptr.
const Setting* invalid_setting(const SweepRequest& request, const GridRow& row) {
  for (const GridRow* settings : {&request.set, &row})
    for (const Setting& s : *settings)
      if (!is_wrong(options_of(request, row, &s))) return &s;
  return nullptr;
}

[[noreturn]] void report(const SweepRequest& request, const GridRow& row, const std::string& what) {
  const std::string message = fmt::format("{} (in the run {})", what, text_of(row));
  if (request.file.empty()) throw UsageError(message);
  const Setting* setting = invalid_setting(request, row);
  const FilePlace place = setting ? setting->place : FilePlace{};
  throw SceneError(request.file.string(), place.line, place.column, setting ? setting->name : "", message);
}

/// Particles × steps, up to a factor of the method. Overlaps and cut-outs of shapes count as particles.
double work_of(const SceneFile& file) {
  const Scene& scene = file.scene;
  double volume = 0, speed = 0;  // m^dim, m/s
  for (const Body& body : scene.bodies)
    for (const Shape& shape : body.shapes) volume += shape->measure(scene.dim);
  for (const Material& material : scene.materials) speed = std::max(speed, material.sound_speed());
  const double particles = std::max(1.0, volume / std::pow(scene.spacing, scene.dim));
  return particles * scene.until * speed / (file.settings.cfl * scene.spacing);
}

/// Throws UsageError for names both fixed and swept.
void check_base(const SweepRequest& request) {
  std::set<std::string> fixed;
  for (const std::vector<Setting>* settings : {&request.base.settings, &request.set})
    for (const Setting& s : *settings) fixed.insert(s.name);
  for (const GridRow& row : request.rows)
    for (const Setting& s : row)
      if (fixed.contains(s.name))
        throw UsageError(fmt::format(
            "'{}' is swept, so it cannot also have one value for all runs; leave one of them out", s.name));
}

void check_folder(const fs::path& folder) {
  std::error_code error;
  const auto holds = [&](const char* name) { return fs::exists(folder / name, error); };
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw UsageError(fmt::format("'{}' is not a folder; name another with --out", folder.string()));
  if (holds("run.json") || ((holds("results.csv") || holds("results.json")) && !holds("sweep.lock")))
    throw UsageError(fmt::format(
        "'{}' contains files that are not from a sweep; name another folder with --out", folder.string()));
}

void add_available(AvailableData& available, const SceneFile& file) {
  const Scene& scene = file.scene;
  const std::string_view law = material_law(*find_method(file.settings.method), file.settings, scene.dim);
  const auto reference = scene.references.find(std::string(law));
  for (const Measure& measure : scene.measures) {
    available.measures.insert(measure.name);
    if (is_difference(measure.kind)) available.differences.insert(measure.name);
    if (reference != scene.references.end() && reference->second.has(measure.name))
      available.referenced.insert(measure.name);
  }
  available.methods.insert(file.settings.method);
  for (const std::string& column : history_columns(scene)) available.columns.insert(column);
}

void add_swept(AvailableData& available, const std::string& name, const std::vector<GridRow>& rows) {
  std::set<std::string> values;
  for (const GridRow& row : rows)
    for (const Setting& setting : row)
      if (setting.name == name) values.insert(setting.value);
  available.swept.push_back(name);
  if (values.size() > 1) available.varied.push_back(name);
}

/// Detects runs made equal by rounded spacings.
class Spacings {
 public:
  std::string add(const GridRow& row, double fitted) {
    GridRow others = row;
    std::erase_if(others, [](const Setting& s) { return s.name == "spacing"; });
    if (others.size() == row.size()) return {};
    const auto [before, is_new] =
        before_.emplace(std::pair(text_of(others), fmt::format("{:.12g}", fitted)), &row);
    if (is_new) return {};
    return fmt::format(
        "the runs {} and {} are the same: both spacings are rounded to {} m, which divides the first body",
        text_of(*before->second), text_of(row), brief(fitted));
  }

 private:
  std::map<std::pair<std::string, std::string>, const GridRow*> before_;
};

std::vector<Swept> swept_names(const std::vector<GridRow>& rows, const SceneFile& file) {
  std::vector<Swept> all;
  for (const GridRow& row : rows)
    for (const Setting& s : row) {
      if (std::ranges::find(all, s.name, &Swept::name) != all.end()) continue;
      const auto parameter = std::ranges::find(file.parameters, s.name, &Parameter::name);
      const bool found = parameter != file.parameters.end();
      all.push_back({s.name, found ? parameter->unit : "", found ? parameter->help : ""});
    }
  return all;
}

}  // namespace

std::string_view name(SweepRunState state) {
  switch (state) {
    case SweepRunState::to_do:
      return "to do";
    case SweepRunState::outdated:
      return "to do: finished with other settings, other input files or another version of taut";
    case SweepRunState::interrupted:
      return "to do: interrupted";
    case SweepRunState::damaged:
      return "to do: run.json is damaged";
    case SweepRunState::broken:
      return "broken";
    case SweepRunState::done:
      return "done";
  }
  return "";
}

std::vector<SweepRun*> SweepRun::all() {
  std::vector<SweepRun*> runs{this};
  for (SweepRun& repetition : repetitions) runs.push_back(&repetition);
  return runs;
}

const SweepRun& SweepRun::first_unfinished() const {
  if (state != SweepRunState::done) return *this;
  const auto other = std::ranges::find_if(
      repetitions, [](const SweepRun& repetition) { return repetition.state != SweepRunState::done; });
  return other == repetitions.end() ? *this : *other;
}

std::optional<RepeatedCost> SweepRun::cost() const {
  const auto cpu = [](const RunRecord* of) { return of->seconds.cpu; };
  std::vector<const RunRecord*> records;
  if (record) records.push_back(&*record);
  for (const SweepRun& repetition : repetitions)
    if (repetition.state == SweepRunState::done) records.push_back(&*repetition.record);
  if (records.empty()) return std::nullopt;
  std::ranges::sort(records, {}, cpu);
  const RunRecord* median = records[(records.size() - 1) / 2];
  const double range = cpu(records.back()) - cpu(records.front());
  return RepeatedCost{static_cast<int>(records.size()), median, cpu(median) > 0 ? range / cpu(median) : 0};
}

void SweepRun::forget() {
  state = SweepRunState::to_do;
  problem.clear();
  record.reset();
  seconds = 0;
}

void SweepRun::read_folder() {
  using Status = RunRecord::Status;
  forget();
  const RunFolder files(*options.out);
  const std::optional<StoredRecord> found = read_record(files.record());
  if (!found && files.is_damaged()) state = SweepRunState::damaged;
  if (!found) return;
  seconds = seconds_taken(*found);
  const bool same = found->version == build_info.version && has_same_files(*found, *this) &&
                    are_of_one_run(read_whole(files.scene()).value_or(""), scene, last_frame >= 0);
  const bool failed = found->status == Status::failed;
  // a failure other than divergence gives no result
  const bool ended = found->status == Status::finished || (failed && found->verdict == Verdict::diverged);
  std::error_code error;
  const bool drawn = last_frame < 0 || fs::exists(files.frame(failed ? 0 : last_frame), error);
  const bool saved = options.save_particles.empty() ||
                     fs::exists(files.particle_entry(particle_form(options).format), error);
  const bool followed = fs::exists(files.history(), error);
  if (!same) {
    state = ended ? SweepRunState::outdated : SweepRunState::interrupted;
  } else if (ended) {
    state = drawn && saved && followed ? SweepRunState::done : SweepRunState::to_do;
  } else {
    state = SweepRunState::interrupted;
  }
  if (state == SweepRunState::done || (same && found->status == Status::interrupted)) record = found;
}

SweepPlan plan_sweep(const SweepRequest& request) {
  check_base(request);
  check_rows(request.rows);
  check_folder(request.folder);
  SweepPlan plan{.title = request.title,
                 .scene = "",
                 .folder = request.folder,
                 .swept = {},
                 .fixed = request.base.settings,
                 .runs = {},
                 .pictures = request.pictures,
                 .remarks = {}};
  plan.fixed.insert(plan.fixed.end(), request.set.begin(), request.set.end());
  std::set<std::pair<std::string, ContactLaw>> combinations;
  AvailableData available;
  Spacings spacings;
  for (const GridRow& row : request.rows) {
    SweepRun run;
    run.index = static_cast<int>(plan.runs.size());
    run.settings = row;
    run.folder = folder_name(row);
    run.options = options_of(request, row);
    try {
      const RunPlan planned = make_plan(run.options);
      const SceneFile& file = planned.file;
      // once per method and contact law
      if (combinations.emplace(file.settings.method, file.scene.contact).second) check_particles(file);
      if (!file.remark.empty()) plan.remarks.insert(file.remark);
      if (const std::string same = spacings.add(row, file.scene.spacing); !same.empty())
        plan.remarks.insert(same);
      run.scene = planned.scene_text();
      run.file_checksum = planned.file_checksum;
      run.saved_particles = planned.saved_particles();
      run.last_frame = run.options.no_render ? -1 : file.drawing.frames;
      run.work = work_of(file);
      if (plan.runs.empty()) {
        plan.scene = file.scene.name;
        if (plan.title.empty()) plan.title = file.scene.title;
        plan.swept = swept_names(request.rows, file);
      }
      add_available(available, file);
    } catch (const SceneError& error) {
      throw SceneError(error.file, error.line, error.column, error.key,
                       fmt::format("{} (in the run {})", error.what(), text_of(row)));
    } catch (const UsageError& error) {
      report(request, row, error.what());
    }
    for (int k = 2; k <= request.repeat; ++k) {
      SweepRun& repetition = run.repetitions.emplace_back(run);
      repetition.repetitions.clear();
      repetition.options.out = (request.folder / ("repeat-" + std::to_string(k)) / run.folder).string();
    }
    for (SweepRun* each : run.all()) each->read_folder();
    plan.runs.push_back(std::move(run));
  }
  if (plan.title.empty()) plan.title = plan.scene;
  for (const Swept& s : plan.swept) add_swept(available, s.name, request.rows);
  check_pictures(request.pictures, request.file, available);
  return plan;
}

}  // namespace taut::cli
