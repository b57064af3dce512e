#include "cli/language/reference.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "cli/scene/expression.hpp"
#include "cli/scene/key_info.hpp"
#include "cli/scene/sections.hpp"
#include "cli/text/format.hpp"
#include "cli/text/markdown.hpp"
#include "engine/diagnostics/fields.hpp"
#include "engine/diagnostics/measure_kinds.hpp"
#include "engine/judge/verdict.hpp"
#include "engine/methods/catalogue.hpp"
#include "render/colormap.hpp"

namespace taut::cli {
namespace {

using Texts = std::vector<std::string>;

std::string text(std::string_view view) { return std::string(view); }

Texts key_row(const KeyInfo& key) {
  return {text(key.name), type_text(key.type), text(key.by_default.empty() ? "needed" : key.by_default),
          text(key.help)};
}

const Texts key_heads{"key", "takes", "default", "what"};

Rows rows_of(std::span<const KeyInfo> keys) {
  Rows rows{key_heads};
  for (const KeyInfo& key : keys) rows.push_back(key_row(key));
  return rows;
}

std::string names_of_keys(std::span<const KeyInfo> keys) {
  Texts names;
  for (const KeyInfo& key : keys) names.push_back(text(key.name));
  return join(names);
}

std::string compared_with(const MeasureKind& kind) {
  Texts compared;
  if (kind.number) compared.emplace_back("number");
  if (kind.table) compared.emplace_back("table");
  if (kind.solution || kind.number) compared.emplace_back("solution");
  return join_with_or(compared);
}

Topic topic_of(const Section& section) {
  return {text(section.name), text(section.header), text(section.help), rows_of(section.keys),
          text(example_of(section.name))};
}

std::string dim_text(const ShapeKind& shape) { return shape.dim == 0 ? "2, 3" : std::to_string(shape.dim); }

Topic topic_of(const ShapeKind& shape) {
  return {text(shape.name), fmt::format(R"(type = "{}")", shape.name),
          fmt::format("a shape, dim = {}: {}", dim_text(shape), shape.help), rows_of(shape.keys),
          text(example_of(shape.name))};
}

Topic topic_of(const ProbeKind& probe) {
  return {text(probe.name), fmt::format(R"(of = "{}")", probe.name),
          fmt::format("a probe, {}: {}", probe.unit, probe.help), rows_of(probe.keys), ""};
}

Topic topic_of(const MeasureKind& kind) {
  return {text(kind.name), fmt::format(R"(of = "{}")", kind.name), "a measure: " + text(kind.help),
          rows_of(keys_of_measure(kind)), ""};
}

template <class Kinds, class Keys>
Rows keys_of_kinds(const Kinds& kinds, const Keys& keys_of_kind) {
  Rows rows{{"key", "takes", "default", "what", "of"}};
  for (const auto& kind : kinds)
    for (const KeyInfo& key : keys_of_kind(kind)) {
      Texts row = key_row(key);
      const auto same = [&](const Texts& r) { return std::equal(row.begin(), row.end(), r.begin()); };
      if (const auto found = std::ranges::find_if(rows, same); found != rows.end()) {
        found->back() += ", " + text(kind.name);
      } else {
        row.push_back(text(kind.name));
        rows.push_back(std::move(row));
      }
    }
  return rows;
}

const auto own_keys = [](const auto& kind) -> const auto& { return kind.keys; };

Topic shapes() {
  std::string examples;
  for (const ShapeKind& kind : shape_kinds()) examples += example_of(kind.name);
  return {"shapes", "type = ...", "shapes and their dimensions", shape_rows(), examples};
}

Topic shape_keys() { return {"keys of shapes", "", "", keys_of_kinds(shape_kinds(), own_keys), ""}; }

Topic probes() { return {"probes", "of = ...", "kinds of probes", probe_rows(), ""}; }

Topic probe_keys() { return {"keys of probes", "", "", keys_of_kinds(probe_kinds(), own_keys), ""}; }

Topic measures() {
  return {"measures", "of = ...", "kinds of measures, and the reference data with which each can be compared",
          measure_rows(), ""};
}

Topic measure_keys() {
  return {"keys of measures", "", "", keys_of_kinds(measure_kinds(), keys_of_measure), ""};
}

std::vector<Topic> lists() {
  return {{"methods", "METHOD", "methods; `taut describe METHOD` shows their constants", method_rows(), ""},
          {"laws", "LAW", "laws of elasticity; a reference can also be for 2d-deviator", law_rows(), ""},
          {"contacts", "CONTACT", "contact laws between bodies", contact_rows(), ""},
          {"fields", "FIELD", "fields for the colours of particles and for lines", field_rows(), ""},
          {"colormaps", "colour map", "colour maps of the fields", colormap_rows(), ""}};
}

void add_rows(std::vector<Topic>& topics, std::string_view what, const Rows& rows) {
  for (std::size_t r = 1; r < rows.size(); ++r)
    topics.push_back({rows[r].front(), "", text(what), {rows.front(), rows[r]}, ""});
}

std::vector<Topic> all_topics() {
  std::vector<Topic> all = scene_language().topics;
  for (const LanguageFile& file : {sweep_language(), claim_language(), suite_language()})
    all.insert(all.end(), file.topics.begin(), file.topics.end());
  for (const ShapeKind& kind : shape_kinds()) all.push_back(topic_of(kind));
  for (const ProbeKind& kind : probe_kinds()) all.push_back(topic_of(kind));
  for (const MeasureKind& kind : measure_kinds()) all.push_back(topic_of(kind));
  add_rows(all, "a law of elasticity", law_rows());
  add_rows(all, "a contact law", contact_rows());
  add_rows(all, "a field that colours particles", field_rows());
  add_rows(all, "a colour map", colormap_rows());
  return all;
}

std::vector<Topic> topics_of_key(std::string_view name) {
  Rows rows = key_rows();
  std::erase_if(rows, [&](const Texts& row) { return row != rows.front() && row.front() != name; });
  if (rows.size() == 1) return {};
  return {{text(name), "", "a key of scene, sweep, claim or suite files", std::move(rows), ""}};
}

std::string indented(std::string_view lines) {
  std::string result;
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    result.append(end == 0 ? "" : "      ").append(lines.substr(0, end)).append("\n");
    lines.remove_prefix(std::min(end + 1, lines.size()));
  }
  return result;
}

/// markdown_table() escapes vertical bars.
std::string plain(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '<' || c == '*' || c == '_') result += '\\';
    result += c;
  }
  return result;
}

