#pragma once

#include <string>
#include <vector>

#include "cli/arguments/options.hpp"

namespace taut::cli {

struct PictureOptions {
  std::vector<std::string> results;
  std::string out;

  /// `formats`: "chart.png|chart.svg".
  void declare(Options& command, const std::string& formats, bool needed = true) {
    command
        .add_argument("RESULTS.csv", results,
                      "results.csv files of sweeps of one scene, or the folders of these sweeps")
        .required();
    command
        .add("--out", formats, out,
             "picture to write; the gnuplot script (.gp) and its data (.dat) are written beside it")
        .required(needed);
  }
};

inline void declare_measure(Options& command, std::string& measure) {
  command.add("--measure", "MEASURE", measure,
              "measure whose error is used; default: the one with an error in most runs; "
              "measures named ..._time or with errors in a unit are chosen last");
}

}  // namespace taut::cli
