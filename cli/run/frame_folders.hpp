#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/image/image_difference.hpp"

namespace taut::cli {

class Options;
class Json;
struct TestCase;

/// Sorted PNG files; none for a missing folder.
std::vector<std::string> picture_names(const std::filesystem::path& folder);

/// Frames of a run folder, else `folder`.
std::filesystem::path frames_of(const std::filesystem::path& folder);

struct PictureDifference {
  std::string name;
  render::ImageDifference difference;
  bool alike = false;
};

struct FolderDifference {
  std::vector<std::string> only_in_a, only_in_b;
  std::vector<PictureDifference> pictures;
  std::string worst;
  render::ImageDifference at_worst;

  int different() const;
  bool alike() const { return only_in_a.empty() && only_in_b.empty() && different() == 0; }
};

/// Throws UsageError for unreadable pictures or different sizes.
FolderDifference compare_folders(const std::filesystem::path& a, const std::filesystem::path& b,
                                 const render::DifferenceLimit& limit);

/// True if the pictures are alike, but a pixel differs by more than `warn` [ΔE*ab].
bool warns(const PictureDifference& picture, std::optional<double> warn);
int number_of_warnings(const FolderDifference& difference, std::optional<double> warn);

struct DifferenceOptions {
  std::optional<double> max_difference;  // ΔE*ab
};

void declare_difference_options(Options& command, DifferenceOptions& options);
render::DifferenceLimit limit_of(const DifferenceOptions& options);

std::string difference_report(const render::ImageDifference& difference,
                              const render::DifferenceLimit& limit);
std::string difference_report(const FolderDifference& difference, const std::string& a, const std::string& b);

Json pictures_json(const FolderDifference& difference);
std::vector<TestCase> test_cases(const FolderDifference& difference, const std::string& a,
                                 const std::string& b);

}  // namespace taut::cli