std::string code(const std::string& text) { return fmt::format("`{}`", text); }

Rows marked_up(Rows rows) {
  for (std::size_t r = 1; r < rows.size(); ++r) {
    const std::string name = rows[r].front();
    std::ranges::transform(rows[r], rows[r].begin(), plain);
    rows[r].front() = code(name);
  }
  return rows;
}

std::string markdown(const Topic& topic) {
  std::string page = fmt::format("### {}\n\n", topic.name);
  if (!topic.help.empty())
    page += fmt::format("{}{}.\n\n", topic.header.empty() ? "" : code(topic.header) + ": ", topic.help);
  if (topic.rows.size() > 1) page += markdown_table(marked_up(topic.rows));
  if (!topic.example.empty()) page += fmt::format("\n```toml\n{}```\n", topic.example);
  return page + "\n";
}

std::string markdown(const LanguageFile& file) {
  std::string page;
  for (const std::string& rule : file.rules) page += fmt::format("- {}\n", rule);
  page += "\n";
  for (const Topic& topic : file.topics) page += markdown(topic);
  return page;
}

const Texts scene_rules{
    "A scene is a TOML file with lines `key = value` under a [header]. "
    "A [[header]] can occur several times, once for each object. "
    "Keys above the first header belong to the file itself. `#` begins a comment. "
    "A scene needs `spacing`, `until`, a material and a body.",
    "Numbers are in SI units, angles in degrees. They are written without a unit: 1e7 for 10 MPa, 0.005 for 5 mm.",
    fmt::format(
        "Every number may be an expression in quotes: \"0.06 + 4*dp\", \"x > 0.1 ? 1 : 0\", \"x < 0 && y > 0\". "
        "Operators: + - * / ^, < <= > >= == !=, && (and), || (or), CONDITION ? A : B. Functions: {}.",
        join(function_names())),
    "Names in expressions: "
    "the parameters, `dp` (the spacing), `pi`, and `touching` (the gap below which bodies count as touching). "
    "Expressions about a body of one material can also use its `c0`, `E`, `nu`, `rho`, `K` and `G`. "
    "Expressions \"of the place\" can use `x`, `y` and in 3D `z`, the position in the initial configuration in m. "
    "Expressions \"of t\" can use the time `t` in s.",
    "A place or a vector has one component for each axis: [x, y], or [x, y, z] with dim = 3.",
    "In 2D, forces and masses are per metre of depth.",
    "Each of these is an error: "
    "an unknown or unused key, a wrong type, a value out of bounds, and an unused parameter or material. "
    "The message gives the place and the allowed values or the nearest known names.",
    "Limits: 20 million particles, 500 parameters, 20 000 letters in an expression, 100 letters in a name, "
    "200 bytes in a title or a help. The file cli/PROMISES.md of the sources lists all limits.",
    "`taut run my.toml` runs the scene, and `taut describe my.toml` prints the scene as it was read. "
    "`taut describe NAME` explains one section, shape, probe or measure of this page.",
    "`taut describe scene-file --schema > scene.schema.json` writes a JSON Schema. "
    "An editor that reads it, such as VS Code with Even Better TOML, "
    "completes and checks a scene whose first line is `#:schema ./scene.schema.json`."};

