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
    app.add_option("RESULTS.csv", results,
                   "results.csv files of sweeps of one scene, or the folders of these sweeps")
        ->option_text(" ")
        ->required();
    app.add_option("--out", out,
                   "picture to write; the gnuplot script (.gp) and its data (.dat) are written beside it")
        ->option_text(formats)
        ->required(needed);
  }
};

/// For commands that judge runs by one measure.
inline void declare_measure(CLI::App& app, std::string& measure) {
  app.add_option("--measure", measure,
                 "measure whose error is used; default: the measure with errors of the most runs, "
                 "where names that end in _time and errors with a unit come last")
      ->option_text("MEASURE");
}

}  // namespace taut::cli
