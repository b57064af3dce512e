#pragma once

#include <filesystem>
#include <optional>

#include "cli/report/links.hpp"
#include "cli/text/json.hpp"
#include "render/image/image_difference.hpp"

namespace taut::cli {

/// Folders of pictures to compare, run folders or not.
struct Compared {
  std::filesystem::path expected, got;
  render::DifferenceLimit limit;
  std::optional<double> warn{};  // ΔE*ab; see warns()
};

/// The data of a comparison that a page shows, most different picture first. Writes a picture of the differences into
/// `folder` for each pair that differs. Throws UsageError for folders without pictures, OutputError.
Json difference_data(const Compared& compared, const std::filesystem::path& folder, const Links& links);

}  // namespace taut::cli
