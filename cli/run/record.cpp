#include "cli/run/record.hpp"

#include <algorithm>
#include <concepts>
#include <type_traits>

#include <fmt/core.h>

#include "cli/system/atomic_file.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"
#include "engine/methods/catalogue.hpp"

namespace taut::cli {
namespace {

using Status = RunRecord::Status;
constexpr std::pair<std::string_view, Status> statuses[] = {{"running", Status::running},
                                                            {"finished", Status::finished},
                                                            {"interrupted", Status::interrupted},
                                                            {"failed", Status::failed}};

template <class T, class Of>
concept is_of = std::same_as<std::remove_const_t<T>, Of>;

template <is_of<Seconds> T>
void members(T& seconds, const auto& use) {
  use("setup", seconds.setup);
  use("solve", seconds.solve);
  use("render", seconds.render);
  use("write", seconds.write);
  use("cpu", seconds.cpu);
}

template <is_of<Conservation> T>
void members(T& drift, const auto& use) {
  use("linear_momentum", drift.linear_momentum);
  use("angular_momentum", drift.angular_momentum);
  use("energy", drift.energy);
  use("energy_gained", drift.energy_gained);
  use("energy_lost", drift.energy_lost);
}

template <is_of<SavedParticles> T>
void members(T& saved, const auto& use) {
  use("format", saved.format);
  use("precision", saved.precision);
  use("fields", saved.fields);
}

template <is_of<BeyondLaw> T>
void members(T& beyond, const auto& use) {
  use("since", beyond.since);
  use("share", beyond.share);
}

template <is_of<MeasureResult> T>
void members(T& measure, const auto& use) {
  use("kind", measure.kind);
  use("value", measure.value);
  use("unit", measure.unit);
  use("reference", measure.reference);
  use("reference_name", measure.reference_name);
  use("error", measure.error);
  use("why", measure.why);
}

Json written(const auto& value) requires std::convertible_to<decltype(value), Json> { return value; }
template <class T>
requires std::is_arithmetic_v<T>
void read(const JsonCursor& json, T& value) { value = json.number_as<T>(); }
void read(const JsonCursor& json, std::string& value) { value = json.text(); }
void read(const JsonCursor& json, std::optional<double>& value) { value = json.number(); }
void read(const JsonCursor& json, std::vector<std::string>& texts) {
  for (const JsonCursor& item : json.items()) texts.push_back(item.text());
}

template <class T>
requires requires(T& value) {
  members(value, [](const char*, auto&) {});
}
Json written(const T& value) {
  Json json = Json::object();
  members(value, [&](const char* key, const auto& member) { json.append(key, written(member)); });
  return json;
}
template <class T>
requires requires(T& value) {
  members(value, [](const char*, auto&) {});
}
void read(const JsonCursor& json, T& value) {
  if (json.is_null()) return;
  members(value, [&](const char* key, auto& member) {
    if (const JsonCursor inner = json.at(key); !inner.is_missing()) read(inner, member);
  });
}

Json written(const std::optional<std::string>& text) { return text ? Json(*text) : Json(); }
void read(const JsonCursor& json, std::optional<std::string>& text) {
  if (!json.is_null()) text = json.text();
}

Json written(const std::optional<SavedParticles>& saved) { return saved ? written(*saved) : Json(); }
void read(const JsonCursor& json, std::optional<SavedParticles>& saved) {
  if (!json.is_null()) read(json, saved.emplace());
}

Json written(const std::optional<Status>& status) {
  for (const auto& [name, value] : statuses)
    if (status == value) return name;
  return {};
}
void read(const JsonCursor& json, std::optional<Status>& status) {
  std::vector<std::string> names;
  for (const auto& [name, value] : statuses) names.emplace_back(name);
  const std::string chosen = json.choice(names);
  for (const auto& [name, value] : statuses)
    if (name == chosen) status = value;
}

Json written(const std::optional<Verdict>& verdict) { return verdict ? Json(name(*verdict)) : Json(); }
void read(const JsonCursor& json, std::optional<Verdict>& verdict) {
  verdict = find_verdict(json.choice(names_of_verdicts()));
}

Json written(const std::vector<std::pair<std::string, double>>& parameters) {
  Json all = Json::object();
  for (const auto& [name, value] : parameters) all.append(name, value);
  return all;
}
void read(const JsonCursor& json, std::vector<std::pair<std::string, double>>& parameters) {
  for (const auto& [name, value] : json.members()) parameters.emplace_back(name, value.number_as<double>());
}

Json written(const std::map<Verdict, double>& since) {
  Json all = Json::object();
  for (const auto& [verdict, time] : since) all.append(std::string(name(verdict)), time);
  return all;
}
void read(const JsonCursor& json, std::map<Verdict, double>& since) {
  for (const auto& [key, time] : json.members())
    if (const auto verdict = find_verdict(key)) since[*verdict] = time.number_as<double>();
}

Json written(const std::vector<MeasureResult>& measures) {
  Json all = Json::object();
  for (const MeasureResult& measure : measures) {
    Json one = Json::object();
    members(measure, [&](const std::string& key, const auto& member) {
      if (key != "why" || !measure.why.empty()) one.append(key, written(member));
    });
    if (measure.reference_name.empty()) one["reference_name"] = nullptr;
    all.append(measure.name, std::move(one));
  }
  return all;
}
void read(const JsonCursor& json, std::vector<MeasureResult>& measures) {
  for (const auto& [name, one] : json.members()) {
    MeasureResult& measure = measures.emplace_back();
    measure.name = name;
    read(one, measure);
  }
}

Json written_indicators(const RunRecord& record) {
  Json all = {{"pieces", record.pieces}};
  for (std::size_t k = 0; k < indicators.size(); ++k) {
    const IndicatorRecord& each = record.indicator[k];
    all[indicators[k].key] = {{"greatest", each.greatest()}, {"at", each.at}, {"last", each.last}};
  }
  if (!record.patch_body.empty()) {
    all[indicators[0].key]["body"] = record.patch_body;
    Json& place = all[indicators[0].key]["place"] = Json::array();
    for (const double x : record.patch_place) place.add(x);
  }
  return all;
}
void read_indicators(const JsonCursor& json, RunRecord& record) {
  if (json.is_null()) return;
  read(json.at("pieces"), record.pieces);
  for (std::size_t k = 0; k < indicators.size(); ++k) {
    const JsonCursor each = json.at(std::string(indicators[k].key));
    if (each.is_null()) continue;
    record.indicator[k].greatest_whole = 1;
    read(each.at("greatest"), record.indicator[k].greatest_part);
    read(each.at("at"), record.indicator[k].at);
    read(each.at("last"), record.indicator[k].last);
    if (k > 0) continue;
    record.patch_body = each.at("body").text();
    for (const JsonCursor& x : each.at("place").items()) record.patch_place.push_back(x.number_as<double>());
  }
}

Json written_warnings(const RunRecord& record) {
  Json all;
  for (const RunWarning& warning : warnings(record)) all[warning.key] = warning.figures;
  return all;
}
void read_warnings(const JsonCursor& json, RunRecord& record) {
  for (const auto& [key, warning] : json.members())
    for (const auto& [figure, value] : warning.members()) {
      const double number = value.number_as<double>();
      Excess* excess = key == "gains_energy"      ? &record.energy_gain
                       : key == "turns_by_itself" ? &record.turn
                                                  : nullptr;
      if (excess) (figure == "since" ? excess->since : excess->greatest) = number;
    }
}

using Place = RecordField::Place;

template <auto member>
constexpr RecordField field(std::string_view key, Place place = Place::everywhere) {
  return {key, [](const RunRecord& record) { return written(record.*member); },
          [](const JsonCursor& json, RunRecord& record) { read(json, record.*member); }, place};
}

/// In the order of run.json.
constexpr RecordField fields[] = {
    field<&RunRecord::version>("taut", Place::run_json),
    {"format", [](const RunRecord&) { return Json(format_of("run.json")); },
     [](const JsonCursor& json, RunRecord&) { json.number(); }, Place::run_json},
    field<&RunRecord::scene>("scene"),
    field<&RunRecord::method>("method"),
    field<&RunRecord::material_law>("material_law"),
    field<&RunRecord::remark>("remark", Place::everywhere_if_known),
    field<&RunRecord::contact>("contact", Place::everywhere_if_known),
    field<&RunRecord::stepping>("stepping"),
    field<&RunRecord::cfl>("cfl"),
    field<&RunRecord::parameters>("parameters"),
    field<&RunRecord::dim>("dim"),
    field<&RunRecord::spacing>("spacing"),
    field<&RunRecord::requested_spacing>("spacing_asked", Place::everywhere_if_known),
    {"jitter",
     [](const RunRecord& record) { return record.jitter.share > 0 ? Json(record.jitter.share) : Json(); },
     [](const JsonCursor& json, RunRecord& record) { read(json, record.jitter.share); },
     Place::everywhere_if_known},
    {"jitter_seed",
     [](const RunRecord& record) { return record.jitter.share > 0 ? Json(record.jitter.seed) : Json(); },
     [](const JsonCursor& json, RunRecord& record) { read(json, record.jitter.seed); },
     Place::everywhere_if_known},
    field<&RunRecord::file_checksum>("file_checksum", Place::run_json),
    field<&RunRecord::saved_particles>("saved_particles", Place::run_json),
    field<&RunRecord::particles>("particles"),
    field<&RunRecord::mass>("mass"),
    field<&RunRecord::until>("until"),
    field<&RunRecord::reached>("reached"),
    field<&RunRecord::status>("status"),
    field<&RunRecord::reason>("reason", Place::everywhere_if_known),
    field<&RunRecord::steps>("steps"),
    field<&RunRecord::threads>("threads", Place::last_in_results),
    field<&RunRecord::machine>("machine", Place::last_in_results),
    field<&RunRecord::seconds>("seconds", Place::last_in_results),
    {"particle_steps_per_second",
     [](const RunRecord& record) { return Json(record.particle_steps_per_second()); },
     [](const JsonCursor& json, RunRecord&) { json.number(); }, Place::last_in_results},
    field<&RunRecord::other_load>("other_load", Place::results),
    field<&RunRecord::verdict>("verdict"),
    field<&RunRecord::since>("since"),
    {"beyond_law",
     [](const RunRecord& record) {
       return record.beyond_law.share > 0 ? written(record.beyond_law) : Json();
     },
     [](const JsonCursor& json, RunRecord& record) { read(json, record.beyond_law); },
     Place::everywhere_if_known},
    {"warnings", written_warnings, read_warnings, Place::everywhere_if_known},
    {"indicators", written_indicators, read_indicators},
    field<&RunRecord::conservation>("conservation"),
    {"energy_note", [](const RunRecord& record) { return Json(energy_note(record)); },
     [](const JsonCursor& json, RunRecord&) { json.text(); }, Place::everywhere_if_known},
    field<&RunRecord::measures>("measures"),
    {"provenance", [](const RunRecord& record) { return record.provenance.to_json(); },
     [](const JsonCursor& json, RunRecord& record) {
       if (!json.is_null()) read(json.at("other_load"), record.other_load);
     },
     Place::run_json},
};

void append(Json& json, const RecordField& field, const RunRecord& record) {
  Json value = field.write(record);
  const bool known = !value.is_null() && !(value.is_text() && value.text().empty());
  if (known || field.place == Place::everywhere || field.place == Place::last_in_results)
    json.append(std::string(field.key), std::move(value));
}

}  // namespace

std::vector<RunWarning> warnings(const RunRecord& record) {
  constexpr double much = 0.1;  // of the energy
  std::vector<RunWarning> all;
  const auto since = [](double time) { return fmt::format(" since t = {} s: ", brief(time)); };
  if (const auto& [greatest, time] = record.energy_gain; greatest > 0)
    all.push_back(
        {"gains_energy",
         fmt::format("gains energy{}up to {} times the received energy", since(time), brief(greatest)),
         {{"since", time}, {"ratio", greatest}}});
  const MethodInfo* method = find_method(record.method);
  const bool has_energy = method && strain_energy(method->formulation) != StrainEnergy::recovered;
  if (const double lost = record.conservation.energy_lost.value_or(0); has_energy && lost > much)
    all.push_back({"loses_energy", "loses energy: up to " + percent(lost), {{"share", lost}}});
  if (const auto& [greatest, time] = record.turn; greatest > 0)
    all.push_back({"turns_by_itself",
                   fmt::format("turns by itself{}the angular momentum changes by up to {}", since(time),
                               percent(greatest)),
                   {{"since", time}, {"share", greatest}}});
  return all;
}

std::string energy_note(const RunRecord& record) {
  constexpr double small = 0.01;
  const MethodInfo* method = find_method(record.method);
  const Conservation& drift = record.conservation;
  if (!method || !drift.energy || !(*drift.energy >= small)) return {};
  const bool lost = drift.energy_lost >= drift.energy_gained;
  const std::string change =
      fmt::format("{} of the energy was {}", percent(*drift.energy), lost ? "lost" : "created");
  switch (strain_energy(method->formulation)) {
    case StrainEnergy::potential:
      return change + (lost ? ", dissipated by the method and its contact" : " by the method or its contact");
    case StrainEnergy::of_stress:
      return fmt::format("{}; an estimate, since {} integrates a stress rate and has no potential energy",
                         change, record.method);
    case StrainEnergy::recovered:
      return fmt::format("the reported sum changed by {}; {} recovers its strain energy for display only",
                         percent(*drift.energy), record.method);
  }
  return {};
}

const MeasureResult* RunRecord::find_measure(std::string_view name) const {
  const auto found = std::ranges::find(measures, name, &MeasureResult::name);
  return found == measures.end() ? nullptr : &*found;
}

const MeasureResult& RunRecord::measure(std::string_view name) const {
  static const MeasureResult none;
  const MeasureResult* found = find_measure(name);
  return found ? *found : none;
}

std::optional<double> RunRecord::particle_steps_per_second() const {
  if (steps == 0 || seconds.solve <= 0) return std::nullopt;
  return static_cast<double>(particles) * static_cast<double>(steps) / seconds.solve;
}

std::span<const RecordField> record_fields() { return fields; }

Json to_json(const RunRecord& record) {
  Json json = Json::object();
  for (const RecordField& field : fields)
    if (field.place != Place::results) append(json, field, record);
  return json;
}

Json to_results(const RunRecord& record) {
  Json json = Json::object();
  for (const bool last : {false, true})
    for (const RecordField& field : fields)
      if (field.place != Place::run_json &&
          last == (field.place == Place::last_in_results || field.place == Place::results))
        append(json, field, record);
  return json;
}

RunRecord record_from(const JsonCursor& json) {
  RunRecord record;
  record.version.clear();
  record.status.reset();
  record.verdict.reset();
  for (const RecordField& field : fields)
    if (const JsonCursor value = json.at(std::string(field.key)); !value.is_missing())
      field.read(value, record);
  return record;
}

StoredRecord parse_record(const std::string& text, const std::string& file) {
  Json all = parse_json(text, file);
  if (!all.find("taut"))
    throw UsageError(fmt::format(
        "'{}' is not the run.json of a run of taut: the key 'taut' is missing; repeat the run", file));
  RunRecord record = record_from(JsonCursor(all, file));
  return {std::move(record), std::move(all)};
}

std::optional<StoredRecord> checked_record(const std::filesystem::path& file) {
  const std::optional<std::string> text = read_whole(file);
  return text ? std::optional(parse_record(*text, file.string())) : std::nullopt;
}

double seconds_taken(const StoredRecord& record) {
  const Json* const provenance = record.all.find("provenance");
  const Json* const wall = provenance ? provenance->find("wall_seconds") : nullptr;
  return std::max(wall && wall->is_number() ? wall->number() : 0, record.seconds.solve);
}

std::optional<StoredRecord> read_record(const std::filesystem::path& file) try {
  return checked_record(file);
} catch (const UsageError&) {
  return std::nullopt;
}

}  // namespace taut::cli