std::string general_settings() {
  Texts names;
  for (const SettingInfo& info : setting_infos()) names.emplace_back(info.name);
  return join(names);
}

const Texts sweep_rules{
    "A sweep is a TOML file that runs a scene with every combination of its [grid], once for each [[row]], or both: "
    "`taut sweep my-sweep.toml`.",
    fmt::format(
        "Names that can be set: the parameters of the scene; method.NAME, a constant of the method; {}.",
        general_settings()),
    "A study is a sweep with a [chart], a [map] or a [history], which draw its results."};

const Texts claim_rules{
    "A claim file is a TOML file with statements of a paper; its name is the key of the paper. "
    "`taut claims PAPER` lists the claims, and `taut claims PAPER --all` runs them.",
    fmt::format(
        "A criterion is an expression, as in scenes, of quantities of the runs. "
        "Names of verdicts, from best to worst: {}. "
        "`RUN.since.VERDICT` is the time in s at which a failure began, or infinite if it never began. "
        "If a measure has no value, the claim does not agree with its recorded state.",
        join(names_of_verdicts())),
    "A claim holds if its criterion is true, holds in part if only `part` is true, and otherwise does not hold. "
    "`taut claims --run` compares the result with the recorded `state`."};

const Texts suite_rules{
    "A suite is a TOML file with scenes whose frames are compared with baselines: "
    "`taut snapshot my-suite.toml --update` makes the baselines, and `taut snapshot my-suite.toml` compares.",
    "A baseline keeps the view and the colour range with which it was made.",
    "Keys of an entry override those of the suite, and these override the scene."};

}  // namespace

Rows shape_rows() {
  Rows rows{{"name", "dim", "keys", "help"}};
  for (const ShapeKind& kind : shape_kinds())
    rows.push_back({text(kind.name), dim_text(kind), names_of_keys(kind.keys), text(kind.help)});
  return rows;
}

Rows probe_rows() {
  Rows rows{{"name", "unit", "keys", "help"}};
  for (const ProbeKind& kind : probe_kinds())
    rows.push_back({text(kind.name), text(kind.unit), names_of_keys(kind.keys), text(kind.help)});
  return rows;
}

Rows measure_rows() {
  Rows rows{{"name", "keys", "reference", "help"}};
  for (const MeasureKind& kind : measure_kinds())
    rows.push_back(
        {text(kind.name), join({kind.keys.begin(), kind.keys.end()}), compared_with(kind), text(kind.help)});
  return rows;
}

Rows law_rows() {
  Rows rows{{"name", "methods", "in run.json", "help"}};
  for (const LawRow& law : laws()) {
    if (law.choice.empty()) continue;
    Texts takers;
    for (const MethodInfo& method : methods())
      if (reason_against_law(method, law.choice).empty()) takers.push_back(text(method.name));
    rows.push_back({text(law.choice), join(takers), text(law.material_law),
                    fmt::format("{}, {}", law.term.what, law.term.source)});
  }
  Texts others;
  for (const MethodInfo& method : methods())
    if (method.material_law == in_plane_law) others.push_back(text(method.name));
  rows.push_back(
      {law_name(in_plane_law), join(others), text(in_plane_law),
       "the published law of these methods in 2D; references can be for it, but it cannot be chosen"});
  return rows;
}

Rows contact_rows() {
  Rows rows{{"name", "help"}};
  for (const ContactChoice& choice : contact_choices())
    rows.push_back({text(name(choice.law)), text(choice.help)});
  return rows;
}

Rows field_rows() {
  Rows rows{{"name", "unit", "help"}};
  for (const Field& field : fields()) rows.push_back({text(field.key), text(field.unit), text(field.help)});
  return rows;
}

