#include "cli/report/report.hpp"

#include <ostream>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/command_line/report_options.hpp"
#include "cli/run/frame_folders.hpp"
#include "cli/system/exit_code.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

struct PageArguments : DifferenceOptions {
  ReportRequest request;
  bool json = false;
};

int report(const PageArguments& options, Streams streams) {
  ReportRequest request = options.request;
  if (options.max_difference && !request.baseline)
    throw UsageError("--max-difference needs --baseline, the folder to compare with");
  request.limit = limit_of(options);
  const WrittenPage page = write_report(request);
  Json json = json_answer("report");
  json["kind"] = name(page.kind);
  json["page"] = page.file.string();
  json["runs"] = page.runs;
  streams.out << (options.json ? json.dump(2) : "page  " + page.file.string()) << '\n';
  return exit_fine;
}

}  // namespace

std::function<int(Streams)> declare_report(Options& command) {
  auto options = std::make_shared<PageArguments>();
  command
      .add_argument("DIR", options->request.paths,
                    "run folders, or folders of sweeps; with --baseline, one folder with pictures")
      .required();
  command.add("--out", "DIR", options->request.out,
              "folder of the page, with --embed its file; default: DIR/report, for several DIRs out/report");
  command.add_flag("--embed", options->request.embed,
                   "write one HTML file that contains all pictures and data");
  command.add("--baseline", "DIR", options->request.baseline,
              "compare the pictures of DIR with those in this folder, which are expected");
  declare_difference_options(command, *options);
  command.add_flag("--json", options->json, "print one JSON object, for scripts");
  return [options](Streams streams) { return report(*options, streams); };
}

}  // namespace taut::cli
