#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace taut::cli {

/// What every picture of stored results asks for.
struct PictureOptions {
  std::vector<std::string> results;
  std::string out;

  /// `formats`: what a picture may be called, such as "chart.png|chart.svg"
  void declare(CLI::App& app, const std::string& formats, bool needed = true) {
    app.add_option("RESULTS.csv", results, "results.csv of sweeps of one scene, or the sweeps' folders")
        ->option_text(" ")
        ->required();
    app.add_option("--out", out, "the picture; its .gp and .dat stand beside it")
        ->option_text(formats)
        ->required(needed);
  }
};

/// For commands that judge runs by one measure.
inline void declare_measure(CLI::App& app, std::string& measure) {
  app.add_option("--measure", measure,
                 "whose error; default: the one that most runs have, "
                 "names in _time and errors with a unit last")
      ->option_text("MEASURE");
}

}  // namespace taut::cli
