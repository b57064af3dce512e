#include <CLI/CLI.hpp>

#include "cli/command.hpp"
#include "cli/study.hpp"

namespace taut {
namespace {

struct Options {
  std::vector<std::string> results;
  std::string out, parameter;
};

}  // namespace

std::function<int(Streams)> declare_map(CLI::App& app) {
  auto options = std::make_shared<Options>();
  app.add_option("RESULTS.csv", options->results,
                 "results.csv of sweeps of one scene, or the sweeps' folders")
      ->option_text(" ")
      ->required();
  app.add_option("--out", options->out, "the picture; its .gp and .dat stand beside it")
      ->option_text("map.png|map.svg")
      ->required();
  app.add_option("--parameter", options->parameter,
                 "what stands on the x axis; default: the one name that was swept beside the method")
      ->option_text("PARAMETER");
  return [options](Streams streams) {
    return draw_map(options->results, {options->parameter}, plot_files(options->out), streams);
  };
}

}  // namespace taut
