#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "cli/scene/sections.hpp"
#include "cli/text/format.hpp"
#include "cli/text/shown.hpp"
#include "cli/text/suggest.hpp"
#include "engine/methods/catalogue.hpp"

namespace taut::cli {
namespace {

constexpr std::string_view at_start = "it is fixed when the simulation starts",
                           placed = "the particles are already placed";
constexpr SettingInfo infos[] = {
    {"method", "method", "", false, at_start},
    {"spacing", "spacing", "", false, placed},
    {"until", "until", "", true, "a session has no end time; use `run until T`"},
    {"cfl", "cfl", "CFL {}", false, ""},
    {"stepping", "stepping", "{} stepping", false, at_start},
    {"contact", "contact", "contact {}", false, at_start},
    {"law", "material_law", "law {}", true, at_start},
    {"jitter", "jitter", "", false, placed},
    {"jitter_seed", "jitter_seed", "", false, placed},
};

/// Names with a meaning in expressions or --set.
std::vector<std::string> reserved_names() {
  std::vector<std::string> names = {"dp", "pi", "x",   "y", "z", "t",       "c0",
                                    "E",  "nu", "rho", "K", "G", "touching"};
  for (const SettingInfo& info : infos) names.emplace_back(info.name);
  return names;
}

std::string bounds_text(const Parameter& parameter) {
  const std::string low = parameter.low ? exact(*parameter.low) : "-inf",
                    high = parameter.high ? exact(*parameter.high) : "inf";
  return fmt::format("{} to {}{}", low, high,
                     parameter.unit.empty() || parameter.unit == "1" ? "" : " " + parameter.unit);
}

bool within_bounds(const Parameter& parameter, double value) {
  return !(parameter.low && value < *parameter.low) && !(parameter.high && value > *parameter.high);
}

/// `names` and `defaults`: earlier parameters with and without settings.
Parameter read_parameter(TomlCursor& entry, const std::string& name, const Changes& changes,
                         const Names& names, const Names& defaults) {
  Parameter parameter;
  parameter.name = name;
  TomlValue& value = entry.need("value");
  const bool resolved = entry.find("default") != nullptr;
  if (!resolved) entry.table().set("default", value);
  entry.names() = defaults;
  parameter.default_value = entry.value_of(entry.need("default"), resolved ? "default" : "value");
  entry.names() = names;
  const auto change = changes.parameters.find(name);
  if (change != changes.parameters.end()) {
    const FilePlace place = value.place;
    value = TomlValue(changed_number(name, change->second, names));
    value.place = place;
  }
  parameter.value = entry.number("value");
  parameter.unit = entry.line("unit", "");
  parameter.help = entry.line("help", "");
  if (entry.find("min")) parameter.low = entry.number("min");
  if (entry.find("max")) parameter.high = entry.number("max");
  if (parameter.low && parameter.high && *parameter.low > *parameter.high)
    entry.fail(entry.need("min"), "min",
               fmt::format("min = {} is above max = {}, so no value is allowed; lower min or raise max",
                           exact(*parameter.low), exact(*parameter.high)));
  entry.finish();
  const auto complain = [&](double number) {
    return fmt::format("{} = {} is out of bounds; allowed: {}", name, exact(number), bounds_text(parameter));
  };
  if (!within_bounds(parameter, parameter.default_value))
    entry.fail(value, "value", complain(parameter.default_value));
  if (!within_bounds(parameter, parameter.value)) throw UsageError(complain(parameter.value));
  return parameter;
}

std::set<std::string> names_in_parameter(const TomlValue& table, const std::string* change) {
  std::set<std::string> names;
  for (const TomlEntry& entry : table.entries)
    if (entry.value.kind == TomlValue::Kind::text && entry.key != "unit" && entry.key != "help")
      names.merge(names_in(entry.value.text));
  if (change) names.merge(names_in(*change));
  return names;
}

}  // namespace

void check_name_length(const TomlCursor& table, FilePlace place, std::string_view key,
                       const std::string& name) {
  constexpr std::size_t longest = 100;  // limit of muParser
  if (name.size() > longest)
    table.fail(place, key,
               fmt::format("a name has at most 100 letters, but '{}' has {}", shown(name, 20), name.size()));
}

void check_new_name(const TomlCursor& table, const TomlEntry& entry, std::string_view kind) {
  const auto taken = [&](const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), entry.key) != names.end();
  };
  check_name_length(table, entry.place, entry.key, entry.key);
  if (!is_identifier(entry.key))
    table.fail(
        entry.place, entry.key,
        fmt::format("'{}' is not a valid name for a {}; use letters, digits and '_', with no digit first",
                    entry.key, kind));
  if (taken(reserved_names()) || taken(function_names()))
    table.fail(
        entry.place, entry.key,
        fmt::format("the name '{}' is reserved; choose a name other than {} and the names of functions",
                    entry.key, join(reserved_names())));
}

Setting parse_setting(const std::string& assignment) {
  const std::size_t at = assignment.find('=');
  return {assignment.substr(0, at), assignment.substr(at + 1)};
}

std::string text_of(const Setting& setting) { return fmt::format("{}={}", setting.name, setting.value); }

