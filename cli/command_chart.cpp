#include <ostream>

#include <CLI/CLI.hpp>

#include "cli/chart_drawing.hpp"
#include "cli/command.hpp"
#include "cli/exit_code.hpp"
#include "cli/study.hpp"
#include "cli/text.hpp"

namespace taut {
namespace {

struct Options {
  std::vector<std::string> results;
  std::string out, measure, cost = cost_names().front();
};

int chart(const Options& options, Streams streams) {
  const PlotFiles files = plot_files(options.out);
  return draw_chart(options.results, {options.measure, find_cost(options.cost)}, files, streams);
}

}  // namespace

std::function<int(Streams)> declare_chart(CLI::App& app) {
  auto options = std::make_shared<Options>();
  app.add_option("RESULTS.csv", options->results,
                 "results.csv of sweeps of one scene, or the sweeps' folders")
      ->option_text(" ")
      ->required();
  app.add_option("--out", options->out, "the picture; its .gp and .dat stand beside it")
      ->option_text("chart.png|chart.svg")
      ->required();
  app.add_option("--measure", options->measure,
                 "whose error; default: the scene's first that has a reference")
      ->option_text("MEASURE");
  app.add_option("--cost", options->cost, "seconds of solving, or particles × steps; default: seconds")
      ->option_text(join(cost_names(), "|"));
  return [options](Streams streams) { return chart(*options, streams); };
}

}  // namespace taut
