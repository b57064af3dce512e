#include "cli/run/report.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "cli/scene/sections.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/text/format.hpp"

namespace taut::cli {
namespace {

std::string with_unit(std::optional<double> value, const std::string& unit) {
  if (!value) return "-";
  return brief(*value) + (unit.empty() || unit == "1" ? "" : " " + unit);
}

/// In percent of the reference, else in the unit.
std::string error(const MeasureResult& m) {
  const bool relative = m.error && m.reference && *m.reference != 0;
  return relative ? percent(*m.error) : with_unit(m.error, m.unit);
}

std::string share(std::optional<double> value) { return value ? brief(*value) : "exchanged"; }

std::string verdict_line(const RunRecord& record) {
  const auto since = [](Verdict verdict, double time) {
    return fmt::format("{} since t = {} s", name(verdict), brief(time));
  };
  const auto own = record.since.find(*record.verdict);
  std::string text =
      own == record.since.end() ? std::string(name(*record.verdict)) : since(own->first, own->second);
  for (const auto& [verdict, time] : record.since)
    if (verdict != record.verdict) text += ", " + since(verdict, time);
  return text;
}

std::string indicators_line(const RunRecord& record) {
  std::string text;
  for (std::size_t k = 0; k < indicators.size(); ++k) {
    (text += k == 0 ? "" : ", ") += indicators[k].key;
    (text += ' ') += brief(record.indicator[k].greatest());
    if (k > 0 || record.patch_body.empty() || record.indicator[k].greatest() <= hourglass_threshold) continue;
    text += fmt::format(" ({} at ", record.patch_body);
    for (std::size_t axis = 0; axis < record.patch_place.size(); ++axis)
      text += (axis == 0 ? "[" : ", ") + brief(record.patch_place[axis]);
    text += "])";
  }
  return text;
}

std::string heading(const RunRecord& record) {
  std::string text = fmt::format("{} with {}: {} particles at dp = {} m, {} {} to t = {} s", record.scene,
                                 record.method, record.particles, brief(record.spacing), record.steps,
                                 record.steps == 1 ? "step" : "steps", brief(record.reached));
  if (record.status == RunRecord::Status::interrupted)
    text += fmt::format(" of {} s (interrupted)", brief(record.until));
  return text + "\n";
}

std::string missing_reference(const SceneFile& file, const RunRecord& record, const std::string& measure) {
  std::vector<std::string> laws;
  for (const auto& [law, reference] : file.scene.references)
    if (law != record.material_law && reference.has(measure)) laws.push_back(law_name(law));
  if (!laws.empty())
    return fmt::format("the scene's reference is for {}; {}'s law is {}", join_with_or(laws), record.method,
                       law_name(record.material_law));
  const auto unmet = file.unmet_references.find(measure);
  return unmet == file.unmet_references.end() ? "" : "the scene's reference " + unmet->second;
}

std::string notes_on_references(const SceneFile& file, const RunRecord& record) {
  std::vector<std::pair<std::string, std::string>> notes;
  for (const MeasureResult& m : record.measures) {
    if (m.reference) continue;
    const std::string why = missing_reference(file, record, m.name);
    if (why.empty()) continue;
    const auto found = std::ranges::find(notes, why, &std::pair<std::string, std::string>::first);
    if (found == notes.end())
      notes.emplace_back(why, m.name);
    else
      found->second += ", " + m.name;
  }
  std::string text;
  for (const auto& [why, names] : notes) text += fmt::format("no reference for {}: {}\n", names, why);
  return text;
}

std::string measures_table(const RunPlan& plan, const RunRecord& record) {
  const std::vector<MeasureResult>& measures = record.measures;
  if (measures.empty()) return "";
  std::vector<std::vector<std::string>> rows{{"measure", "value", "reference", "error", ""}};
  for (const MeasureResult& m : measures)
    rows.push_back({m.name, m.value ? with_unit(m.value, m.unit) : "none", with_unit(m.reference, m.unit),
                    error(m), m.reference_name});
  std::string text = in_columns(rows);
  for (const MeasureResult& m : measures)
    if (!m.value) text += fmt::format("{} has no value: {}\n", m.name, m.why);
  return fmt::format("{}{}\n", text, notes_on_references(plan.file, record));
}

double speed(const Snapshot& now, std::size_t particle) {
  const auto dim = static_cast<std::size_t>(now.dim);
  double sum = 0;
  for (std::size_t k = 0; k < dim; ++k) sum += now.v[particle * dim + k] * now.v[particle * dim + k];
  return std::sqrt(sum);
}

std::size_t worst_particle(const Snapshot& now) {
  std::size_t worst = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (!std::isfinite(speed(now, i))) return i;
    if (speed(now, i) > speed(now, worst)) worst = i;
  }
  return worst;
}

std::string when(double time, long step) {
  return fmt::format("the simulation diverged at t = {} s, step {}: ", brief(time), step);
}

}  // namespace

