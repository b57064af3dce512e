#include "cli/study/chart_errors.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/core.h>

#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"
#include "engine/diagnostics/measure_kinds.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

using NameList = std::vector<std::string>;

std::optional<double> finite(std::optional<double> value) {
  return value && std::isfinite(*value) ? value : std::nullopt;
}

NameList methods_in(const StoredResults& results) {
  NameList names;
  for (const StoredRun& run : results.runs)
    if (run.has_result() && std::ranges::find(names, run.method()) == names.end())
      names.push_back(run.method());
  return names;
}

/// For each set of swept values, the finest stable run with a value; at a tie, the run with most steps.
ChartErrors against_finest(const StoredResults& results, const std::string& method,
                           const std::string& measure) {
  ChartErrors errors{measure, {}, names_of_scene(results.runs)};
  const auto rank = [](const StoredRun& run) { return std::pair(-run.record.spacing, run.record.steps); };
  for (const StoredRun& run : results.runs) {
    if (run.method() != method || !run.is_stable() || !run.value_of(measure) || !(run.record.spacing > 0))
      continue;
    const StoredRun* const before = errors.reference_of(run);
    if (!before)
      errors.against.push_back(&run);
    else if (rank(run) > rank(*before))
      std::ranges::replace(errors.against, before, &run);
  }
  std::erase_if(errors.swept, [&](const std::string& name) {
    return std::ranges::all_of(results.runs, [&](const StoredRun& run) {
      return !run.has_result() || value_of(run, name) == value_of(results.runs.front(), name);
    });
  });
  return errors;
}

ChartErrors errors_of(const StoredResults& results, const std::string& measure, const ChartRequest& request) {
  ChartErrors errors{measure};
  if (request.run)
    errors.against = {&*request.run};
  else if (!request.against.empty())
    errors = against_finest(results, request.against, measure);
  errors.choose_kind(results.runs);
  return errors;
}

bool has_errors(const StoredResults& results, const std::string& measure, const ChartRequest& request) {
  const ChartErrors errors = errors_of(results, measure, request);
  if (request.replaces_references() && errors.against.empty()) return false;
  return std::ranges::any_of(results.runs, [&](const StoredRun& run) { return errors.of(run).has_value(); });
}

/// Measures that are errors cannot be compared with a run.
bool is_error(const StoredResults& results, const std::string& measure) {
  return std::ranges::any_of(
      results.runs, [&](const StoredRun& run) { return is_difference(run.record.measure(measure).kind); });
}

std::string default_measure(const StoredResults& results, const NameList& charted,
                            const ChartRequest& request) {
  const auto rank = [&](const std::string& measure) {
    const ChartErrors errors = errors_of(results, measure, request);
    const auto with_error = [&](const StoredRun& run) { return errors.of(run).has_value(); };
    const StoredRun& any = *std::ranges::find_if(results.runs, with_error);
    const bool last = measure.ends_with("_time") || !errors.unit(any).empty();
    return std::pair(last, -std::ranges::count_if(results.runs, with_error));
  };
  return *std::ranges::min_element(charted, {}, rank);
}

std::string hint(const StoredResults& results) {
  NameList names = methods_in(results);
  std::erase_if(names, [&](const std::string& method) {
    return std::ranges::none_of(
        results.runs, [&](const StoredRun& run) { return run.method() == method && run.is_stable(); });
  });
  return names.empty() ? ""
                       : "; `taut chart --against METHOD` compares with the finest stable run of a method: " +
                             join(names);
}

std::string not_ended(const StoredResults& results) {
  const auto count =
      std::ranges::count_if(results.runs, [](const StoredRun& run) { return !run.has_result(); });
  return count == 0 ? "" : fmt::format("; {} of {} runs have not ended", count, results.runs.size());
}

bool all_diverged(const StoredResults& results) {
  const auto diverged = [](const StoredRun& run) { return run.record.verdict == Verdict::diverged; };
  const auto with_result = [](const StoredRun& run) { return run.has_result(); };
  return std::ranges::any_of(results.runs, with_result) &&
         std::ranges::none_of(results.runs,
                              [&](const StoredRun& run) { return with_result(run) && !diverged(run); });
}

std::string nothing_charted(const StoredResults& results, const ChartRequest& request) {
  if (request.run)
    return fmt::format("the runs and '{}' have no measure in common with a value", request.run->file);
  if (!request.against.empty())
    return fmt::format("no stable run of {} in the results of {} has a value that another run has, too",
                       request.against, results.scene);
  return fmt::format("no measure in the results of {} has an error: {}{}{}", results.scene,
                     all_diverged(results)
                         ? "all runs diverged"
                         : "the scene has no references for these parameters, or the runs were too short",
                     not_ended(results), hint(results));
}

