#include <CLI/CLI.hpp>

#include "cli/command_line/command.hpp"
#include "cli/commands/picture_options.hpp"
#include "cli/study/study.hpp"
#include "cli/text/format.hpp"

namespace taut::cli {
namespace {

struct Options : PictureOptions {
  std::string measure, cost = cost_names().front();
};

int chart(const Options& options, Streams streams) {
  const PlotFiles files = plot_files(options.out);
  return draw_chart(options.results, {options.measure, find_cost(options.cost)}, files, streams);
}

}  // namespace

std::function<int(Streams)> declare_chart(CLI::App& app) {
  auto options = std::make_shared<Options>();
  options->declare(app, "chart.png|chart.svg");
  declare_measure(app, options->measure);
  app.add_option("--cost", options->cost, "seconds of solving, or particles × steps; default: seconds")
      ->option_text(join(cost_names(), "|"));
  return [options](Streams streams) { return chart(*options, streams); };
}

}  // namespace taut::cli
