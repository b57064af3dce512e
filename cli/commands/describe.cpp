#include <algorithm>
#include <array>
#include <cstddef>
#include <ostream>

#include <fmt/core.h>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/language/reference.hpp"
#include "cli/language/schema.hpp"
#include "cli/scene/scene_file.hpp"
#include "cli/scene/sections.hpp"
#include "cli/scene/shipped.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/system/terminal_columns.hpp"
#include "cli/text/format.hpp"
#include "cli/text/json.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"
#include "engine/methods/catalogue.hpp"

namespace taut::cli {
namespace {

std::string bounds(std::optional<double> low, std::optional<double> high) {
  if (!low && !high) return "any";
  return fmt::format("{} to {}", low ? brief(*low) : "-inf", high ? brief(*high) : "inf");
}

void print_table(std::ostream& out, std::string_view title, const Rows& rows, std::size_t headers = 0) {
  if (rows.size() > headers) out << '\n' << title << '\n' << in_columns(rows, 2, text_columns(out));
}

Rows material_rows(const Scene& scene) {
  Rows rows{{"name", "density", "Young's modulus", "Poisson's ratio", "bulk modulus", "sound speed"}};
  for (const Material& m : scene.materials)
    rows.push_back({m.name, brief(m.density) + " kg/m³", brief(m.youngs_modulus) + " Pa",
                    brief(m.poisson_ratio), brief(m.bulk_modulus()) + " Pa",
                    brief(m.sound_speed()) + " m/s"});
  return rows;
}

Rows parameter_rows(const std::vector<Parameter>& parameters) {
  Rows rows{{"name", "default", "unit", "bounds", "meaning"}};
  for (const Parameter& p : parameters)
    rows.push_back({p.name, brief(p.value), p.unit.empty() ? "-" : p.unit, bounds(p.low, p.high), p.help});
  return rows;
}

Rows line_rows(const Scene& scene) {
  Rows rows{{"name", "field", "points", "times"}};
  for (const SampleLine& line : scene.lines) {
    std::string times;
    for (const double t : line.times) times += (times.empty() ? "" : ", ") + brief(t);
    rows.push_back({line.name, line.field, std::to_string(line.points), times + " s"});
  }
  return rows;
}

Rows rows_of_measures(const Scene& scene) {
  Rows rows{{"name", "kind", "unit", "references"}};
  for (const Measure& m : scene.measures) {
    std::string names;
    for (const auto& [law, reference] : scene.references)
      if (reference.has(m.name))
        names +=
            fmt::format("{}{} ({})", names.empty() ? "" : "; ", reference.name_for(m.name), law_name(law));
    rows.push_back({m.name, m.kind, m.unit.empty() ? "-" : m.unit, names.empty() ? "none" : names});
  }
  return rows;
}

std::string axes_of(const std::array<Expression, 3>& components) {
  std::string axes;
  for (std::size_t k = 0; k < components.size(); ++k)
    if (components[k]) axes += (axes.empty() ? "" : " and ") + std::string(1, "xyz"[k]);
  return axes;
}

std::string motion_text(const Body& body) {
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  if (const std::string along = axes_of(body.guided); !along.empty())
    add(fmt::format("clamped along {} in a region", along));
  else if (body.clamped)
    add("clamped in a region");
  if (const std::string along = axes_of(body.displacement); !along.empty())
    add(fmt::format("displaced along {} at the start", along));
  for (const Drive& drive : body.drives)
    add("driven in a region" + (drive.until ? fmt::format(" until {} s", brief(*drive.until)) : ""));
  for (const Load& load : body.loads) add("loaded in a region: " + std::string(name(load.kind)));
  return text;
}

Rows body_rows(const Scene& scene) {
  Rows rows;
  for (const Body& body : scene.bodies) {
    std::string materials = scene.materials[static_cast<std::size_t>(body.material)].name;
    for (const Part& part : body.parts)
      materials += fmt::format(", partly {}", scene.materials[static_cast<std::size_t>(part.material)].name);
    rows.push_back({body.name, materials, motion_text(body)});
  }
  return rows;
}

/// Gravity at t = until, m/s².
std::string gravity_text(const Scene& scene) {
  std::string text;
  for (std::size_t k = 0; k < static_cast<std::size_t>(scene.dim); ++k)
    text += (k == 0 ? "" : ", ") + brief(scene.gravity[k] ? scene.gravity[k](scene.until) : 0);
  return text + " m/s² at the end";
}

std::string contact_text(const SceneFile& file) {
  const std::string of_file(name(file.scene.contact));
  if (file.scene.contact != ContactLaw::published) return of_file + "; --set contact=LAW changes it";
  const ContactLaw law = contact_law(file.scene, *find_method(file.settings.method));
  return std::string(name(law)) + ", the default of the method; --set contact=LAW changes it";
}

std::string contact_text(const MethodInfo& method) {
  std::string others;
  for (const ContactLaw law : method.contact_laws)
    if (law != method.contact) others += (others.empty() ? "; also " : ", ") + std::string(name(law));
  return fmt::format("{} by default{}", name(method.contact), others);
}

Rows wall_rows(const Scene& scene) {
  const auto in_brackets = [&](const Point& p) {
    std::string text = "(" + brief(p[0]);
    for (std::size_t k = 1; k < static_cast<std::size_t>(scene.dim); ++k) text += ", " + brief(p[k]);
    return text + ")";
  };
  Rows rows;
  for (const Wall& wall : scene.walls)
    rows.push_back(
        {wall.name, fmt::format("through {} m", in_brackets(wall.at)), "normal " + in_brackets(wall.normal)});
  return rows;
}

std::string laws_text(const MethodInfo& method) {
  std::string text = law_name(method.material_law);
  for (std::size_t k = 0; k < method.laws.size(); ++k)
    text += (k == 0 ? "; --set law=LAW changes it: " : ", ") + std::string(method.laws[k].name);
  return text;
}

void describe_scene(const std::string& name, std::ostream& out) {
  const SceneFile file = read_scene(find_scene(name));
  const Scene& scene = file.scene;
  Rows probes;
  for (const Probe& probe : scene.probes) probes.push_back({probe.name});
  Rows head{{"scene", scene.name},
            {"file", file.path.string()},
            {"source", scene.source},
            {"dimensions", std::to_string(scene.dim)},
            {"spacing", brief(scene.spacing) + " m"},
            {"until", brief(scene.until) + " s"},
            {"method", file.settings.method + "; --method changes it"}};
  if (scene.jitter.share > 0)
    head.push_back({"jitter", fmt::format("{} dp, seed {}", brief(scene.jitter.share), scene.jitter.seed)});
  if (scene.bodies.size() > 1 || !scene.walls.empty()) head.push_back({"contact", contact_text(file)});
  if (has_gravity(scene)) head.push_back({"gravity", gravity_text(scene)});
  if (scene.damping > 0)
    head.push_back({"damping", brief(scene.damping) + " 1/s, to bring the scene to rest"});
  out << scene.title << '\n' << in_columns(head);
  print_table(out, "Parameters (--set NAME=VALUE)", parameter_rows(file.parameters), 1);
  print_table(out, "Materials", material_rows(scene), 1);
  print_table(out, "Bodies", body_rows(scene));
  print_table(out, "Walls", wall_rows(scene));
  print_table(out, "Probes (columns of history.csv)", probes);
  print_table(out, "Lines (sampled in lines.csv)", line_rows(scene), 1);
  print_table(out, "Measures (kinds: taut list measures)", rows_of_measures(scene), 1);
}

Rows::value_type constant_row(const MethodConstant& c, const std::vector<MethodConstant>& in_3d) {
  std::string value = brief(c.value), range = bounds(c.low, c.high);
  if (c.is_switch) range = "0 or 1";
  if (!c.choices.empty()) {
    value = c.choices.front();
    range = join({c.choices.begin(), c.choices.end()});
  }
  const auto other = std::ranges::find(in_3d, c.name, &MethodConstant::name);
  if (other != in_3d.end() && other->value != c.value) value += "; in 3D " + brief(other->value);
  if (other != in_3d.end() && (other->low != c.low || other->high != c.high))
    range += "; in 3D " + bounds(other->low, other->high);
  return {std::string(c.name), value, range, std::string(c.help)};
}

void describe_method(const MethodInfo& method, std::ostream& out) {
  Rows terms, equations{{"equation", "function, below engine/", "test"}};
  Rows constants{{"name", "default", "bounds", "meaning"}};
  for (const TermInfo& t : method.terms) {
    terms.push_back({std::string(t.what), std::string(t.formula), std::string(t.source)});
    equations.push_back({std::string(t.source), std::string(t.function), std::string(t.test)});
  }
  const std::vector<MethodConstant> in_3d = method_constants(method.formulation, 3);
  for (const MethodConstant& c : method.constants) constants.push_back(constant_row(c, in_3d));
  out << method.name << ": " << method.summary << '\n'
      << in_columns({{"paper", std::string(method.paper)},
                     {"material law", laws_text(method)},
                     {"conserves", std::string(method.conserves)},
                     {"contact", contact_text(method)},
                     {"CFL number", brief(method.cfl)}});
  print_table(out, "Terms", terms);
  print_table(out, "Functions and tests of the equations", equations, 1);
  print_table(out, "Constants (--set method.NAME=VALUE)", constants, 1);
}

Json as_json(const Topic& topic) {
  Json keys = Json::array();
  for (std::size_t r = 1; r < topic.rows.size(); ++r) {
    Json row;
    for (std::size_t k = 0; k < topic.rows[r].size(); ++k) row[topic.rows.front()[k]] = topic.rows[r][k];
    keys.add(std::move(row));
  }
  return {{"name", topic.name},
          {"header", topic.header},
          {"help", topic.help},
          {"rows", keys},
          {"example", topic.example}};
}

Json as_json(const std::vector<Topic>& topics) {
  Json all = Json::array();
  for (const Topic& topic : topics) all.add(as_json(topic));
  return all;
}

bool describe_language(const std::string& name, bool json, std::ostream& out) {
  for (const LanguageFile& file : {scene_language(), sweep_language(), claim_language(), suite_language()}) {
    if (file.name != name) continue;
    if (json)
      out << Json{{"name", name}, {"rules", file.rules}, {"topics", as_json(file.topics)}}.dump(2) << '\n';
    else
      out << as_text(file, text_columns(out));
    return true;
  }
  const std::vector<Topic> topics = find_topics(name);
  if (json && !topics.empty()) out << as_json(topics).dump(2) << '\n';
  if (!json)
    for (const Topic& topic : topics)
      out << (&topic == &topics.front() ? "" : "\n") << as_text(topic, text_columns(out));
  return !topics.empty();
}

[[noreturn]] void refuse(const std::string& name) {
  std::vector<std::string> names = scene_names();
  for (const MethodInfo& m : methods()) names.emplace_back(m.name);
  for (const std::string& topic : topic_names()) names.push_back(topic);
  names.insert(names.end(), {"scene-file", "sweep-file", "claim-file", "suite-file"});
  for (const auto& row : key_rows()) names.push_back(row.front());
  throw UsageError(unknown_name("name", name, names) + "; `taut list` shows the kinds of names");
}

bool is_scene(const std::string& name) {
  if (name.ends_with(".toml") || name.find('/') != std::string::npos) return true;
  for (const std::string& known : scene_names())
    if (known == name) return true;
  return false;
}

int print_schema(const std::string& name, std::ostream& out) {
  Json (*schema)() = name == "scene-file"   ? scene_schema
                     : name == "sweep-file" ? sweep_schema
                     : name == "claim-file" ? claim_schema
                     : name == "suite-file" ? suite_schema
                                            : nullptr;
  if (!schema)
    throw UsageError(fmt::format(
        "--schema cannot describe '{}'; it describes scene-file, sweep-file, claim-file and suite-file",
        name));
  out << schema().dump(2) << '\n';
  return exit_fine;
}

int describe(const std::string& name, bool json, std::ostream& out) {
  const MethodInfo* method = find_method(name);
  if (!method && !is_scene(name)) {
    if (!describe_language(name, json, out)) refuse(name);
    return exit_fine;
  }
  if (json)
    throw UsageError(fmt::format(
        "--json cannot describe a {} ('{}'); it describes scene-file, sweep-file, claim-file, suite-file and their parts",
        method ? "method" : "scene", name));
  method ? describe_method(*method, out) : describe_scene(name, out);
  return exit_fine;
}

}  // namespace

std::function<int(Streams)> declare_describe(Options& command) {
  struct DescribeArguments {
    std::string name;
    bool json = false, schema = false;
  };
  auto options = std::make_shared<DescribeArguments>();
  command
      .add_argument(
          "SCENE|METHOD|scene-file|sweep-file|claim-file|suite-file|SECTION", options->name,
          "a name that `taut list all` shows, except equations; a section; or the path of a scene file")
      .required();
  const Option json =
      command.add_flag("--json", options->json, "print JSON, for scripts; not for scenes and methods");
  command
      .add_flag(
          "--schema", options->schema,
          "print the JSON Schema (draft-07) of scene-file, sweep-file, claim-file or suite-file, for editors")
      .excludes(json);
  return [options](Streams streams) {
    if (options->schema) return print_schema(options->name, streams.out);
    return describe(options->name, options->json, streams.out);
  };
}

}  // namespace taut::cli
