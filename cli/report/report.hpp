#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/image/image_difference.hpp"

namespace taut::cli {

/// Content of a page.
enum class PageKind { run, runs, sweep, difference, suite };
std::string_view name(PageKind kind);

struct ReportRequest {
  std::vector<std::string>
      paths;  // run folders, or sweeps; one suite; with a baseline one folder with pictures
  std::optional<std::string> out;       // folder, or with `embed` file
  std::optional<std::string> baseline;  // folder with the expected pictures
  render::DifferenceLimit limit{};      // with a baseline
  bool embed = false;                   // one file with everything in it
};

struct WrittenPage {
  PageKind kind;
  std::filesystem::path file;  // to open
  std::size_t runs = 0;
  bool running = false;  // a run has not ended
};

/// Throws UsageError for paths that are not results of one kind and for an `out` that is not a page; OutputError.
WrittenPage write_report(const ReportRequest& request);

}  // namespace taut::cli
