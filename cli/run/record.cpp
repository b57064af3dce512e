#include "cli/run/record.hpp"

#include <cmath>
#include <fstream>

#include "cli/system/atomic_file.hpp"
#include "cli/system/build_info.hpp"
#include "cli/text/format.hpp"
#include "cli/text/json_cursor.hpp"
#include "engine/error.hpp"
#include "engine/methods/catalogue.hpp"

namespace taut::cli {
namespace {

std::string_view name(RunRecord::Status status) {
  switch (status) {
    case RunRecord::Status::running:
      return "running";
    case RunRecord::Status::finished:
      return "finished";
    case RunRecord::Status::interrupted:
      return "interrupted";
    case RunRecord::Status::failed:
      return "failed";
  }
  return "";
}

std::optional<RunRecord::Status> find_status(std::string_view text) {
  using enum RunRecord::Status;
  for (const RunRecord::Status status : {running, finished, interrupted, failed})
    if (name(status) == text) return status;
  return std::nullopt;
}

std::string text_in(const Json& object, const char* key) {
  const Json* found = object.find(key);
  return found && found->is_text() ? found->text() : "";
}

std::optional<double> number_in(const Json& object, const char* key) {
  const Json* found = object.find(key);
  return found && found->is_number() ? std::optional(found->number()) : std::nullopt;
}

Json parameters(const RunRecord& record) {
  Json all = Json::object();
  for (const Parameter& p : record.parameters) all[p.name] = p.value;
  return all;
}

Json since(const RunRecord& record) {
  Json all = Json::object();
  for (const auto& [verdict, time] : record.since) all[std::string(name(verdict))] = time;
  return all;
}

Json all_indicators(const RunRecord& record) {
  Json all = {{"pieces", record.pieces}};
  for (std::size_t k = 0; k < indicators.size(); ++k) {
    const IndicatorRecord& each = record.indicator[k];
    all[std::string(indicators[k].key)] = {
        {"greatest", each.greatest()}, {"at", each.at}, {"last", each.last}};
  }
  if (!record.patch_body.empty()) {
    all[indicators[0].key]["body"] = record.patch_body;
    Json& place = all[indicators[0].key]["place"] = Json::array();
    for (const double x : record.patch_place) place.add(x);
  }
  return all;
}

Json measures(const RunRecord& record) {
  Json all = Json::object();
  for (const MeasureResult& m : record.measures) {
    Json& one = all[m.name];
    one["kind"] = m.kind;
    one["value"] = m.value;
    one["unit"] = m.unit;
    one["reference"] = m.reference;
    one["reference_name"] = m.reference_name.empty() ? Json(nullptr) : Json(m.reference_name);
    one["error"] = m.error;
    if (!m.why.empty()) one["why"] = m.why;
  }
  return all;
}

}  // namespace

std::vector<RunWarning> warnings(const RunRecord& record) {
  constexpr double much = 0.1;  // of the energy
  std::vector<RunWarning> all;
  const auto since = [](double time) { return " since t = " + brief(time) + " s: "; };
  if (const auto& [greatest, time] = record.energy_gain; greatest > 0)
    all.push_back({"gains_energy",
                   "gains energy" + since(time) + "up to " + brief(greatest) + " times the received energy",
                   {{"since", time}, {"ratio", greatest}}});
  const MethodInfo* method = find_method(record.method);
  const bool has_energy = method && strain_energy(method->formulation) != StrainEnergy::recovered;
  if (const double lost = record.conservation.energy_lost.value_or(0); has_energy && lost > much)
    all.push_back({"loses_energy", "loses energy: up to " + percent(lost), {{"share", lost}}});
  if (const auto& [greatest, time] = record.turn; greatest > 0)
    all.push_back(
        {"turns_by_itself",
         "turns by itself" + since(time) + "the angular momentum changes by up to " + percent(greatest),
         {{"since", time}, {"share", greatest}}});
  return all;
}

std::string energy_note(const RunRecord& record) {
  constexpr double small = 0.01;
  const MethodInfo* method = find_method(record.method);
  const Conservation& drift = record.conservation;
  if (!method || !drift.energy || !(*drift.energy >= small)) return {};
  const bool lost = drift.energy_lost >= drift.energy_gained;
  const std::string change = percent(*drift.energy) + " of the energy was " + (lost ? "lost" : "created");
  switch (strain_energy(method->formulation)) {
    case StrainEnergy::potential:
      return change + (lost ? ", dissipated by the method and its contact" : " by the method or its contact");
    case StrainEnergy::of_stress:
      return change + "; an estimate, since " + record.method +
             " integrates a stress rate and has no potential energy";
    case StrainEnergy::recovered:
      return "the reported sum changed by " + percent(*drift.energy) + "; " + record.method +
             " recovers its strain energy for display only";
  }
  return {};
}

std::optional<double> RunRecord::particle_steps_per_second() const {
  if (steps == 0 || seconds.solve <= 0) return std::nullopt;
  return static_cast<double>(particles) * static_cast<double>(steps) / seconds.solve;
}

Json to_json(const RunRecord& record) {
  Json json;
  json["taut"] = build_info.version;
  json["format"] = format_of("run.json");
  json["scene"] = record.scene;
  json["method"] = record.method;
  json["material_law"] = record.material_law;
  if (!record.remark.empty()) json["remark"] = record.remark;
  if (record.contact) json["contact"] = *record.contact;
  json["stepping"] = record.stepping;
  json["cfl"] = record.cfl;
  json["parameters"] = parameters(record);
  json["dim"] = record.dim;
  json["spacing"] = record.spacing;
  if (record.requested_spacing) json["spacing_asked"] = record.requested_spacing;
  if (record.jitter.share > 0) {
    json["jitter"] = record.jitter.share;
    json["jitter_seed"] = record.jitter.seed;
  }
  json["particles"] = record.particles;
  json["mass"] = record.mass;
  json["until"] = record.until;
  json["reached"] = record.reached;
  json["status"] = name(record.status);
  if (!record.reason.empty()) json["reason"] = record.reason;
  json["steps"] = record.steps;
  json["threads"] = record.threads;
  json["machine"] = record.machine;
  json["seconds"] = {{"setup", record.seconds.setup},
                     {"solve", record.seconds.solve},
                     {"render", record.seconds.render},
                     {"write", record.seconds.write}};
  json["particle_steps_per_second"] = record.particle_steps_per_second();
  json["verdict"] = name(record.verdict);
  json["since"] = since(record);
  if (record.beyond_law.share > 0)
    json["beyond_law"] = {{"since", record.beyond_law.since}, {"share", record.beyond_law.share}};
  for (const RunWarning& warning : warnings(record)) json["warnings"][warning.key] = warning.figures;
  json["indicators"] = all_indicators(record);
  json["conservation"] = {{"linear_momentum", record.conservation.linear_momentum},
                          {"angular_momentum", record.conservation.angular_momentum},
                          {"energy", record.conservation.energy},
                          {"energy_gained", record.conservation.energy_gained},
                          {"energy_lost", record.conservation.energy_lost}};
  if (const std::string note = energy_note(record); !note.empty()) json["energy_note"] = note;
  json["measures"] = measures(record);
  json["provenance"] = record.provenance.to_json();
  return json;
}

std::optional<StoredRecord> checked_record(const std::filesystem::path& file) {
  const std::optional<std::string> text = read_whole(file);
  if (!text) return std::nullopt;
  Json all = parse_run_json(*text, file.string(), names_of_verdicts());
  StoredRecord record;
  record.version = text_in(all, "taut");
  record.status = find_status(text_in(all, "status"));
  record.verdict = find_verdict(text_in(all, "verdict"));
  record.reached = number_in(all, "reached");
  record.until = number_in(all, "until");
  record.requested_spacing = number_in(all, "spacing_asked");
  record.all = std::move(all);
  return record;
}

double seconds_taken(const StoredRecord& record) {
  const auto figure = [&](const char* part, const char* key) {
    const Json* const found = record.all.find(part);
    return found ? number_in(*found, key).value_or(0) : 0;
  };
  return std::max(figure("provenance", "wall_seconds"), figure("seconds", "solve"));
}

std::optional<StoredRecord> read_record(const std::filesystem::path& file) try {
  return checked_record(file);
} catch (const UsageError&) {
  return std::nullopt;
}

std::string machine_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t colon = line.find(':');
    const std::size_t start = colon == std::string::npos ? colon : line.find_first_not_of(" \t", colon + 1);
    if (start != std::string::npos) return line.substr(start);
  }
  return "unknown";
}

}  // namespace taut::cli
