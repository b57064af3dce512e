#include <CLI/CLI.hpp>

#include "cli/command_line/command.hpp"
#include "cli/commands/picture_options.hpp"
#include "cli/study/study.hpp"

namespace taut::cli {
namespace {

struct MapArguments : PictureOptions {
  std::string parameter;
};

}  // namespace

std::function<int(Streams)> declare_map(CLI::App& app) {
  auto options = std::make_shared<MapArguments>();
  options->declare(app, "map.png|map.svg");
  app.add_option("--parameter", options->parameter,
                 "what stands on the x axis; default: the one name that was swept beside the method")
      ->option_text("PARAMETER");
  return [options](Streams streams) {
    return draw_map(options->results, {options->parameter}, plot_files(options->out), streams);
  };
}

}  // namespace taut::cli