Rows colormap_rows() {
  Rows rows{{"name", "help"}};
  for (const render::Colormap& map : render::colormaps()) rows.push_back({text(map.key), text(map.help)});
  return rows;
}

Rows method_rows() {
  Rows rows{{"name", "summary", "paper"}};
  for (const MethodInfo& method : methods())
    rows.push_back({text(method.name), text(method.summary), text(method.paper)});
  return rows;
}

Rows key_rows() {
  Rows rows{{"name", "section", "takes", "default", "help"}};
  const auto add = [&](std::string_view section, std::span<const KeyInfo> keys) {
    for (const KeyInfo& key : keys) {
      Texts row = key_row(key);
      row.insert(row.begin() + 1, text(section));
      rows.push_back(std::move(row));
    }
  };
  for (const auto& sections : {scene_sections(), sweep_sections(), claim_sections(), suite_sections()})
    for (const Section& section : sections) add(section.name, section.keys);
  for (const ShapeKind& kind : shape_kinds()) add("shape " + text(kind.name), kind.keys);
  for (const ProbeKind& kind : probe_kinds()) add("probe " + text(kind.name), kind.keys);
  for (const MeasureKind& kind : measure_kinds()) add("measure " + text(kind.name), keys_of_measure(kind));
  return rows;
}

LanguageFile scene_language() {
  LanguageFile file{"scene-file", scene_rules, {}};
  for (const Section& section : scene_sections()) {
    file.topics.push_back(topic_of(section));
    if (section.name == "shape") file.topics.insert(file.topics.end(), {shapes(), shape_keys()});
    if (section.name == "probe") file.topics.insert(file.topics.end(), {probes(), probe_keys()});
    if (section.name == "measure") file.topics.insert(file.topics.end(), {measures(), measure_keys()});
  }
  const std::vector<Topic> more = lists();
  file.topics.insert(file.topics.end(), more.begin(), more.end());
  return file;
}

LanguageFile sweep_language() {
  LanguageFile file{"sweep-file", sweep_rules, {}};
  for (const Section& section : sweep_sections()) file.topics.push_back(topic_of(section));
  return file;
}

LanguageFile claim_language() {
  LanguageFile file{"claim-file", claim_rules, {}};
  for (const Section& section : claim_sections()) file.topics.push_back(topic_of(section));
  return file;
}

LanguageFile suite_language() {
  LanguageFile file{"suite-file", suite_rules, {}};
  for (const Section& section : suite_sections()) file.topics.push_back(topic_of(section));
  return file;
}

std::vector<Topic> find_topics(std::string_view name) {
  std::vector<Topic> found = all_topics();
  std::erase_if(found, [=](const Topic& topic) { return topic.name != name; });
  return found.empty() ? topics_of_key(name) : found;
}

std::vector<std::string> topic_names() {
  Texts names;
  for (const Topic& topic : all_topics())
    if (std::ranges::find(names, topic.name) == names.end()) names.push_back(topic.name);
  return names;
}

std::string as_text(const Topic& topic, std::optional<std::size_t> columns) {
  std::string head = topic.name;
  if (!topic.header.empty()) head += ": " + topic.header;
  if (!topic.help.empty()) head += ", " + topic.help;
  std::string result = (columns ? wrapped(head, 0, *columns) : head) + "\n";
  if (topic.rows.size() > 1) result += in_columns(topic.rows, 2, columns);
  if (!topic.example.empty()) result += "  example\n" + indented(topic.example);
  return result;
}

std::string as_text(const LanguageFile& file, std::optional<std::size_t> columns) {
  std::string result;
  for (const std::string& rule : file.rules) result += (columns ? wrapped(rule, 0, *columns) : rule) + "\n\n";
  for (const Topic& topic : file.topics) result += as_text(topic, columns) + "\n";
  return result;
}

std::string language_page() {
  return fmt::format(
      "# The language of scene, sweep, claim and suite files\n\n"
      "This page is the output of `taut describe scene-file`, `sweep-file`, `claim-file` and `suite-file`. "
      "A test checks that\n"
      "it is up to date, and `TAUT_UPDATE_GOLDEN=1` rewrites it. Rules, choices and worked examples: "
      "[SCENE-FILES.md](SCENE-FILES.md).\n\n"
      "## Scene files\n\n{}## Sweep files\n\n{}## Claim files\n\n{}## Suite files\n\n{}",
      markdown(scene_language()), markdown(sweep_language()), markdown(claim_language()),
      markdown(suite_language()));
}

}  // namespace taut::cli
