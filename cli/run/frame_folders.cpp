#include "cli/run/frame_folders.hpp"

#include <algorithm>
#include <iterator>

#include "cli/run/folder.hpp"
#include "engine/error.hpp"
#include "render/image/png.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

render::ImageDifference compare_files(const fs::path& a, const fs::path& b) {
  const render::Image image_a = render::read_png(a);
  const render::Image image_b = render::read_png(b);
  try {
    return compare(image_a, image_b);
  } catch (const UsageError& e) {
    throw UsageError(a.string() + " and " + b.string() + ": " + e.what());
  }
}

}  // namespace

std::vector<std::string> picture_names(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
    if (entry.path().extension() == ".png") names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

fs::path frames_of(const fs::path& folder) {
  const RunFolder run(folder);
  std::error_code error;
  return fs::exists(run.record(), error) ? run.frames() : folder;
}

FolderDifference compare_folders(const fs::path& a, const fs::path& b, const render::DifferenceLimit& limit) {
  const std::vector<std::string> names_a = picture_names(a);
  const std::vector<std::string> names_b = picture_names(b);
  FolderDifference result;
  std::ranges::set_difference(names_a, names_b, std::back_inserter(result.only_in_a));
  std::ranges::set_difference(names_b, names_a, std::back_inserter(result.only_in_b));
  std::vector<std::string> both;
  std::ranges::set_intersection(names_a, names_b, std::back_inserter(both));
  for (const std::string& name : both) {
    const render::ImageDifference difference = compare_files(a / name, b / name);
    ++result.compared;
    if (!alike(difference, limit)) ++result.different;
    if (result.worst.empty() || excess(difference, limit) > excess(result.at_worst, limit)) {
      result.worst = name;
      result.at_worst = difference;
    }
  }
  return result;
}

}  // namespace taut::cli
