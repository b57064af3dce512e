#include <ostream>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/command_line/picture_options.hpp"
#include "cli/command_line/report_options.hpp"
#include "cli/study/study.hpp"
#include "cli/system/exit_code.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

struct MapArguments : PictureOptions, ReportOptions {
  std::string parameter, measure;
  bool markdown = false;
};

int map(const MapArguments& options, Streams streams) {
  const MapRequest request{options.parameter, options.measure};
  if (options.json && options.markdown) throw UsageError("give --json or --markdown, not both");
  const bool table_only = options.json || options.markdown;
  if (options.out.empty() && !table_only) throw UsageError("give --out PICTURE, --json or --markdown");
  if (!table_only) return draw_map(options.results, request, plot_files(options.out), streams);
  const StabilityMap all = make_map(read_results(options.results), request);
  streams.out << (options.json ? json_answer("map").with(to_json(all)).dump(2) + "\n" : markdown(all));
  if (options.out.empty()) return exit_fine;
  std::ostream nowhere(nullptr);  // stdout contains only the table
  return draw_map(options.results, request, plot_files(options.out), {nowhere, streams.err});
}

}  // namespace

std::function<int(Streams)> declare_map(Options& command) {
  auto options = std::make_shared<MapArguments>();
  options->declare(command, "map.png|map.svg|map.pdf", /*needed=*/false);
  command.add("--parameter", "PARAMETER", options->parameter,
              "parameter on the x axis; default: the only one that was swept beside the method");
  command.add(
      "--measure", "MEASURE", options->measure,
      "colour by a measure, such as deflection or deflection.error, or by a column of results.csv; default: "
      "by the verdict");
  options->declare_json(command);
  command.add_flag("--markdown", options->markdown,
                   "print the map as a Markdown table; --out may be left out");
  return [options](Streams streams) { return map(*options, streams); };
}

}  // namespace taut::cli