Changes by_target(const std::vector<Setting>& settings) {
  Changes changes;
  for (const auto& [name, value, place] : settings) {
    if (std::ranges::find(infos, name, &SettingInfo::name) != std::end(infos))
      changes.general[name] = value;
    else if (name.starts_with(constant_prefix))
      changes.constants[name.substr(constant_prefix.size())] = value;
    else
      changes.parameters[name] = value;
  }
  return changes;
}

std::span<const SettingInfo> setting_infos() { return infos; }

const std::string* Changes::find(std::string_view name) const {
  const auto found = general.find(name);
  return found == general.end() ? nullptr : &found->second;
}

void resolve(SceneFile& file, std::string name, const std::string& value, const std::string& in_scene,
             const std::string& usual) {
  using enum ResolvedSetting::Source;
  const ResolvedSetting::Source source = value != in_scene ? setting : in_scene != usual ? scene : by_default;
  file.resolved.push_back({std::move(name), value, usual, source});
}

void resolve(SceneFile& file, std::string name, double value, double in_scene, double usual) {
  resolve(file, std::move(name), exact(value), exact(in_scene), exact(usual));
}

const ResolvedSetting* SceneFile::find_resolved(std::string_view name) const {
  const auto found = std::ranges::find(resolved, name, &ResolvedSetting::name);
  return found == resolved.end() ? nullptr : &*found;
}

std::vector<std::string> names_to_set(const SceneFile& file) {
  std::vector<std::string> names = names_of(file.parameters);
  for (const MethodConstant& constant : find_method(file.settings.method)->constants)
    names.push_back(std::string(constant_prefix) + std::string(constant.name));
  for (const SettingInfo& info : infos) names.emplace_back(info.name);
  return names;
}

void check_names(const Changes& changes, const SceneFile& file) {
  const std::vector<std::string> known = names_to_set(file);
  const auto check = [&](const std::string& name) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw UsageError(fmt::format(
          "'{}' cannot be set in the scene '{}' with the method '{}'{}; names that can be set: {}", name,
          file.scene.name, file.settings.method, did_you_mean(name, known), join(known)));
  };
  for (const auto& change : changes.parameters) check(change.first);
  for (const auto& change : changes.constants) check(std::string(constant_prefix) + change.first);
}

double changed_number(std::string_view name, const std::string& text, const Names& names) {
  double value = 0;
  try {
    value = evaluate(text, names);
  } catch (const ExpressionError& error) {
    throw UsageError(fmt::format("{}: {}", name, error.what()));
  }
  if (!std::isfinite(value))
    throw UsageError(fmt::format("{} = '{}' is {}; it must be a finite number", name, text, exact(value)));
  return value;
}

double changed_number(const KeyInfo& key, const std::string& text, const Names& names) {
  const double value = changed_number(key.name, text, names);
  if (const std::string wrong = against_bounds(key.type, value); !wrong.empty())
    throw UsageError(fmt::format("{} = {} {}", key.name, text, wrong));
  return value;
}

std::set<std::string> names_that_need_dp(TomlCursor& root, const Changes& changes) {
  std::set<std::string> needing = {"dp"};
  const TomlValue* parameters = root.find("parameters");
  if (!parameters) return needing;
  for (const TomlEntry& entry : parameters->entries) {
    const auto change = changes.parameters.find(entry.key);
    const auto names =
        names_in_parameter(entry.value, change == changes.parameters.end() ? nullptr : &change->second);
    if (std::any_of(names.begin(), names.end(), [&](const auto& name) { return needing.contains(name); }))
      needing.insert(entry.key);
  }
  return needing;
}

void read_parameters(TomlCursor& root, const Changes& changes, std::optional<double> dp, SceneFile& file) {
  const std::set<std::string> left_out = dp ? std::set<std::string>{} : names_that_need_dp(root, changes);
  constexpr std::size_t most_parameters = 500;  // reading time grows with the square
  TomlCursor parameters = root.section("parameters", "[parameters]", named_by_user);
  if (const auto& entries = parameters.table().entries; entries.size() > most_parameters)
    parameters.fail(
        entries.back().place, "",
        fmt::format("the scene has {} parameters; at most {} are allowed", entries.size(), most_parameters));
  Names names, defaults;
  if (dp) names["dp"] = defaults["dp"] = *dp;
  for (TomlEntry& entry : parameters.table().entries) {
    parameters.find(entry.key);
    check_new_name(parameters, entry, "parameter");
    if (left_out.contains(entry.key)) continue;
    TomlCursor cursor = parameters.enter(entry.value, entry.key, fmt::format("parameter '{}'", entry.key),
                                         keys_of("parameters"));
    const Parameter parameter = read_parameter(cursor, entry.key, changes, names, defaults);
    names[entry.key] = parameter.value;
    defaults[entry.key] = parameter.default_value;
    const bool changed = changes.parameters.contains(entry.key);
    resolve(file, entry.key, parameter.value, changed ? parameter.default_value : parameter.value,
            parameter.default_value);
    file.parameters.push_back(parameter);
  }
  root.names() = names;
}

}  // namespace taut::cli
