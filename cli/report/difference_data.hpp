#pragma once

#include <filesystem>

#include "cli/report/links.hpp"
#include "cli/text/json.hpp"
#include "render/image/image_difference.hpp"

namespace taut::cli {

struct Compared {
  std::filesystem::path expected, got;
  render::DifferenceLimit limit;
};

/// Differences for a page, greatest first, with pictures in `folder`. Throws UsageError for folders without
/// pictures, OutputError.
Json difference_data(const Compared& compared, const std::filesystem::path& folder, const Links& links);

}  // namespace taut::cli
