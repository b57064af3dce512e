#include "cli/text/suggest.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include "cli/text/format.hpp"

namespace taut::cli {
namespace {

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower;
}

/// Insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = std::exchange(last, row);
  }
  return last[b.size()];
}

}  // namespace

std::vector<std::string> nearest(std::string_view name, const std::vector<std::string>& candidates) {
  constexpr std::size_t most_names = 3, least_part = 3, most_letters = 100;
  if (name.empty() || name.size() > most_letters) return {};
  // a third of the letters may be wrong; of two letters one, of one letter only its case
  const std::size_t most_edits = name.size() == 1 ? 0 : std::max<std::size_t>(1, name.size() / 3);
  const std::string given = lower_case(name);
  std::vector<std::pair<std::size_t, std::string>> near;
  for (const std::string& candidate : candidates) {
    const std::string other = lower_case(candidate);
    const std::size_t edits = edit_distance(given, other);
    const bool part = given.size() >= least_part && other.find(given) != std::string::npos;
    if (edits <= most_edits || part) near.emplace_back(edits, candidate);
  }
  std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(most_names, near.size()); ++i) names.push_back(near[i].second);
  return names;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates) {
  const std::vector<std::string> names = nearest(name, candidates);
  if (names.empty()) return "";
  std::string text = " (did you mean ";
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += "'" + names[i] + "'";
  }
  return text + "?)";
}

std::string unknown_name(std::string_view kind, std::string_view given,
                         const std::vector<std::string>& names) {
  const std::string near = did_you_mean(given, names);
  return "unknown " + std::string(kind) + " '" + std::string(given) + "'" +
         (near.empty() ? "; there are: " + join(names) : near);
}

}  // namespace taut::cli
