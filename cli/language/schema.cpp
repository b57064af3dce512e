#include "cli/language/schema.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/core.h>

#include "cli/scene/key_info.hpp"
#include "cli/scene/sections.hpp"
#include "cli/text/format.hpp"
#include "engine/diagnostics/measure_kinds.hpp"
#include "engine/methods/catalogue.hpp"

/// Uses oneOf: Taplo ignores if/then and skips tables with allOf.
namespace taut::cli {
namespace {

using Kind = KeyType::Kind;
using Form = KeyType::Form;

Json array_of(std::vector<Json> items) {
  Json array = Json::array();
  for (Json& item : items) array.add(std::move(item));
  return array;
}

using Keys = std::vector<std::string>;
Json requires_keys(const Keys& keys) { return {{"required", keys}}; }

void add_members(Json& to, const Json& from) {
  for (const auto& [name, member] : from.members()) to[name] = member;
}

void add_bounds(Json& schema, const NumberRange& bounds) {
  if (std::isfinite(bounds.low)) schema[bounds.open_low ? "exclusiveMinimum" : "minimum"] = bounds.low;
  if (std::isfinite(bounds.high)) schema[bounds.open_high ? "exclusiveMaximum" : "maximum"] = bounds.high;
}

Json number_schema(const char* type, const NumberRange& bounds) {
  Json schema{{"type", Keys{type, "string"}}};
  add_bounds(schema, bounds);
  return schema;
}

Json list_schema(Json items, std::size_t least, std::size_t most) {
  Json schema{{"type", "array"}, {"items", std::move(items)}};
  if (least > 0) schema["minItems"] = least;
  if (most != KeyType::any_size) schema["maxItems"] = most;
  return schema;
}

/// `dim` 0: 2D or 3D.
Json vector_schema(const KeyType& type, int dim) {
  const auto fixed = type.size > 0 ? type.size : static_cast<std::size_t>(dim);
  Json schema =
      list_schema(number_schema("number", type.bounds), fixed > 0 ? fixed : 2, fixed > 0 ? fixed : 3);
  if (type.other.empty()) return schema;
  schema["type"] = Keys{"array", "string"};
  schema["pattern"] = fmt::format("^{}$", type.other);
  return schema;
}

Json word_schema(const KeyType& type) {
  std::vector<std::string> words = words_of(type);
  if (type.other.starts_with('='))
    return {{"anyOf", array_of({{{"enum", words}}, {{"type", "string"}, {"pattern", "^=."}}})}};
  if (!type.other.empty()) words.emplace_back(type.other);
  return {{"enum", words}};
}

Json text_schema(const KeyType& type) {
  Json schema{{"type", "string"}};
  if (!type.pattern.empty()) schema["pattern"] = type.pattern;
  if (type.longest != KeyType::any_size) schema["maxLength"] = type.longest;
  return schema;
}

Json section_schema(std::string_view name);

Json one_schema(const KeyType& type, int dim) {
  switch (type.kind) {
    case Kind::flag:
      return {{"type", "boolean"}};
    case Kind::whole:
      return number_schema("integer", type.bounds);
    case Kind::number: {
      Json number = number_schema("number", type.bounds);
      if (type.section.empty()) return number;
      return {{"anyOf", array_of({number, section_schema(type.section)})}};
    }
    case Kind::vector:
      return vector_schema(type, dim);
    case Kind::word:
      return word_schema(type);
    case Kind::text:
      return text_schema(type);
    case Kind::table:
      return section_schema(type.section);
  }
  return {};
}

Json schema_of(const KeyType& type, int dim) {
  Json schema = one_schema(type, dim);
  if (type.form != Form::one) {
    Json list = list_schema(schema, type.least, type.most);
    for (std::size_t k = 1; k < type.depth; ++k) list = list_schema(std::move(list), 1, KeyType::any_size);
    schema = type.form == Form::list ? list : Json{{"anyOf", array_of({schema, list})}};
  }
  if (type.by.empty()) return schema;
  Json table{{"type", "object"}, {"additionalProperties", std::move(schema)}};
  if (!type.name_pattern.empty()) table["propertyNames"] = Json{{"pattern", type.name_pattern}};
  return table;
}

/// nullopt for texts such as "the method's".
std::optional<Json> default_value(const KeyInfo& key) {
  const std::string text(key.by_default);
  if (text.empty()) return std::nullopt;
  const std::vector<std::string> words = words_of(key.type);
  if (text == key.type.other || std::ranges::find(words, text) != words.end()) return Json(text);
  if (key.type.kind == Kind::flag) return Json(text == "true");
  if (key.type.kind == Kind::vector && text.starts_with('[')) return parse_json(text, "a default");
  const Json number = number_or_text(text);
  const bool takes_number = key.type.kind == Kind::number || key.type.kind == Kind::whole;
  return takes_number && number.is_number() ? std::optional(number) : std::nullopt;
}

bool has_alternatives(const KeyInfo& key) { return key.by_default.starts_with("or "); }

Json schema_of(const KeyInfo& key, int dim) {
  std::string description = fmt::format("{}: {}", type_text(key.type), key.help);
  const std::optional<Json> value = default_value(key);
  const bool says_default =
      !value && !key.by_default.empty() && key.by_default != "none" && !has_alternatives(key);
  if (says_default) description += ". Default: " + std::string(key.by_default);
  Json schema{{"description", description}};
  add_members(schema, schema_of(key.type, dim));
  if (value) schema["default"] = *value;
  return schema;
}

/// Alternative sets of keys, such as {bodies} and {body, wall}. A key's default text names the others.
std::vector<Keys> alternatives_to(const KeyInfo& first, std::span<const KeyInfo> keys) {
  const std::string named = std::string(first.by_default) + " ";
  const auto is_named = [&](const KeyInfo& key) {
    return named.find(fmt::format(" {} ", key.name)) != std::string::npos;
  };
  std::vector<std::string_view> defaults{first.by_default};
  for (const KeyInfo& key : keys)
    if (is_named(key) && std::ranges::find(defaults, key.by_default) == defaults.end())
      defaults.push_back(key.by_default);
  std::vector<Keys> sets;
  for (const std::string_view text : defaults) {
    Keys& set = sets.emplace_back();
    for (const KeyInfo& key : keys)
      if (key.by_default == text) set.emplace_back(key.name);
  }
  return sets;
}

std::vector<Keys> choices(std::span<const KeyInfo> keys) {
  std::vector<Keys> all;
  Keys known;
  for (const KeyInfo& key : keys) {
    if (!has_alternatives(key) || std::ranges::find(known, key.name) != known.end()) continue;
    std::vector<Keys> longer;
    for (const Keys& set : alternatives_to(key, keys)) {
      known.insert(known.end(), set.begin(), set.end());
      for (Keys choice : all.empty() ? std::vector<Keys>(1) : all) {
        choice.insert(choice.end(), set.begin(), set.end());
        longer.push_back(std::move(choice));
      }
    }
    all = std::move(longer);
  }
  return all;
}

Json table_schema(std::span<const KeyInfo> keys, int dim) {
  Json properties = Json::object();
  Json schema{{"type", "object"}, {"properties", nullptr}, {"additionalProperties", false}};
  Keys needed;
  for (const KeyInfo& key : keys) {
    if (key.name == any_name) {
      schema["additionalProperties"] = schema_of(key, dim);
      if (key.by_default.empty()) schema["minProperties"] = 1;
      continue;
    }
    properties[key.name] = schema_of(key, dim);
    if (key.by_default.empty()) needed.emplace_back(key.name);
  }
  schema["properties"] = properties;
  if (!needed.empty()) schema["required"] = needed;
  std::vector<Json> alternatives;
  for (const Keys& choice : choices(keys)) alternatives.push_back(requires_keys(choice));
  const bool both =
      std::ranges::any_of(keys, [](const KeyInfo& key) { return key.by_default.ends_with(" or both"); });
  if (!alternatives.empty()) schema[both ? "anyOf" : "oneOf"] = array_of(std::move(alternatives));
  return schema;
}

Json kind_schema(std::string_view section, std::string_view tag, std::string_view name, std::string_view help,
                 std::span<const KeyInfo> of_kind, int dim) {
  const std::span<const KeyInfo> common = keys_of(section);
  std::vector<KeyInfo> keys(common.begin(), common.end());
  keys.insert(keys.end(), of_kind.begin(), of_kind.end());
  Json schema = table_schema(keys, dim);
  schema["properties"][tag] = Json{{"const", name}, {"description", help}};
  return schema;
}

Json shape_schema() {
  std::vector<Json> kinds;
  for (const ShapeKind& kind : shape_kinds())
    kinds.push_back(kind_schema("shape", "type", kind.name, kind.help, kind.keys, kind.dim));
  return {{"oneOf", array_of(std::move(kinds))}};
}

Json section_schema(std::string_view name) {
  std::vector<Json> kinds;
  if (name == "shape") return {{"$ref", "#/definitions/shape"}};
  if (name == "probe")
    for (const ProbeKind& kind : probe_kinds())
      kinds.push_back(kind_schema(name, "of", kind.name, kind.help, kind.keys, 0));
  if (name == "measure")
    for (const MeasureKind& kind : measure_kinds())
      kinds.push_back(kind_schema(name, "of", kind.name, kind.help, keys_of_measure(kind), 0));
  return kinds.empty() ? table_schema(keys_of(name), 0) : Json{{"oneOf", array_of(std::move(kinds))}};
}

/// Allows values valid in 2D or 3D.
Json constant_schema(const MethodConstant& constant, const std::vector<MethodConstant>& in_3d) {
  if (!constant.choices.empty())
    return {{"description", constant.help},
            {"default", constant.choices.front()},
            {"enum", Keys(constant.choices.begin(), constant.choices.end())}};
  if (constant.is_switch)
    return {{"description", constant.help}, {"default", constant.value}, {"enum", array_of({0, 1})}};
  NumberRange bounds{constant.low, constant.high};
  const auto other = std::ranges::find(in_3d, constant.name, &MethodConstant::name);
  if (other != in_3d.end()) bounds = {std::min(bounds.low, other->low), std::max(bounds.high, other->high)};
  Json schema = number_schema("number", bounds);
  schema["description"] = constant.help;
  schema["default"] = constant.value;
  return schema;
}

Json constants_schema(const MethodInfo& method) {
  const std::vector<MethodConstant> in_3d = method_constants(method.formulation, 3);
  Json constants = Json::object();
  for (const MethodConstant& constant : method.constants)
    constants[constant.name] = constant_schema(constant, in_3d);
  return {{"properties", constants}, {"additionalProperties", false}};
}

Json checks_of_methods() {
  Json checks;
  for (const MethodInfo& method : methods()) {
    Json is_method{{"properties", Json{{"method", Json{{"const", method.name}}}}}};
    if (method.name != default_method) is_method["required"] = Keys{"method"};
    Keys laws_of_method;
    for (const LawRow& law : laws())
      if (!law.choice.empty() && reason_against_law(method, law.choice).empty())
        laws_of_method.emplace_back(law.choice);
    // not `false`: for that, python3-jsonschema 4.19 does not name the key
    Json law = laws_of_method.empty() ? Json{{"not", Json::object()}} : Json{{"enum", laws_of_method}};
    Json link{
        {"if", is_method},
        {"then", Json{{"properties", Json{{"method_constants", constants_schema(method)}, {"law", law}}}}}};
    if (!checks.is_null()) link["else"] = checks;
    checks = link;
  }
  return checks;
}

Json all_constants() {
  Json all = Json::object();
  for (const MethodInfo& method : methods())
    for (const MethodConstant& constant : method.constants)
      if (!all.find(constant.name))
        all[constant.name] = Json{{"type", Keys{"number", "string"}}, {"description", constant.help}};
  return all;
}

Json file_schema(const char* title, std::string_view section) {
  Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}};
  add_members(schema, section_schema(section));
  return schema;
}

}  // namespace

Json scene_schema() {
  Json schema = file_schema("A scene of taut. A number can also be an expression in quotes", "scene");
  schema["properties"]["method_constants"]["properties"] = all_constants();
  add_members(schema, checks_of_methods());
  schema["definitions"] = Json{{"shape", shape_schema()}};
  return schema;
}

Json sweep_schema() { return file_schema("A sweep of scenes of taut", "sweep"); }

Json suite_schema() { return file_schema("A suite of snapshots, for taut snapshot", "suite"); }

Json claim_schema() { return file_schema("Statements of a paper, for taut claims", "claims"); }

}  // namespace taut::cli
