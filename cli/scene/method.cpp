#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "cli/scene/sections.hpp"
#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"
#include "engine/diagnostics/fields.hpp"
#include "engine/methods/catalogue.hpp"

namespace taut::cli {
namespace {

const std::vector<ContactChoice>& contacts() {
  static const auto all = [] {
    std::vector<ContactChoice> choices{
        {ContactLaw::published, "default contact law of the method: `taut describe METHOD`"}};
    for (const ContactLawRow& row : contact_rows()) choices.push_back({row.law, row.help});
    return choices;
  }();
  return all;
}

std::vector<std::string> names_of_contacts() {
  std::vector<std::string> names;
  for (const ContactChoice& choice : contacts()) names.emplace_back(name(choice.law));
  return names;
}

/// `setting`: name in --set.
std::string chosen(TomlCursor& table, const std::string& key, const std::vector<std::string>& names,
                   const std::string& setting, const std::string* change, SceneFile& file) {
  table.text(key, names.front());
  const std::string in_scene = table.choice(key, names);
  if (change && std::ranges::find(names, *change) == names.end())
    throw UsageError(unknown_name(setting, *change, names));
  const std::string value = change ? *change : in_scene;
  if (change) table.table().set(key, TomlValue(value));
  resolve(file, setting, value, in_scene, names.front());
  return value;
}

std::vector<std::string> names_of_choices(const MethodConstant& constant) {
  return {constant.choices.begin(), constant.choices.end()};
}

std::string bounds_text(const MethodConstant& constant) {
  return fmt::format("; allowed: {} {} {}", exact(constant.low), constant.is_switch ? "or" : "to",
                     exact(constant.high));
}

bool within_bounds(const MethodConstant& constant, double value) {
  return value >= constant.low && value <= constant.high &&
         (!constant.is_switch || value == std::floor(value));
}

const MethodInfo& file_method(TomlCursor& root) {
  const std::string name = root.text("method", default_method);
  const MethodInfo* method = find_method(name);
  if (!method) root.fail_unknown(*root.find("method"), "method", "method", name, names_of(methods()));
  return *method;
}

const MethodInfo& changed_method(const std::string& name) {
  const MethodInfo* method = find_method(name);
  if (!method) throw UsageError(unknown_name("method", name, names_of(methods())));
  return *method;
}

void check_constants(TomlCursor& section, const MethodInfo& method, int dim) {
  const std::vector<MethodConstant> constants = method_constants(method.formulation, dim);
  for (TomlEntry& entry : section.table().entries) {
    const std::size_t i = index_of(constants, entry.key);
    if (i == constants.size())
      section.fail(entry.place, entry.key,
                   fmt::format("the method '{}' has no constant '{}'{}; its constants: {}", method.name,
                               entry.key, did_you_mean(entry.key, names_of(constants)),
                               constants.empty() ? "none" : join(names_of(constants))));
    if (!constants[i].choices.empty()) {
      section.choice(entry.key, names_of_choices(constants[i]));
      continue;
    }
    const double value = section.number(entry.key);
    if (!within_bounds(constants[i], value))
      section.fail(
          entry.value, entry.key,
          fmt::format("{} = {} is out of bounds{}", entry.key, exact(value), bounds_text(constants[i])));
  }
}

void read_constants(TomlCursor& root, const MethodInfo& of_file, const MethodInfo& method, int dim,
                    const Changes& changes, SceneFile& file) {
  TomlCursor section = root.section("method_constants", "[method_constants]", named_by_user);
  check_constants(section, of_file, dim);
  if (&of_file != &method) section.table().entries.clear();
  for (const MethodConstant& constant : method_constants(method.formulation, dim)) {
    const std::string name(constant.name), setting = std::string(constant_prefix) + name;
    const auto change = changes.constants.find(name);
    const std::string* given = change == changes.constants.end() ? nullptr : &change->second;
    if (const std::vector<std::string> choices = names_of_choices(constant); !choices.empty()) {
      const std::string choice = chosen(section, name, choices, setting, given, file);
      file.settings.constants[name] = std::ranges::find(choices, choice) - choices.begin();
      continue;
    }
    const double in_scene = section.number(name, constant.value);
    double value = in_scene;
    if (given) {
      value = changed_number(setting, *given, root.names());
      if (!within_bounds(constant, value))
        throw UsageError(fmt::format("{} = {} is out of bounds{}", setting, *given, bounds_text(constant)));
    }
    section.table().set(name, TomlValue(value));
    file.settings.constants[name] = value;
    resolve(file, setting, value, in_scene, constant.value);
  }
}

std::vector<std::string> names_of_elastic_laws() {
  std::vector<std::string> names;
  for (const LawRow& law : laws())
    if (!law.choice.empty()) names.emplace_back(law.choice);
  return names;
}

std::string law_of_file(TomlCursor& root, const MethodInfo& of_file) {
  const TomlValue* given = root.find("law");
  if (!given) return "";
  const std::string law = root.choice("law", names_of_elastic_laws());
  if (const std::string reason = reason_against_law(of_file, law); !reason.empty())
    root.fail(*given, "law", reason);
  return law;
}

/// Law of the settings, else of the file if `method` supports it, else the first of `method`.
void read_law(TomlCursor& root, const MethodInfo& of_file, const MethodInfo& method, const Changes& changes,
              SceneFile& file) {
  const std::string own = method.laws.empty() ? "" : std::string(method.laws.front().name);
  const std::string given = law_of_file(root, of_file);
  const bool fits = given.empty() || reason_against_law(method, given).empty();
  const std::string in_scene = fits && !given.empty() ? given : own;
  std::string& law = file.settings.law = in_scene;
  if (const std::string* change = changes.find("law")) {
    const std::vector<std::string> known = names_of_elastic_laws();
    if (std::ranges::find(known, *change) == known.end())
      throw UsageError(unknown_name("law", *change, known));
    law = *change;
    if (const std::string reason = reason_against_law(method, law); !reason.empty()) throw UsageError(reason);
  } else if (!fits) {
    file.remark = fmt::format("the method '{}' does not support the law of the scene, '{}'; it runs with {}",
                              method.name, given, own.empty() ? "its own law" : own);
  }
  resolve(file, "law", law, in_scene, own);
  if (law.empty())
    std::erase_if(root.table().entries, [](const TomlEntry& entry) { return entry.key == "law"; });
  else
    root.table().set("law", TomlValue(law));
}

}  // namespace

std::span<const ContactChoice> contact_choices() { return contacts(); }

std::string law_name(std::string_view material_law) {
  const auto law = std::ranges::find(laws(), material_law, &LawRow::material_law);
  if (law != laws().end() && !law->choice.empty()) return std::string(law->choice);
  std::string name(material_law);
  std::ranges::replace(name, '_', '-');
  return name;
}

std::vector<std::string> allowed_words(std::string_view name) {
  if (name == "method") return names_of(methods());
  if (name == "stepping") return words_of(key_of_scene(name).type);
  if (name == "law") return names_of_elastic_laws();
  for (const MethodInfo& method : methods())
    for (const MethodConstant& constant : method.constants)
      if (name == std::string(constant_prefix).append(constant.name)) return names_of_choices(constant);
  return name == "contact" ? names_of_contacts() : std::vector<std::string>();
}

void name_touching(TomlCursor& root, const SceneFile& file) {
  const MethodInfo& method = *find_method(file.settings.method);
  const ContactLaw law = file.scene.contact == ContactLaw::published ? published_contact(file.scene, method)
                                                                     : file.scene.contact;
  const double spacings = std::ranges::find(contact_rows(), law, &ContactLawRow::law)->touching;
  root.names()["touching"] = spacings * root.names().at("dp");
}

void read_settings(TomlCursor& root, const Changes& changes, SceneFile& file) {
  const MethodInfo& of_file = file_method(root);
  const std::string* change = changes.find("method");
  const MethodInfo& method = change ? changed_method(*change) : of_file;
  file.settings.method = std::string(method.name);
  resolve(file, "method", file.settings.method, std::string(of_file.name), std::string(default_method));
  root.table().set("method", TomlValue(file.settings.method));
  check_names(changes, file);

  const auto chosen_word = [&](const std::string& key) {
    return chosen(root, key, words_of(key_of_scene(key).type), key, changes.find(key), file);
  };
  const std::string stepping = chosen_word("stepping");
  file.settings.stepping = stepping == "dual" ? Stepping::dual : Stepping::single;
  const std::string contact = chosen_word("contact");
  file.scene.contact =
      std::ranges::find(contacts(), contact, [](const ContactChoice& c) { return name(c.law); })->law;
  name_touching(root, file);

  read_law(root, of_file, method, changes, file);
  // constants and CFL number of the file belong to its method
  const double cfl_of_file = root.find("cfl") ? root.number("cfl") : of_file.cfl;
  const double in_scene = &method == &of_file ? cfl_of_file : method.cfl;
  const std::string* cfl_change = changes.find("cfl");
  const double cfl = cfl_change ? changed_number(key_of_scene("cfl"), *cfl_change, root.names()) : in_scene;
  resolve(file, "cfl", cfl, in_scene, method.cfl);
  root.table().set("cfl", TomlValue(cfl));
  file.settings.cfl = cfl;
  read_constants(root, of_file, method, file.scene.dim, changes, file);
}

}  // namespace taut::cli
