#include "cli/run/resume.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/core.h>

#include "cli/run/checkpoint.hpp"
#include "cli/run/record.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

std::optional<double> later_end(const RunOptions& given, const RunFolder& folder,
                                const StoredRecord& record) {
  std::vector<Setting> until;
  std::ranges::copy_if(given.settings, std::back_inserter(until),
                       [](const Setting& setting) { return setting.name == "until"; });
  if (until.empty()) return std::nullopt;
  const double time = read_scene(folder.scene(), until).scene.until;
  return time > record.until ? std::optional(time) : std::nullopt;
}

void check_something_is_left(const RunFolder& folder, const std::optional<StoredRecord>& record,
                             const RunOptions& given) {
  std::error_code error;
  const std::string name = fmt::format("'{}'", folder.path().string());
  if (!fs::is_regular_file(folder.scene(), error) || !record)
    throw UsageError(name + " is not a run folder; name a folder that `taut run` has written");
  const bool has_checkpoint = fs::exists(folder.checkpoint(), error);
  const bool has_later_end = later_end(given, folder, *record).has_value();
  if (record->status == RunRecord::Status::finished && !(has_checkpoint && has_later_end))
    throw UsageError(fmt::format("the run in {} is finished: {}", name,
                                 has_checkpoint ? "give a later --until to continue it"
                                 : has_later_end
                                     ? "it has no checkpoint for a later --until; "
                                       "run it again, with --keep-checkpoint to continue it afterwards"
                                     : "nothing is left to do"));
  if (!has_checkpoint && record->status == RunRecord::Status::failed)
    throw UsageError(fmt::format("the run in {} has failed: nothing is left to do", name));
}

void check_same_scene(const Checkpoint& checkpoint, const RunFolder& folder, const RunPlan& plan) {
  const std::string name = fmt::format("'{}'", folder.checkpoint().string());
  if (const std::string& method = plan.file.settings.method; checkpoint.method != method)
    throw UsageError(fmt::format("{} has method '{}', but {} has '{}'; the methods must be the same", name,
                                 checkpoint.method, folder.scene().string(), method));
  if (checkpoint.scene != read_whole(folder.scene()))
    throw UsageError(
        fmt::format("{} does not belong to {}: it is from another scene, or the scene was changed", name,
                    folder.scene().string()));
}

void check_same_files(const StoredRecord& record, const RunFolder& folder, const RunPlan& plan) {
  if (!record.file_checksum.empty() && record.file_checksum != plan.file_checksum)
    throw UsageError(fmt::format(
        "a table or shape that '{}' names has changed since the run started; restore it, or start again",
        folder.scene().string()));
}

RunOptions stored_options(const RunFolder& folder, const std::optional<Checkpoint>& checkpoint,
                          const RunOptions& given) {
  RunOptions options;
  options.scene = folder.scene().string();
  options.out = folder.path().string();
  options.threads = given.threads;
  options.keep_checkpoint = given.keep_checkpoint;
  if (checkpoint) {
    options.checkpoint_every =
        checkpoint->every > 0 ? std::optional(checkpoint->every) : given.checkpoint_every;
    options.no_render = !checkpoint->draws;
    const ParticleForm& form = checkpoint->particle_form;
    if (!checkpoint->fields.empty()) options.save_particles = name(form.format);
    if (form.single_precision) options.particle_precision = "single";
    options.fields = checkpoint->fields;
  } else {
    options.checkpoint_every = given.checkpoint_every;
    options.no_render = given.no_render;
    options.save_particles = given.save_particles;
    options.particle_precision = given.particle_precision;
    options.fields = given.fields;
  }
  return options;
}

