#include "cli/sweep/grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>

#include <fmt/core.h>

#include "cli/scene/expression.hpp"
#include "cli/text/checks.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

constexpr std::size_t most_runs = 10'000;

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char c : text) {
    depth += (c == '(') - (c == ')');
    if (c == separator && depth == 0)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

double end_of_range(const std::string& part, const std::string& range) {
  double value = NAN;
  try {
    value = evaluate(part, {});
  } catch (const ExpressionError&) {
    // reported below
  }
  if (!std::isfinite(value))
    throw UsageError(fmt::format("'{}' is not a range lo:hi:step: '{}' is not a number", range, part));
  return value;
}

std::string without_round_off(double value, double greatest) {
  if (std::abs(value) < 1e-12 * greatest) return "0";
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), "%.12g", value);
  return canonical_value(digits.data());
}

std::vector<std::string> parse_range(const std::string& text) {
  const std::vector<std::string> parts = split(text, ':');
  if (parts.size() != 3) throw UsageError(fmt::format("'{}' is not a range lo:hi:step", text));
  const double low = end_of_range(parts[0], text), high = end_of_range(parts[1], text),
               step = end_of_range(parts[2], text);
  const double steps = (high - low) / step;
  if (!(steps >= 0) || step == 0)
    throw UsageError(fmt::format("'{}': a step of {} does not lead from {} to {}", text, exact(step),
                                 exact(low), exact(high)));
  if (!(steps < static_cast<double>(most_runs)))
    throw UsageError(fmt::format("'{}' has more than {} values", text, most_runs));
  const double greatest = std::max(std::abs(low), std::abs(high));
  const double whole = std::round(steps);
  if (std::abs(steps - whole) > 1e-6)
    throw UsageError(fmt::format("'{}': the step does not divide the range; it could end at {} or {}", text,
                                 without_round_off(low + std::floor(steps) * step, greatest),
                                 without_round_off(low + std::ceil(steps) * step, greatest)));
  std::vector<std::string> values;
  for (int k = 0; k <= static_cast<int>(whole); ++k)
    values.push_back(without_round_off(low + k * step, greatest));
  return values;
}

std::string short_hash(const std::string& text) {
  std::array<char, 24> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(hash_of(text)));
  return digits.data();
}

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view(".=_+-").find(c) != std::string_view::npos;
}

std::string joined(const GridRow& row, std::string_view between) {
  std::vector<std::string> parts;
  for (const Setting& s : row) parts.push_back(text_of(s));
  return join(parts, between);
}

}  // namespace

std::string canonical_value(const std::string& text) {
  std::string plain = trimmed(text);
  const auto value = parsed<double>(plain);
  return value && std::isfinite(*value) ? exact(*value) : plain;
}

std::vector<std::string> parse_values(const std::string& text) {
  std::vector<std::string> values;
  for (const std::string& part : split(text, ',')) {
    // a ? b : c is an expression, not a range
    const bool is_range = part.find(':') != std::string::npos && part.find('?') == std::string::npos;
    const std::vector<std::string> more =
        is_range ? parse_range(part) : std::vector<std::string>{canonical_value(part)};
    values.insert(values.end(), more.begin(), more.end());
  }
  std::set<std::string> seen;
  for (const std::string& value : values) {
    if (value.empty()) throw UsageError(fmt::format("'{}' has an empty value", text));
    if (!seen.insert(value).second) throw UsageError(fmt::format("'{}' has the value {} twice", text, value));
  }
  return values;
}

Axis parse_axis(const std::string& text) {
  if (const std::string wrong = assignment(text); !wrong.empty()) throw UsageError(wrong);
  const std::size_t at = text.find('=');
  Axis axis{trimmed(text.substr(0, at)), {}};
  for (const std::string& value : parse_values(text.substr(at + 1)))
    axis.values.push_back({axis.name, value, {}});
  return axis;
}

std::vector<GridRow> all_combinations(const std::vector<Axis>& axes) {
  std::vector<GridRow> rows(1);
  std::set<std::string> seen;
  for (const Axis& axis : axes) {
    if (!seen.insert(axis.name).second)
      throw UsageError(fmt::format("the grid has '{}' twice; give all its values together", axis.name));
    if (rows.size() * axis.values.size() > most_runs)
      throw UsageError(fmt::format("the grid has more than {} runs; make it smaller", most_runs));
    std::vector<GridRow> longer;
    for (const GridRow& row : rows)
      for (const Setting& value : axis.values) {
        longer.push_back(row);
        longer.back().push_back(value);
      }
    rows = std::move(longer);
  }
  return rows;
}

void check_rows(const std::vector<GridRow>& rows) {
  if (rows.size() > most_runs)
    throw UsageError(fmt::format("there are more than {} runs; make several sweeps", most_runs));
  std::set<std::string> seen;
  for (const GridRow& row : rows)
    if (!seen.insert(folder_name(row)).second)
      throw UsageError(fmt::format("the run {} is listed twice", text_of(row)));
}

std::string folder_name(const GridRow& row) {
  constexpr std::size_t longest = 100, kept = 80;
  if (row.empty()) return "as-it-stands";
  const std::string whole = joined(row, "_");
  std::string name = whole;
  std::ranges::replace_if(
      name, [](char c) { return !is_plain(c); }, '-');
  if (name == whole && name.size() <= longest) return name;
  return fmt::format("{}_{}", name.substr(0, kept), short_hash(whole));
}

std::string text_of(const GridRow& row) { return joined(row, ", "); }

}  // namespace taut::cli
