#include <filesystem>
#include <memory>
#include <ostream>

#include <fmt/core.h>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/drawing/frames.hpp"
#include "cli/run/dry_run.hpp"
#include "cli/run/record.hpp"
#include "cli/run/report.hpp"
#include "cli/run/resume.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/system/folder_lock.hpp"
#include "cli/text/checks.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"
#include "engine/methods/catalogue.hpp"

namespace taut::cli {
namespace {

struct RunArguments : RunOptions {
  std::optional<std::string> fail_on;
  std::optional<std::string> resume;
  bool force = false, dry_run = false;
  bool quiet = false;
};

void declare_options(Options& command, RunArguments& o) {
  command.add_argument("SCENE", o.scene, "a name from `taut list scenes`, or the path of a scene file");
  declare_setting_options(command, o);
  command.add("--out", "DIR", o.out,
              "run folder, whose older run is replaced; default: "
              "out/SCENE-METHOD, followed by the changed settings, such as -v0=0.08");
  declare_output_options(command, o);
  declare_particle_options(command, o);
  command
      .add(
          "--checkpoint-every", "T", o.checkpoint_every,
          "write a checkpoint for --resume after each T of simulated time, s; default: only when interrupted")
      .check(positive_number);
  command.add_flag("--keep-checkpoint", o.keep_checkpoint,
                   "keep a checkpoint of the end, to continue the run with --resume and a later --until");
  command.add("--resume", "DIR", o.resume,
              "continue the run in this folder from its last checkpoint, or from the start if there is none; "
              "the results are the same as without the interruption; other options must agree with the run, "
              "but --until may be later");
  command.add_flag("--force", o.force, "replace an older run that took more than a minute");
  command.add_flag(
      "--dry-run", o.dry_run,
      "print size, time step, number of steps, estimated time and memory, and draw the first picture; write no run");
  command.add("--threads", "N", o.threads, "number of threads; default: all cores, fewer for small scenes")
      .check(positive_whole_number);
  command.add_flag("--no-render", o.no_render, "draw no frames");
  command.add("--fail-on", "VERDICT", o.fail_on, "end with exit code 3 if the verdict is this one or worse");
  command.add_flag("--quiet", o.quiet, "print no progress on stderr");
}

/// With --resume, the plan is read after the folder is locked.
struct LockedPlan {
  std::unique_ptr<const FolderLock> lock;
  RunPlan plan;
};

void refuse_to_lose(const RunFolder& folder) {
  constexpr double minute = 60;  // s
  const auto record = read_record(folder.record());
  if (!record) return;
  const double seconds = seconds_taken(*record);
  if (seconds > minute)
    throw UsageError(fmt::format(
        "the older run in '{}' took {} minutes; replace it with --force, or name another folder with --out",
        folder.path().string(), brief(seconds / minute)));
}

LockedPlan planned(const RunArguments& options, std::ostream& err) {
  const auto lock = [&err](const std::filesystem::path& folder) {
    return std::make_unique<const FolderLock>(folder, FolderLock::Of::run, "taut run", err);
  };
  LockedPlan all;
  if (!options.resume) {
    if (options.scene.empty()) throw UsageError("SCENE is required; see `taut run --help`");
    all.plan = make_plan(options);
    all.lock = lock(all.plan.folder.path());
    all.plan.folder.check();  // the folder may have changed
    if (!options.force) refuse_to_lose(all.plan.folder);
    return all;
  }
  check_resumable(*options.resume,
                  options);  // before the lock creates a file
  all.lock = lock(*options.resume);
  all.plan = resume_plan(*options.resume, options);
  if (!all.plan.state)
    err << "taut: the run in '" << *options.resume << "' has no checkpoint; it starts from the beginning\n";
  return all;
}

std::string advice(const SceneFile& file, long steps) {
  if (steps == 0) return "no step was made: check the initial velocity and displacement in the scene";
  const double usual = find_method(file.settings.method)->cfl, cfl = file.settings.cfl;
  if (cfl > usual)
    return fmt::format("cfl = {} is above the default of the method: use at most {}", brief(cfl),
                       brief(usual));
  return fmt::format("run it with --set cfl={} to find out whether the time step is the cause",
                     brief(cfl / 2));
}

void tell_what_is_replaced(const RunArguments& options, const RunPlan& plan, std::ostream& err) {
  const RunFolder& folder = plan.folder;
  if (!options.resume && (read_record(folder.record()) || folder.is_damaged()))
    err << "taut: the older run in '" << folder.path().string() << "' is replaced\n";
}

int run(const RunArguments& options, Streams streams) {
  const Stopwatch setup;
  const std::optional<Verdict> fail_on = parse_verdict(options.fail_on);
  if (options.dry_run) {
    if (options.resume) throw UsageError("--dry-run and --resume exclude each other");
    const RunPlan plan = make_plan(options);
    print_remark(plan.file, streams.err);
    streams.out << dry_run(plan, streams.err);
    return exit_fine;
  }
  const auto [lock, plan] = planned(options, streams.err);
  print_remark(plan.file, streams.err);
  const Interrupts interrupts;
  Progress progress(streams.err, progress_style(streams.err, options.quiet));
  const RunResult result =
      run_scene(plan, interrupts, progress, setup.seconds(),
                [&options, &plan = plan, &streams] { tell_what_is_replaced(options, plan, streams.err); });
  streams.out << run_report(plan, result);
  if (const std::string& all = result.record.remark; all.size() > plan.file.remark.size())
    streams.err << "taut: " << all.substr(plan.file.remark.empty() ? 0 : plan.file.remark.size() + 2) << '\n';
  streams.err << remark_on_texts(result.cut_texts);
  if (result.record.status == RunRecord::Status::interrupted)
    streams.err << "taut: interrupted; `taut run --resume " << plan.folder.path().string()
                << "` continues the run\n";
  if (!result.failure.empty())
    streams.err << "taut: " << result.failure << "; " << advice(plan.file, result.record.steps) << '\n';
  const int code = exit_code(result, fail_on);
  if (code == exit_diverged && result.failure.empty())
    streams.err << "taut: exit code " << code << ", since the verdict is " << name(*result.record.verdict)
                << " and --fail-on is " << name(*fail_on) << '\n';
  return code;
}

}  // namespace

std::function<int(Streams)> declare_run(Options& command) {
  auto options = std::make_shared<RunArguments>();
  declare_options(command, *options);
  return [options](Streams streams) { return run(*options, streams); };
}

}  // namespace taut::cli
