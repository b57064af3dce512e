#include "cli/run/resume.hpp"

#include "cli/run/checkpoint.hpp"
#include "cli/run/record.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

void check_something_is_left(const RunFolder& folder, const std::optional<StoredRecord>& record) {
  std::error_code error;
  const std::string name = '\'' + folder.path().string() + '\'';
  if (!fs::is_regular_file(folder.scene(), error) || !record)
    throw UsageError(name + " is not a run folder; name a folder that `taut run` has written");
  if (fs::exists(folder.checkpoint(), error)) return;
  const bool failed = record->status == RunRecord::Status::failed;
  if (failed || record->status == RunRecord::Status::finished)
    throw UsageError("the run in " + name + (failed ? " has failed" : " is finished") +
                     ": nothing is left to do");
}

void check_same_scene(const Checkpoint& checkpoint, const RunFolder& folder, const RunPlan& plan) {
  const std::string name = '\'' + folder.checkpoint().string() + '\'';
  if (const std::string& method = plan.file.settings.method; checkpoint.method != method)
    throw UsageError(name + " has method '" + checkpoint.method + "', but " + folder.scene().string() +
                     " has '" + method + "'; the methods must be the same");
  if (checkpoint.scene != read_whole(folder.scene()))
    throw UsageError(name + " does not belong to " + folder.scene().string() +
                     ": it is from another scene, or the scene was changed");
}

RunOptions stored_options(const RunFolder& folder, const std::optional<Checkpoint>& checkpoint,
                          const RunOptions& given) {
  RunOptions options;
  options.scene = folder.scene().string();
  options.out = folder.path().string();
  options.threads = given.threads;
  if (checkpoint) {
    options.checkpoint_every = checkpoint->every;
    options.no_render = !checkpoint->draws;
    options.save_particles = !checkpoint->fields.empty();
    options.fields = checkpoint->fields;
  } else {
    options.checkpoint_every = given.checkpoint_every;
    options.no_render = given.no_render;
    options.save_particles = given.save_particles;
    options.fields = given.fields;
  }
  return options;
}

/// First option that would change `plan`, made from `stored`; or "".
std::string first_conflict(const RunOptions& given, const RunOptions& stored, const RunPlan& plan) {
  std::error_code error;
  if (given.out && !fs::equivalent(*given.out, plan.folder.path(), error)) return "--out " + *given.out;
  if (given.no_render && plan.drawing) return "--no-render";
  if (given.save_particles && particle_fields(given, plan.file.scene.dim) != plan.particle_fields)
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
  return !given.scene.empty() && differs(all_of_it) ? "SCENE '" + given.scene + "' with the options given"
                                                    : "";
}

}  // namespace

void check_resumable(const fs::path& path) {
  const RunFolder folder(path);
  check_something_is_left(folder, checked_record(folder.record()));
}

RunPlan resume_plan(const fs::path& path, const RunOptions& given) {
  const RunFolder folder(path);
  const std::optional<StoredRecord> record = checked_record(folder.record());
  check_something_is_left(folder, record);
  std::optional<Checkpoint> checkpoint;
  if (std::error_code error; fs::exists(folder.checkpoint(), error))
    checkpoint = read_checkpoint(folder.checkpoint());
  const RunOptions stored = stored_options(folder, checkpoint, given);
  RunPlan plan = make_plan(stored);
  if (checkpoint) check_same_scene(*checkpoint, folder, plan);
  if (const std::string other = first_conflict(given, stored, plan); !other.empty())
    throw UsageError("--resume continues the run in '" + path.string() + "' unchanged; " + other +
                     " would change it; leave it out");
  plan.requested_spacing = checkpoint ? checkpoint->requested_spacing : record->requested_spacing;
  if (checkpoint && !checkpoint->state.empty()) plan.state = std::move(checkpoint->state);
  return plan;
}

}  // namespace taut::cli
