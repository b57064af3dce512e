#include <ostream>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/commands/picture_options.hpp"
#include "cli/study/study.hpp"
#include "cli/system/exit_code.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

struct MapArguments : PictureOptions {
  std::string parameter;
  bool markdown = false;
};

int map(const MapArguments& options, Streams streams) {
  const MapRequest request{options.parameter};
  if (options.out.empty() && !options.markdown) throw UsageError("give --out PICTURE or --markdown");
  if (options.markdown) streams.out << markdown(make_map(read_results(options.results), request));
  if (options.out.empty()) return exit_fine;
  std::ostream nowhere(nullptr);  // stdout holds the Markdown table alone
  return draw_map(options.results, request, plot_files(options.out),
                  options.markdown ? Streams{nowhere, streams.err} : streams);
}

}  // namespace

std::function<int(Streams)> declare_map(Options& command) {
  auto options = std::make_shared<MapArguments>();
  options->declare(command, "map.png|map.svg", /*needed=*/false);
  command.add("--parameter", "PARAMETER", options->parameter,
              "parameter on the x axis; default: the only one that was swept beside the method");
  command.add_flag("--markdown", options->markdown,
                   "print the map as a Markdown table; --out may be left out");
  return [options](Streams streams) { return map(*options, streams); };
}

}  // namespace taut::cli
