#include "cli/run/resume.hpp"

#include "cli/run/checkpoint.hpp"
#include "cli/run/plan.hpp"
#include "cli/system/atomic_file.hpp"
#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

void check_there_is_one(const RunFolder& folder) {
  std::error_code error;
  const std::string name = '\'' + folder.path().string() + '\'';
  if (!fs::exists(folder.scene(), error))
    throw UsageError(name + " is not the folder of a run; `taut run` leaves one");
  if (fs::exists(folder.checkpoint(), error)) return;
  const std::optional<StoredRecord> record = read_record(folder.record());
  const bool failed = record && record->status == RunRecord::Status::failed;
  if (failed || (record && record->status == RunRecord::Status::finished))
    throw UsageError("the run in " + name + (failed ? " has failed" : " is finished") +
                     ": nothing is left to do");
  throw UsageError(
      name +
      " holds no checkpoint: the run was started without --checkpoint-every, or ended before the "
      "first; start it anew with\n  taut run " +
      folder.scene().string() + " --checkpoint-every T --out " + folder.path().string());
}

void check_same_scene(const Checkpoint& checkpoint, const RunFolder& folder, const RunPlan& plan) {
  const std::string name = '\'' + folder.checkpoint().string() + '\'';
  if (const std::string& method = plan.file.settings.method; checkpoint.method != method)
    throw UsageError(name + " is of a run with method '" + checkpoint.method + "'; " +
                     folder.scene().string() + " has '" + method + "'");
  if (checkpoint.scene != read_whole(folder.scene()))
    throw UsageError(name + " is of another scene than " + folder.scene().string() +
                     ", or that was changed since");
}

}  // namespace

RunPlan resume_plan(const fs::path& path, int threads) {
  const RunFolder folder(path);
  check_there_is_one(folder);
  Checkpoint checkpoint = read_checkpoint(folder.checkpoint());
  RunOptions options;
  options.scene = folder.scene().string();
  options.out = path.string();
  options.threads = threads;
  options.no_render = !checkpoint.draws;
  options.save_particles = !checkpoint.fields.empty();
  options.fields = checkpoint.fields;
  RunPlan plan = make_plan(options);
  check_same_scene(checkpoint, folder, plan);
  plan.spacing_asked = checkpoint.spacing_asked;
  plan.checkpoint_every = checkpoint.every;
  plan.state = std::move(checkpoint.state);
  return plan;
}

}  // namespace taut::cli
