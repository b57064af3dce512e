#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/image/image_difference.hpp"

namespace taut::cli {

enum class PageKind { run, runs, sweep, difference };
std::string_view name(PageKind kind);

struct ReportRequest {
  std::vector<std::string> paths;       // runs or sweeps; with a baseline, one folder of pictures
  std::optional<std::string> out;       // folder; file with `embed`
  std::optional<std::string> baseline;  // expected pictures
  render::DifferenceLimit limit{};
  bool embed = false;  // one file
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
