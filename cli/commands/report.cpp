#include "cli/report/report.hpp"

#include <chrono>
#include <ostream>
#include <thread>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/command_line/report_options.hpp"
#include "cli/run/frame_folders.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/system/interrupts.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

struct PageArguments : DifferenceOptions {
  ReportRequest request;
  bool watch = false;
  bool json = false;
};

int report(const PageArguments& options, Streams streams) {
  ReportRequest request = options.request;
  if (options.max_difference && !request.baseline)
    throw UsageError("--max-difference needs --baseline, the folder to compare with");
  if (options.watch && request.embed) throw UsageError("give --watch or --embed, not both");
  request.limit = limit_of(options);
  WrittenPage page = write_report(request);
  Json json = json_answer("report");
  json["kind"] = name(page.kind);
  json["page"] = page.file.string();
  json["runs"] = page.runs;
  streams.out << (options.json ? json.dump(2) : "page  " + page.file.string()) << std::endl;
  const Interrupts interrupts;
  while (options.watch && page.running) {
    for (int k = 0; k < 20; ++k) {
      if (interrupts.interrupted()) return interrupts.exit_code();
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    page = write_report(request);
  }
  return exit_fine;
}

}  // namespace

std::function<int(Streams)> declare_report(Options& command) {
  auto options = std::make_shared<PageArguments>();
  command
      .add_argument("DIR", options->request.paths,
                    "run folders, folders of sweeps, or the folder of a suite of snapshots; "
                    "with --baseline, one folder with pictures")
      .required();
  command.add("--out", "DIR", options->request.out,
              "folder of the page, with --embed its file; default: DIR/report, for several DIRs out/report");
  command.add_flag("--embed", options->request.embed,
                   "write one HTML file that contains all pictures and data");
  command.add_flag("--watch", options->watch,
                   "rewrite the page every two seconds until the runs have ended; an open page follows");
  command.add("--baseline", "DIR", options->request.baseline,
              "compare the pictures of DIR with the expected pictures in this folder");
  declare_difference_options(command, *options);
  command.add_flag("--json", options->json, "print one JSON object, for scripts");
  return [options](Streams streams) { return report(*options, streams); };
}

}  // namespace taut::cli
