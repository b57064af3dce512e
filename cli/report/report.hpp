#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/image/image_difference.hpp"

namespace taut::cli {

enum class PageKind { run, runs, sweep, difference, suite };
std::string_view name(PageKind kind);

struct ReportRequest {
  std::vector<std::string> paths;  // run folders, sweeps, one suite, or one folder with pictures
  std::optional<std::string> out;  // folder or file
  std::optional<std::string> baseline;
  render::DifferenceLimit limit{};  // with a baseline
  bool embed = false;
};

struct WrittenPage {
  PageKind kind;
  std::filesystem::path file;
  std::size_t runs = 0;
  bool running = false;
};

/// Throws UsageError and OutputError.
WrittenPage write_report(const ReportRequest& request);

}  // namespace taut::cli