/// Option that would change the run, or "".
std::string first_conflict(const RunOptions& given, const RunOptions& stored, const RunPlan& plan) {
  std::error_code error;
  if (given.out && !fs::equivalent(*given.out, plan.folder.path(), error)) return "--out " + *given.out;
  if (given.no_render && plan.drawing) return "--no-render";
  if (!given.save_particles.empty() && (particle_fields(given, plan.file.scene.dim) != plan.particle_fields ||
                                        particle_form(given) != plan.particle_form))
    return "--save-particles";
  if (given.checkpoint_every && given.checkpoint_every != stored.checkpoint_every)
    return "--checkpoint-every " + exact(*given.checkpoint_every);
  const auto differs = [&](const auto& change) {
    RunOptions options = stored;
    change(options);
    return make_plan(options).scene_text() != plan.scene_text();
  };
  for (const Setting& setting : given.settings)
    if (differs([&](RunOptions& options) { options.settings = {setting}; })) return text_of(setting);
  if (differs([&](RunOptions& options) { options.frames = given.frames, options.every = given.every; }))
    return given.frames ? "--frames" : "--every";
  if (differs([&](RunOptions& options) { options.history = given.history; })) return "--history";
  if (differs([&](RunOptions& options) { options.drawing = given.drawing; })) return "a drawing option";
  const auto all_of_it = [&](RunOptions& options) {
    options = given;
    options.out = stored.out;
  };
  return !given.scene.empty() && differs(all_of_it)
             ? fmt::format("SCENE '{}' with the options given", given.scene)
             : "";
}

/// Bonds and loads at the start depend on which drives end before the end of the run.
void check_same_drives(const Scene& scene, const Scene& longer) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    for (std::size_t k = 0; k < scene.bodies[b].drives.size(); ++k) {
      const Drive& drive = scene.bodies[b].drives[k];
      if (ends_before_run(drive, scene) != ends_before_run(longer.bodies[b].drives[k], longer))
        throw UsageError(
            fmt::format("the run cannot continue past {} s, where a drive of body '{}' ends; "
                        "give at most this time, or start again with --until {}",
                        exact(*drive.until), scene.bodies[b].name, exact(longer.until)));
    }
}

/// Keeps the intervals of frames and rows.
RunPlan run_on(const RunPlan& plan, RunOptions stored, double until) {
  stored.settings = {{"until", exact(until)}};
  if (!plan.frame_times.empty()) {
    const double interval = plan.file.scene.until / plan.file.drawing.frames, count = until / interval;
    const double whole = std::round(count);
    if (std::abs(count - whole) > 1e-9 * count)
      throw UsageError(fmt::format(
          "--until must be a multiple of the time between frames, {} s, such as {}", brief(interval),
          exact(whole > plan.file.drawing.frames ? whole * interval : (whole + 1) * interval)));
    stored.frames = static_cast<int>(std::fmin(whole, 1e9));
  }
  stored.keep_checkpoint = true;
  RunPlan longer = make_plan(stored);
  check_same_drives(plan.file.scene, longer.file.scene);
  longer.runs_on = true;
  return longer;
}

}  // namespace

void check_resumable(const fs::path& path, const RunOptions& given) {
  const RunFolder folder(path);
  check_something_is_left(folder, checked_record(folder.record()), given);
}

RunPlan resume_plan(const fs::path& path, const RunOptions& options) {
  RunOptions given = options;
  const RunFolder folder(path);
  const std::optional<StoredRecord> record = checked_record(folder.record());
  check_something_is_left(folder, record, given);
  const std::optional<double> later = later_end(given, folder, *record);
  if (later) std::erase_if(given.settings, [](const Setting& setting) { return setting.name == "until"; });
  std::optional<Checkpoint> checkpoint;
  if (std::error_code error; fs::exists(folder.checkpoint(), error))
    checkpoint = read_checkpoint(folder.checkpoint());
  RunOptions stored = stored_options(folder, checkpoint, given);
  RunPlan plan = make_plan(stored);
  if (checkpoint) check_same_scene(*checkpoint, folder, plan);
  if (const std::string other = first_conflict(given, stored, plan); !other.empty())
    throw UsageError(
        fmt::format("--resume continues the run in '{}' unchanged; {} would change it; leave it out",
                    path.string(), other));
  if (later) plan = run_on(plan, stored, *later);
  plan.requested_spacing = checkpoint ? checkpoint->requested_spacing : record->requested_spacing;
  if (checkpoint && !checkpoint->state.empty()) {
    check_same_files(*record, folder, plan);
    plan.state = std::move(checkpoint->state);
    plan.file_checksum = record->file_checksum;
  }
  return plan;
}

}  // namespace taut::cli
