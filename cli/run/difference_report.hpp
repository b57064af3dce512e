#pragma once

#include <optional>
#include <string>

#include "cli/run/frame_folders.hpp"
#include "render/image/image_difference.hpp"

namespace CLI {
class App;
}

namespace taut::cli {

/// --max-difference as typed.
struct DifferenceOptions {
  std::optional<double> max_difference;  // ΔE*ab
};

void declare_difference_options(CLI::App& app, DifferenceOptions& options);
render::DifferenceLimit limit_of(const DifferenceOptions& options);

/// What `diff` and `snapshot` print: "alike" or "different" in the first line, then the numbers.
std::string difference_report(const render::ImageDifference& difference,
                              const render::DifferenceLimit& limit);
/// `a` and `b`: what the folders are called in it.
std::string difference_report(const FolderDifference& difference, const std::string& a, const std::string& b);

}  // namespace taut::cli
