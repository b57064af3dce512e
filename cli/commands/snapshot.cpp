#include <algorithm>
#include <filesystem>
#include <ostream>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/command_line/report_options.hpp"
#include "cli/run/frame_folders.hpp"
#include "cli/run/plan.hpp"
#include "cli/run/report.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/system/folder_lock.hpp"
#include "cli/text/checks.hpp"
#include "engine/error.hpp"
#include "render/image/png.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

struct SnapshotArguments : RunOptions, DifferenceOptions, ReportOptions {
  std::string baseline;
  bool update = false;
  bool quiet = false;
};

void declare_options(Options& command, SnapshotArguments& o) {
  command.add_argument("SCENE", o.scene, "a name from `taut list scenes`, or the path of a scene file")
      .required();
  command.add("--baseline", "DIR", o.baseline, "folder of the frames to compare with").required();
  command.add_flag("--update", o.update, "replace the baseline by the frames of this run; check them first");
  declare_difference_options(command, o);
  declare_setting_options(command, o);
  command.add("--out", "DIR", o.out, "run folder; default: out/snapshot-BASELINE");
  declare_output_options(command, o);
  command.add("--threads", "N", o.threads, "number of threads; default: all cores, fewer for small scenes")
      .check(positive_whole_number);
  o.declare_json(command);
  o.declare_junit(command);
  command.add_flag("--quiet", o.quiet, "print no progress on stderr");
}

/// Resolves links.
fs::path plain_path(const fs::path& path) { return (fs::weakly_canonical(path) / "").parent_path(); }

void check_baseline(const SnapshotArguments& options, const fs::path& run_folder) {
  const fs::path baseline = plain_path(options.baseline), run = plain_path(run_folder);
  if (std::ranges::mismatch(run, baseline).in1 == run.end())
    throw UsageError("the baseline is inside the run folder " + run_folder.string() +
                     ", which the run replaces; name another run folder with --out");
  if (fs::exists(baseline) && !fs::is_directory(baseline))
    throw UsageError("the baseline '" + options.baseline + "' is not a folder");
  if (!options.update && picture_names(baseline).empty())
    throw UsageError("there is no baseline in '" + options.baseline +
                     "'; create it from this run with --update");
  if (!options.update || !fs::exists(baseline)) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(baseline))
    if (!is_frame(entry.path()))
      throw UsageError("'" + options.baseline + "' contains " + entry.path().filename().string() +
                       ", which is not a frame and would be lost; name another folder with --baseline");
}

struct Result {
  int code = exit_fine;
  std::string text;
  Json json = json_answer("snapshot");
  std::vector<TestCase> cases;
  std::string worst;
};

void update(const SnapshotArguments& options, const RunFolder& run, Result& result) {
  std::vector<fs::path> files;
  for (const std::string& name : picture_names(run.frames())) {
    files.push_back(run.frames() / name);
    result.cases.push_back({name});
  }
  write_whole_folder(options.baseline, files);
  result.text = "baseline " + options.baseline + ": " + std::to_string(files.size()) + " frames\n";
}

void compare_with_baseline(const SnapshotArguments& options, const RunFolder& run, Result& result) {
  const fs::path baseline = options.baseline;
  const std::string frames = run.frames().string();
  const FolderDifference difference = compare_folders(baseline, frames, limit_of(options));
  result.text = difference_report(difference, baseline.string(), frames);
  result.json["pictures"] = pictures_json(difference);
  result.cases = test_cases(difference, baseline.string(), frames);
  if (difference.alike()) return;
  result.code = exit_different;
  if (difference.different() == 0) return;
  result.worst = difference.worst;
  result.json["difference"] = run.difference().string();
  result.text += "  picture of the differences: " + run.difference().string() + "\n";
}

int snapshot(SnapshotArguments options, Streams streams) {
  const Stopwatch setup;
  if (!options.out) {
    options.out = "out/snapshot-" + plain_path(options.baseline).filename().string();
    options.out_named = false;
  }
  const RunPlan plan = make_plan(options);
  print_remark(plan.file, streams.err);
  check_baseline(options, plan.folder.path());
  const FolderLock lock(plan.folder.path(), FolderLock::Of::run, "taut snapshot", streams.err);
  plan.folder.check();  // may have changed
  const Interrupts interrupts;
  Progress progress(streams.err, progress_style(streams.err, options.quiet));
  const RunResult run = run_scene(plan, interrupts, progress, setup.seconds());
  if (!run.failure.empty()) streams.err << "taut: " << run.failure << '\n';
  Result result;
  result.code = exit_code(run);
  result.json["run"] = plan.folder.path().string();
  result.json["baseline"] = options.baseline;
  result.json["updated"] = options.update && result.code == exit_fine;
  result.json["pictures"] = Json::array();
  if (result.code != exit_fine)
    result.cases = {{"run", TestCase::Result::error, run.failure.empty() ? "interrupted" : run.failure}};
  else if (options.update)
    update(options, plan.folder, result);
  else
    compare_with_baseline(options, plan.folder, result);
  result.json["passed"] = result.code == exit_fine;
  streams.out << (options.json ? result.json.dump(2) + "\n" : result.text);
  options.publish({"snapshot", options.baseline, result.cases}, streams.err);
  if (!result.worst.empty())
    render::write_png(render::difference_picture(render::read_png(options.baseline / fs::path(result.worst)),
                                                 render::read_png(plan.folder.frames() / result.worst)),
                      plan.folder.difference());
  return result.code;
}

}  // namespace

std::function<int(Streams)> declare_snapshot(Options& command) {
  auto options = std::make_shared<SnapshotArguments>();
  declare_options(command, *options);
  return [options](Streams streams) { return snapshot(*options, streams); };
}

}  // namespace taut::cli
