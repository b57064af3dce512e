#include <ostream>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/command_line/picture_options.hpp"
#include "cli/study/chart_tables.hpp"
#include "cli/study/study.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

struct ChartArguments : PictureOptions {
  ChartRequest request;
  std::string cost = cost_names().front();
  bool json = false, markdown = false;
};

int chart(const ChartArguments& options, Streams streams) {
  ChartRequest request = options.request;
  request.cost = find_cost(options.cost);
  if (options.json && options.markdown) throw UsageError("give --json or --markdown, not both");
  const bool table_only = options.json || options.markdown;
  if (options.out.empty() && !table_only) throw UsageError("give --out PICTURE, --json or --markdown");
  if (!table_only) return draw_chart(options.results, request, plot_files(options.out), streams);
  const Chart all = read_chart(options.results, request, streams.err);
  streams.out << (options.json ? chart_json(all) : markdown(all));
  if (options.out.empty()) return exit_fine;
  std::ostream nowhere(nullptr);  // stdout contains only the table
  std::ostream& quiet = nowhere;
  return draw_chart(options.results, request, plot_files(options.out), {quiet, quiet});
}

}  // namespace

std::function<int(Streams)> declare_chart(Options& command) {
  auto options = std::make_shared<ChartArguments>();
  options->declare(command, "chart.png|chart.svg|chart.pdf", /*needed=*/false);
  declare_measure(command, options->request.measure);
  command.add(
      "--cost", join(cost_names(), "|"), options->cost,
      "x axis. cpu: CPU time to solve, s; wall: elapsed time to solve, s; steps: particles × time steps; "
      "seconds: earlier name of wall; "
      "default: cpu");
  command.add("--methods", "METHOD,...", options->request.methods, "methods to draw; default: all")
      .comma_separated();
  command.add("--against", "METHOD", options->request.against,
              "use the finest stable run of METHOD as the reference, for scenes without a reference");
  command.add_flag("--stable-only", options->request.stable_only, "leave out runs that are not stable");
  command.add_flag("--json", options->json, "print all data as JSON; --out is then optional");
  command.add_flag("--markdown", options->markdown,
                   "print a table of errors by method and spacing; --out is then optional");
  return [options](Streams streams) { return chart(*options, streams); };
}

}  // namespace taut::cli