std::string no_error_of(const StoredResults& results, const ChartRequest& request, const NameList& charted) {
  const bool referenced = std::ranges::any_of(results.runs, [&](const StoredRun& run) {
    return run.has_result() && run.record.measure(request.measure).reference;
  });
  std::string why = fmt::format("no stable run of {} has a value of this measure, or no other run has one",
                                request.against);
  if (methods_in(results).empty())
    why = "no run has a result yet";
  else if (all_diverged(results))
    why = "all runs diverged";
  else if (request.run)
    why = fmt::format("'{}' has no value of this measure, or no other run has one", request.run->file);
  else if (request.against.empty())
    why = referenced ? "the runs with a reference ended before it could be measured"
                     : "the scene has no reference for it with these parameters";
  return fmt::format("no run has an error of {}: {}{}{}{}", request.measure, why,
                     charted.empty() ? "" : "; measures with an error: " + join(charted), not_ended(results),
                     request.replaces_references() ? "" : hint(results));
}

}  // namespace

std::string shown_spacing(double spacing) {
  return spacing < 0.1 ? brief(1e3 * spacing) + " mm" : brief(spacing) + " m";
}

bool is_same_run(const StoredRun& a, const StoredRun& b) {
  if (a.file == b.file && a.cells == b.cells) return true;
  if (a.text("folder").empty() || b.text("folder").empty()) return false;
  std::error_code error;
  return std::filesystem::equivalent(a.folder(), b.folder(), error);
}

const StoredRun* ChartErrors::reference_of(const StoredRun& run) const {
  const auto found = std::ranges::find_if(against, [&](const StoredRun* one) {
    return std::ranges::all_of(
        swept, [&](const std::string& name) { return value_of(*one, name) == value_of(run, name); });
  });
  return found == against.end() ? nullptr : *found;
}

void ChartErrors::choose_kind(const std::vector<StoredRun>& runs) {
  relative = std::ranges::any_of(
      runs, [&](const StoredRun& run) { return is_relative(run) && of_any_kind(run).has_value(); });
}

std::optional<double> ChartErrors::of(const StoredRun& run) const {
  return is_relative(run) == relative ? of_any_kind(run) : std::nullopt;
}

bool ChartErrors::comparable(const StoredRun& run) const {
  return is_relative(run) == relative || !of_any_kind(run);
}

std::optional<double> ChartErrors::of_any_kind(const StoredRun& run) const {
  if (!run.has_result()) return std::nullopt;
  if (against.empty()) return finite(run.record.measure(measure).error);
  const StoredRun* const reference_run = reference_of(run);
  if (!reference_run || reference_run == &run || is_same_run(*reference_run, run)) return std::nullopt;
  const auto value = run.value_of(measure), reference = reference_run->value_of(measure);
  if (!value || !reference) return std::nullopt;
  return std::abs(*value - *reference) / (*reference != 0 ? std::abs(*reference) : 1);
}

bool ChartErrors::measured(const StoredRun& run) const {
  return run.value_of(measure) || run.record.measure(measure).why.find("reference") != std::string::npos;
}

bool ChartErrors::is_relative(const StoredRun& run) const {
  const StoredRun* const reference_run = reference_of(run);
  return (reference_run ? reference_run->value_of(measure) : run.record.measure(measure).reference)
             .value_or(0) != 0;
}

std::string ChartErrors::unit(const StoredRun& run) const {
  const std::string& unit = run.record.measure(measure).unit;
  return relative || unit == "1" ? "" : unit;
}

ChartErrors chosen_errors(const StoredResults& results, const ChartRequest& request) {
  const NameList all = results.measures(), methods = methods_in(results);
  if (!request.measure.empty() && std::ranges::find(all, request.measure) == all.end())
    throw UsageError(unknown_name("measure", request.measure, all));
  if (!request.against.empty() && std::ranges::find(methods, request.against) == methods.end())
    throw UsageError(unknown_name("method", request.against, methods));
  NameList charted = all;
  std::erase_if(charted, [&](const std::string& m) { return !has_errors(results, m, request); });
  if (request.replaces_references()) {
    std::erase_if(charted, [&](const std::string& m) { return is_error(results, m); });
    if (!request.measure.empty() && is_error(results, request.measure))
      throw UsageError(fmt::format(
          "{} is already an error relative to a reference of the scene: leave out --against{}",
          request.measure, charted.empty() ? "" : "; measures that can be compared: " + join(charted)));
  }
  if (charted.empty()) throw NoErrors(nothing_charted(results, request));
  if (request.measure.empty()) return errors_of(results, default_measure(results, charted, request), request);
  if (std::ranges::find(charted, request.measure) != charted.end())
    return errors_of(results, request.measure, request);
  throw NoErrors(no_error_of(results, request, charted));
}

}  // namespace taut::cli
