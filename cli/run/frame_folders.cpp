#include "cli/run/frame_folders.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/core.h>

#include "cli/arguments/options.hpp"
#include "cli/run/folder.hpp"
#include "cli/text/checks.hpp"
#include "cli/text/format.hpp"
#include "cli/text/json.hpp"
#include "cli/text/test_report.hpp"
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
    throw UsageError(fmt::format("{} and {}: {}", a.string(), b.string(), e.what()));
  }
}

using Rows = std::vector<std::vector<std::string>>;

Rows rows_of(const render::ImageDifference& d) {
  return {{"pixels that differ visibly", percent(d.share)},
          {"greatest difference", fmt::format("{} (ΔE*ab; black and white differ by 100, the eye notices {})",
                                              brief(d.greatest), brief(render::just_noticeable))},
          {"densest window", fmt::format("{} of {}x{} pixels at {},{}", percent(d.densest), d.width, d.height,
                                         d.column, d.row)}};
}

std::string verdict(bool same) { return same ? "alike\n" : "different\n"; }

std::string some_of(const std::vector<std::string>& names) {
  constexpr std::size_t shown = 3;
  std::vector<std::string> first = names;
  first.resize(std::min(shown, names.size()));
  return join(first) + (names.size() > shown ? fmt::format(" and {} more", names.size() - shown) : "");
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

int FolderDifference::different() const {
  return static_cast<int>(std::ranges::count(pictures, false, &PictureDifference::alike));
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
    result.pictures.push_back({name, difference, alike(difference, limit)});
    if (result.worst.empty() || excess(difference, limit) > excess(result.at_worst, limit)) {
      result.worst = name;
      result.at_worst = difference;
    }
  }
  return result;
}

bool warns(const PictureDifference& picture, std::optional<double> warn) {
  return picture.alike && warn && picture.difference.greatest > *warn;
}

int number_of_warnings(const FolderDifference& difference, std::optional<double> warn) {
  return static_cast<int>(
      std::ranges::count_if(difference.pictures, [&](const PictureDifference& p) { return warns(p, warn); }));
}

void declare_difference_options(Options& command, DifferenceOptions& options) {
  command
      .add("--max-difference", "X", options.max_difference,
           "largest allowed difference of a pixel (ΔE*ab; black and white differ by 100; 0: identical); "
           "default: few pixels may differ visibly, if they are not close together")
      .check(not_negative_number);
}

render::DifferenceLimit limit_of(const DifferenceOptions& options) {
  if (!options.max_difference) return {};
  return {.share = 1, .densest = 1, .greatest = *options.max_difference};
}

std::string difference_report(const render::ImageDifference& difference,
                              const render::DifferenceLimit& limit) {
  return verdict(alike(difference, limit)) + in_columns(rows_of(difference));
}

std::string difference_report(const FolderDifference& d, const std::string& a, const std::string& b) {
  Rows rows{{"pictures compared", std::to_string(d.pictures.size())},
            {"different", std::to_string(d.different())}};
  if (!d.only_in_a.empty()) rows.push_back({"only in " + a, some_of(d.only_in_a)});
  if (!d.only_in_b.empty()) rows.push_back({"only in " + b, some_of(d.only_in_b)});
  if (d.at_worst.greatest > 0) {
    rows.push_back({"worst", d.worst});
    const Rows worst = rows_of(d.at_worst);
    rows.insert(rows.end(), worst.begin(), worst.end());
  }
  return verdict(d.alike()) + in_columns(rows);
}

Json pictures_json(const FolderDifference& difference) {
  Json all = Json::array();
  for (const auto& [name, d, same] : difference.pictures)
    all.add(
        {{"name", name},
         {"passed", same},
         {"share", d.share},
         {"greatest", d.greatest},
         {"densest", d.densest},
         {"window", Json{{"column", d.column}, {"row", d.row}, {"width", d.width}, {"height", d.height}}}});
  for (const std::string& name : difference.only_in_a)
    all.add({{"name", name}, {"passed", false}, {"only_in", "a"}});
  for (const std::string& name : difference.only_in_b)
    all.add({{"name", name}, {"passed", false}, {"only_in", "b"}});
  return all;
}

std::vector<TestCase> test_cases(const FolderDifference& difference, const std::string& a,
                                 const std::string& b) {
  std::vector<TestCase> all;
  const auto add = [&all](const std::string& name, bool passed, const std::string& text) {
    all.push_back({name, passed ? TestCase::Result::passed : TestCase::Result::failed, text});
  };
  for (const auto& [name, d, same] : difference.pictures)
    add(name, same,
        fmt::format("{}: {} of the pixels differ visibly, the greatest difference is {} (ΔE*ab)", name,
                    percent(d.share), brief(d.greatest)));
  for (const std::string& name : difference.only_in_a)
    add(name, false, fmt::format("{} is only in {}", name, a));
  for (const std::string& name : difference.only_in_b)
    add(name, false, fmt::format("{} is only in {}", name, b));
  return all;
}

}  // namespace taut::cli
