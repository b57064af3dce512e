#include "cli/claims/criterion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <regex>
#include <utility>

#include <fmt/core.h>

#include "cli/scene/expression.hpp"
#include "cli/study/csv.hpp"
#include "cli/study/expectation.hpp"
#include "cli/study/stored_results.hpp"
#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"
#include "engine/judge/verdict.hpp"

namespace taut::cli {
namespace {

constexpr std::array kinds_of_history{"first", "last", "min", "max"};

const std::regex& dotted_name() {
  static const std::regex name(R"([A-Za-z_]\w*(\.[A-Za-z_]\w*)+)");
  return name;
}

/// muParser allows no dots in names. Different names stay different: "a_b.c" becomes "a_0b__c".
std::string without_dots(const std::string& name) {
  return std::regex_replace(std::regex_replace(name, std::regex("_"), "_0"), std::regex("\\."), "__");
}
std::string with_dots(const std::string& name) {
  return std::regex_replace(std::regex_replace(name, std::regex("__"), "."), std::regex("_0"), "_");
}

double result_of(const std::string& criterion, const std::map<std::string, double>& values) {
  Names names;
  for (const std::string& verdict : names_of_verdicts())
    names[verdict] = static_cast<double>(*find_verdict(verdict));
  std::string text;
  auto rest = criterion.cbegin();
  for (std::sregex_iterator found(rest, criterion.end(), dotted_name()), end; found != end; ++found) {
    const std::string name = without_dots((*found)[0]);
    text.append(rest, (*found)[0].first).append(name);
    rest = (*found)[0].second;
    names[name] = values.at((*found)[0]);
  }
  text.append(rest, criterion.end());
  try {
    return evaluate(text, names);
  } catch (const ExpressionError& error) {
    throw UsageError(with_dots(error.what()));
  }
}

/// "since.fractured" → "fractured" for "since", else "".
std::string behind(const std::string& path, const std::string& kind) {
  return path.starts_with(kind + ".") ? path.substr(kind.size() + 1) : "";
}

QuantityValue value_of_history(const std::string& folder, const std::string& kind,
                               const std::string& column) {
  const CsvTable table = read_csv(folder + "/history.csv");
  const auto found = std::ranges::find(table.columns, column);
  if (found == table.columns.end()) throw UsageError(unknown_name("history column", column, table.columns));
  std::vector<double> values;
  for (const auto& row : table.rows)
    values.push_back(parsed<double>(row[static_cast<std::size_t>(found - table.columns.begin())])
                         .value_or(std::numeric_limits<double>::quiet_NaN()));
  if (values.empty()) throw UsageError("history.csv has no rows");
  const auto nan = std::ranges::find_if(values, [](double value) { return std::isnan(value); });
  const double value = kind == "first"       ? values.front()
                       : kind == "last"      ? values.back()
                       : nan != values.end() ? *nan
                       : kind == "min"       ? *std::ranges::min_element(values)
                                             : *std::ranges::max_element(values);
  if (!std::isfinite(value)) throw UsageError(fmt::format("{}.{} is not finite", kind, column));
  return {value, six_digits(value)};
}

}  // namespace

std::vector<Quantity> quantities_in(const std::string& criterion) {
  std::vector<Quantity> all;
  for (std::sregex_iterator found(criterion.begin(), criterion.end(), dotted_name()), end; found != end;
       ++found) {
    const std::string name = (*found)[0];
    const std::size_t dot = name.find('.');
    if (std::ranges::find(all, name, &Quantity::name) == all.end())
      all.push_back({name.substr(0, dot), name.substr(dot + 1)});
  }
  return all;
}

void check_criterion(const std::string& criterion, const std::vector<std::string>& runs) {
  std::map<std::string, double> values;
  const std::vector<Quantity> quantities = quantities_in(criterion);
  for (const Quantity& quantity : quantities) {
    if (std::ranges::find(runs, quantity.run) == runs.end())
      throw UsageError(fmt::format("'{}': {}", quantity.name(), unknown_name("run", quantity.run, runs)));
    values[quantity.name()] = 1;
  }
  result_of(criterion, values);
  if (quantities.empty())
    throw UsageError(
        fmt::format("'{}' contains no quantity of a run, such as {}.verdict", criterion, runs.front()));
}

bool is_met(const std::string& criterion, const std::map<std::string, double>& values) {
  return result_of(criterion, values) != 0;
}

QuantityValue value_of(const std::string& folder, const std::string& path) {
  for (const char* kind : kinds_of_history)
    if (const std::string column = behind(path, kind); !column.empty())
      return value_of_history(folder, kind, column);
  const StoredRun run = read_stored_run(folder);
  if (path == "verdict") {
    if (!run.record.verdict) throw UsageError("the run has no verdict");
    return {static_cast<double>(*run.record.verdict), run.verdict()};
  }
  if (const std::string verdict = behind(path, "since"); !verdict.empty()) {
    const auto failure = find_verdict(verdict);
    if (!failure) throw UsageError(unknown_name("verdict", verdict, names_of_failures()));
    const auto since = run.record.since.find(*failure);
    if (since == run.record.since.end()) return {std::numeric_limits<double>::infinity(), "never"};
    return {since->second, six_digits(since->second) + " s"};
  }
  if (const std::string measure = behind(path, "error"); !measure.empty()) {
    const auto error = run.record.measure(measure).error;
    if (error) return {*error, six_digits(*error)};
    if (check_expectation(run, {.name = measure}).value)
      throw UsageError(fmt::format("the measure {} has no reference", measure));
  }
  const Finding finding =
      check_expectation(run, {.name = path.starts_with("error.") ? path.substr(6) : path});
  if (!finding.value)
    throw UsageError(
        fmt::format("{} has no value{}", path, finding.difference.empty() ? "" : ": " + finding.difference));
  return {*finding.value, finding.is};
}

}  // namespace taut::cli
