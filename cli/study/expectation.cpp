#include "cli/study/expectation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"
#include "engine/judge/verdict.hpp"

namespace taut::cli {
namespace {

std::string without_blanks(std::string text) {
  std::erase(text, ' ');
  return text;
}

double finite_number(const std::string& text, const std::string& whole) {
  const auto value = parsed<double>(text);
  if (value && std::isfinite(*value)) return *value;
  throw UsageError(fmt::format(
      "'{}': '{}' is not a number; write NAME=VALUE±TOLERANCE, NAME<VALUE or NAME>VALUE, without units",
      whole, text));
}

std::optional<std::pair<std::size_t, std::size_t>> find_tolerance(const std::string& text) {
  for (const std::string_view sign : {"±", "+-", "+/-"})
    if (const std::size_t at = text.find(sign); at != std::string::npos) return {{at, at + sign.size()}};
  return std::nullopt;
}

std::vector<std::pair<std::string, double>> numbers_in(const Json& record) {
  std::vector<std::pair<std::string, double>> all;
  for (const auto& [pointer, value] : record.leaves()) {
    std::string path = pointer.substr(1);
    std::ranges::replace(path, '/', '.');
    if (value.is_number()) all.emplace_back(path, value.number());
  }
  return all;
}

std::vector<std::string> names_in(const StoredRun& run) {
  std::vector<std::string> names;
  for (const MeasureResult& measure : run.record.measures) names.push_back(measure.name);
  for (const auto& [path, value] : numbers_in(run.all))
    if (!path.starts_with("measures.")) names.push_back(path);
  return names;
}

std::string with_unit(double value, const std::string& unit) {
  return unit.empty() ? six_digits(value) : fmt::format("{} {}", six_digits(value), unit);
}

std::string shown_tolerance(const Tolerance& t) { return t.relative ? percent(t.size) : six_digits(t.size); }

std::string shown(const Expectation& e, const std::string& unit) {
  if (e.kind == Expectation::Kind::equal)
    return fmt::format("{} ± {}", with_unit(e.value, unit), shown_tolerance(e.tolerance));
  return fmt::format("{}{} {}", e.kind == Expectation::Kind::below ? "<" : ">", e.or_equal ? "=" : "",
                     with_unit(e.value, unit));
}

bool holds(const Expectation& e, double is) {
  if (e.kind == Expectation::Kind::equal)
    return std::abs(is - e.value) <= e.tolerance.size * (e.tolerance.relative ? std::abs(e.value) : 1);
  if (e.or_equal && is == e.value) return true;
  return e.kind == Expectation::Kind::below ? is < e.value : is > e.value;
}

std::string shown_difference(const Expectation& e, double is, const std::string& unit) {
  const double difference = is - e.value;
  std::string text = difference > 0 ? "+" : "";
  if (e.tolerance.relative && e.value != 0) return text + percent(difference / std::abs(e.value));
  return fmt::format("{}{}{}", text, brief(difference), unit.empty() ? "" : " " + unit);
}

}  // namespace

Tolerance parse_tolerance(const std::string& text, const std::string& option) {
  const std::string plain = without_blanks(text);
  const bool relative = plain.ends_with('%');
  const auto size = parsed<double>(std::string_view(plain).substr(0, plain.size() - (relative ? 1 : 0)));
  if (!size || !std::isfinite(*size) || *size < 0)
    throw UsageError(fmt::format("{}: the tolerance '{}' is neither like 1% nor like 0.002", option, text));
  return {relative ? *size / 100 : *size, relative};
}

Expectation parse_expectation(const std::string& given, const std::optional<Tolerance>& for_all) {
  const std::string text = without_blanks(given);
  const std::size_t sign = text.find_first_of("=<>");
  if (sign == 0 || sign == std::string::npos)
    throw UsageError(
        fmt::format("--measure '{}' is not NAME=VALUE±TOLERANCE, NAME<VALUE or NAME>VALUE", given));
  Expectation e{.name = text.substr(0, sign)};
  std::string rest = text.substr(sign + 1);
  if (text[sign] == '=') {
    const auto tolerance = find_tolerance(rest);
    if (!tolerance && !for_all)
      throw UsageError(
          fmt::format("--measure '{}' has no tolerance; write '{}±1%', or give --tolerance for all measures",
                      given, text));
    e.tolerance =
        tolerance ? parse_tolerance(rest.substr(tolerance->second), fmt::format("'{}'", given)) : *for_all;
    if (tolerance) rest = rest.substr(0, tolerance->first);
  } else {
    e.kind = text[sign] == '<' ? Expectation::Kind::below : Expectation::Kind::above;
    e.or_equal = rest.starts_with('=');
    if (e.or_equal) rest = rest.substr(1);
  }
  e.value = finite_number(rest, given);
  return e;
}

std::vector<Expectation> expectations_of(const StoredRun& baseline, const Tolerance& tolerance) {
  std::vector<Expectation> all;
  for (const MeasureResult& measure : baseline.record.measures)
    if (measure.value) all.push_back({.name = measure.name, .value = *measure.value, .tolerance = tolerance});
  return all;
}

Finding check_expectation(const StoredRun& run, const Expectation& e) {
  const MeasureResult* measure = run.record.find_measure(e.name);
  std::optional<double> is = measure ? measure->value : std::nullopt;
  if (!measure) {
    const auto numbers = numbers_in(run.all);
    const auto found = std::ranges::find(numbers, e.name, &std::pair<std::string, double>::first);
    if (found == numbers.end())
      throw UsageError(unknown_name("measure or number of run.json", e.name, names_in(run)));
    is = found->second;
  }
  const std::string unit = measure && measure->unit != "1" ? measure->unit : "";
  const bool bound = e.kind != Expectation::Kind::equal;
  if (!is || !std::isfinite(*is))
    return {e.name, shown(e, unit), "no value", measure ? measure->why : "", false, bound};
  return {e.name, shown(e, unit), with_unit(*is, unit), shown_difference(e, *is, unit), holds(e, *is), bound,
          *is};
}

Finding check_verdict(const StoredRun& run, const std::string& worst) {
  const auto is = run.record.verdict, allowed = find_verdict(worst);
  if (!allowed) throw UsageError(unknown_name("verdict", worst, names_of_verdicts()));
  return {"verdict",
          *allowed == Verdict::stable ? worst : worst + " or better",
          is ? run.verdict() : "no value",
          "",
          is && *is <= *allowed,
          true};
}

Finding check_end(const StoredRun& run) {
  return {"status", "finished", run.status.empty() ? "no value" : run.status, "", run.status == "finished",
          true};
}

std::string findings_table(const std::vector<Finding>& findings) {
  std::vector<std::vector<std::string>> rows{{"measure", "expected", "is", "difference", ""}};
  for (const Finding& f : findings)
    rows.push_back({f.name, f.expected, f.is, f.difference,
                    f.fine    ? "fine"
                    : f.bound ? "VIOLATED"
                              : "MOVED"});
  return in_columns(rows);
}

}  // namespace taut::cli
