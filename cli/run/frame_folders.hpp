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

/// Sorted names of the PNG files in a folder; none if it does not exist.
std::vector<std::string> picture_names(const std::filesystem::path& folder);

/// Folder of the pictures: the frames of a run folder, else `folder` itself.
std::filesystem::path frames_of(const std::filesystem::path& folder);

/// Comparison of two pictures with the same name.
struct PictureDifference {
  std::string name;
  render::ImageDifference difference;
  bool alike = false;
};

/// Differences of the pictures of two folders, by name.
struct FolderDifference {
  std::vector<std::string> only_in_a, only_in_b;
  std::vector<PictureDifference> pictures;  // in both folders
  std::string worst;                        // name of the most different picture, empty if none
  render::ImageDifference at_worst;

  int different() const;  // number of `pictures`
  /// Whether names and pictures agree.
  bool alike() const { return only_in_a.empty() && only_in_b.empty() && different() == 0; }
};

/// Throws UsageError for an unreadable picture or different sizes.
FolderDifference compare_folders(const std::filesystem::path& a, const std::filesystem::path& b,
                                 const render::DifferenceLimit& limit);

struct DifferenceOptions {
  std::optional<double> max_difference;  // ΔE*ab
};

void declare_difference_options(Options& command, DifferenceOptions& options);
render::DifferenceLimit limit_of(const DifferenceOptions& options);

/// Text of `diff` and `snapshot`: "alike" or "different", then the numbers.
std::string difference_report(const render::ImageDifference& difference,
                              const render::DifferenceLimit& limit);
/// `a` and `b`: names of the folders in the text.
std::string difference_report(const FolderDifference& difference, const std::string& a, const std::string& b);

/// One object per picture, for `--json`.
Json pictures_json(const FolderDifference& difference);
/// One test case per picture.
std::vector<TestCase> test_cases(const FolderDifference& difference, const std::string& a,
                                 const std::string& b);

}  // namespace taut::cli