std::string run_report(const RunPlan& plan, const RunResult& result) {
  const RunRecord& record = result.record;
  const Conservation& drift = record.conservation;
  const Seconds& seconds = record.seconds;
  std::vector<std::vector<std::string>> rows{
      {"verdict", verdict_line(record)},
      {"indicators", indicators_line(record)},
      {"drift", fmt::format("{}, linear momentum {}, angular momentum {}",
                            drift.energy ? "energy " + brief(*drift.energy) : "energy unknown",
                            share(drift.linear_momentum), share(drift.angular_momentum))},
      {"speed", fmt::format("{} particle-steps/s on {} thread{}",
                            with_prefix(record.particle_steps_per_second().value_or(0)), record.threads,
                            record.threads == 1 ? "" : "s")},
      {"seconds", fmt::format("set-up {}, solving {}, drawing {}, writing {}", brief(seconds.setup),
                              brief(seconds.solve), brief(seconds.render), brief(seconds.write))}};
  if (const std::string note = energy_note(record); !note.empty())
    rows.insert(rows.begin() + 3, {"energy", note});
  for (const RunWarning& warning : warnings(record)) rows.push_back({"warning", warning.text});
  if (const BeyondLaw& beyond = record.beyond_law; beyond.share > 0)
    rows.push_back(
        {"law",
         fmt::format(
             "not followed since t = {} s: up to {} of the bonds are stretched too far and are stiffer than the law",
             brief(beyond.since), percent(beyond.share))});
  if (record.requested_spacing)
    rows.push_back({"spacing", fmt::format("{} m; {} m does not divide the first body", brief(record.spacing),
                                           brief(*record.requested_spacing))});
  rows.push_back({"run", plan.folder.path().string()});
  if (plan.drawing)
    rows.push_back({"frames", fmt::format("{} ({})", plan.folder.frames().string(), result.frames)});
  if (!plan.particle_fields.empty())
    rows.push_back({"particles", plan.folder.particle_entry(plan.particle_form.format).string()});
  return fmt::format("{}\n{}{}", heading(record), measures_table(plan, record), in_columns(rows));
}

int exit_code(const RunResult& result, const std::optional<Verdict>& fail_on) {
  if (!result.failure.empty()) return exit_diverged;
  if (result.record.status == RunRecord::Status::interrupted) return Interrupts::exit_code();
  return fail_on && result.record.verdict >= *fail_on ? exit_diverged : exit_fine;
}

std::string describe_divergence(const NumericalError& error) {
  return when(error.time, error.step) + error.what();
}

std::string describe_divergence(const Snapshot& now, const Balance& sums) {
  const std::size_t worst = worst_particle(now);
  return fmt::format(
      "{}the total energy is {} J, the kinetic energy {} J; the fastest particle, {}, moves at {} m/s",
      when(now.time, now.step), brief(sums.kinetic + sums.strain), brief(sums.kinetic), worst,
      brief(speed(now, worst)));
}

}  // namespace taut::cli
