#include "cli/text/suggest.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include <fmt/core.h>

#include "cli/text/format.hpp"

namespace taut::cli {
namespace {

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower;
}

/// Least number of insertions, deletions, replacements and swaps of neighbours.
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

using Ranked = std::vector<std::pair<std::size_t, std::string>>;
Ranked ranked(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string given = lower_case(name);
  Ranked all;
  for (const std::string& candidate : candidates) {
    if (std::ranges::find(all, candidate, &Ranked::value_type::second) == all.end())
      all.emplace_back(edit_distance(given, lower_case(candidate)), candidate);
  }
  std::ranges::stable_sort(all, {}, &Ranked::value_type::first);
  return all;
}

constexpr std::size_t most_names = 5, most_listed = 8, most_letters = 100;

}  // namespace

std::vector<std::string> nearest(std::string_view name, const std::vector<std::string>& candidates) {
  constexpr std::size_t least_part = 3;
  if (name.empty() || name.size() > most_letters) return {};
  const std::size_t most_edits = name.size() == 1 ? 0 : std::max<std::size_t>(1, name.size() / 3);
  const std::string given = lower_case(name);
  std::vector<std::string> names;
  for (const auto& [edits, candidate] : ranked(name, candidates)) {
    const bool part = given.size() >= least_part && lower_case(candidate).find(given) != std::string::npos;
    if (names.size() < most_names && (edits <= most_edits || part)) names.push_back(candidate);
  }
  return names;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates) {
  const std::vector<std::string> names = nearest(name, candidates);
  if (names.empty()) return "";
  std::string text = " (did you mean ";
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += fmt::format("'{}'", names[i]);
  }
  return text + "?)";
}

std::string unknown_name(std::string_view kind, std::string_view given,
                         const std::vector<std::string>& names) {
  return fmt::format("unknown {} '{}'{}", kind, given, known_names(given, names));
}

std::string known_names(std::string_view given, const std::vector<std::string>& names) {
  if (names.empty()) return "; there is none";
  const std::string near = did_you_mean(given, names);
  if (names.size() <= most_listed) return fmt::format("{}; there are: {}", near, join(names));
  if (!near.empty()) return near;
  std::vector<std::string> few;
  for (const auto& [edits, name] : ranked(given.substr(0, most_letters), names))
    if (few.size() < most_names) few.push_back(name);
  return fmt::format("; the nearest of {} names: {}", names.size(), join(few));
}

}  // namespace taut::cli
