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

/// The PNG files in a folder, by name, sorted; none if there is no such folder.
std::vector<std::string> picture_names(const std::filesystem::path& folder);

/// Where the pictures of `folder` are: the frames of a run folder, else the folder itself.
std::filesystem::path frames_of(const std::filesystem::path& folder);

/// Comparison of two pictures of one name.
struct PictureDifference {
  std::string name;
  render::ImageDifference difference;
  bool alike = false;
};

/// How the pictures of two folders differ, name by name.
struct FolderDifference {
  std::vector<std::string> only_in_a, only_in_b;
  std::vector<PictureDifference> pictures;  // in both folders
  std::string worst;                        // the most different of these, empty if there are none
  render::ImageDifference at_worst;

  int different() const;  // number of `pictures`
  /// The same names, and every picture alike.
  bool alike() const { return only_in_a.empty() && only_in_b.empty() && different() == 0; }
};

/// UsageError for a picture that cannot be read, or that differs in size.
FolderDifference compare_folders(const std::filesystem::path& a, const std::filesystem::path& b,
                                 const render::DifferenceLimit& limit);

/// --max-difference as typed.
struct DifferenceOptions {
  std::optional<double> max_difference;  // ΔE*ab
};

void declare_difference_options(Options& command, DifferenceOptions& options);
render::DifferenceLimit limit_of(const DifferenceOptions& options);

/// What `diff` and `snapshot` print: "alike" or "different" in the first line, then the numbers.
std::string difference_report(const render::ImageDifference& difference,
                              const render::DifferenceLimit& limit);
/// `a` and `b`: what the folders are called in it.
std::string difference_report(const FolderDifference& difference, const std::string& a, const std::string& b);

/// One object per picture, as `diff --json` and `snapshot --json` list them.
Json pictures_json(const FolderDifference& difference);
/// One test case per picture.
std::vector<TestCase> test_cases(const FolderDifference& difference, const std::string& a,
                                 const std::string& b);

}  // namespace taut::cli
