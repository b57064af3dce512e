#pragma once

#include <filesystem>
#include <optional>

#include "cli/report/links.hpp"
#include "cli/text/json.hpp"
#include "render/image/image_difference.hpp"

namespace taut::cli {

struct Compared {
  std::filesystem::path expected, got;
  render::DifferenceLimit limit;
  std::optional<double> warn{};  // ΔE*ab; see warns()
};

/// Sorts the pictures by falling excess over the limit. Writes difference pictures. Throws UsageError and OutputError.
Json difference_data(const Compared& compared, const std::filesystem::path& folder, const Links& links);

}  // namespace taut::cli
