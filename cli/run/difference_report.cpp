#include "cli/run/difference_report.hpp"

#include <CLI/CLI.hpp>

#include "cli/text/checks.hpp"
#include "cli/text/format.hpp"

namespace taut::cli {
namespace {

using Rows = std::vector<std::vector<std::string>>;

Rows rows_of(const render::ImageDifference& d) {
  return {{"pixels that differ visibly", percent(d.share)},
          {"greatest difference",
           brief(d.greatest) + " of 100 (ΔE*ab; an eye notices " + brief(render::just_noticeable) + ")"},
          {"densest window", percent(d.densest) + " of " + std::to_string(d.width) + "x" +
                                 std::to_string(d.height) + " pixels at " + std::to_string(d.column) + "," +
                                 std::to_string(d.row)}};
}

std::string verdict(bool same) { return same ? "alike\n" : "different\n"; }

/// The first names, and how many more there are.
std::string some_of(const std::vector<std::string>& names) {
  constexpr std::size_t shown = 3;
  std::vector<std::string> first = names;
  first.resize(std::min(shown, names.size()));
  return join(first) + (names.size() > shown ? " and " + std::to_string(names.size() - shown) + " more" : "");
}

}  // namespace

void declare_difference_options(CLI::App& app, DifferenceOptions& options) {
  app.add_option(
         "--max-difference", options.max_difference,
         "alike when no pixel differs by more (ΔE*ab, black to white is 100; 0: every pixel is the same); "
         "default: alike when hardly a pixel differs visibly and nowhere many together")
      ->option_text("X")
      ->check(not_negative_number);
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
  Rows rows{{"pictures compared", std::to_string(d.compared)}, {"different", std::to_string(d.different)}};
  if (!d.only_in_a.empty()) rows.push_back({"only in " + a, some_of(d.only_in_a)});
  if (!d.only_in_b.empty()) rows.push_back({"only in " + b, some_of(d.only_in_b)});
  if (d.at_worst.greatest > 0) {
    rows.push_back({"worst", d.worst});
    const Rows worst = rows_of(d.at_worst);
    rows.insert(rows.end(), worst.begin(), worst.end());
  }
  return verdict(d.alike()) + in_columns(rows);
}

}  // namespace taut::cli
