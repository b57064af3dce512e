#include <algorithm>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "cli/drawing/keys.hpp"
#include "cli/scene/key_info.hpp"
#include "cli/scene/sections.hpp"
#include "cli/text/format.hpp"
#include "engine/diagnostics/fields.hpp"
#include "engine/diagnostics/measure_kinds.hpp"
#include "engine/methods/catalogue.hpp"
#include "engine/settings.hpp"

namespace taut::cli {
namespace {

std::vector<std::string> names_of_reference_laws() {
  std::vector<std::string> names{law_name(in_plane_law), std::string(in_plane_law)};
  for (const LawRow& law : laws())
    if (!law.choice.empty())
      names.insert(names.end(), {law_name(law.material_law), std::string(law.material_law)});
  return names;
}

constexpr std::string_view identifier = "^[A-Za-z_][A-Za-z0-9_]*$";
constexpr KeyType method_name = types::one_of("METHOD", [] { return allowed_words("method"); });
constexpr KeyType rotation = types::number_or_table("degrees or { angle, about, axis }", "rotate");
constexpr KeyType of_place = types::expression("expression of the place");

constexpr KeyInfo top_keys[] = {
    {"name", types::line("^[^/\\u0000-\\u001f\\u007f]*$"), "the file's name",
     "name of the run folder, without /"},
    {"title", types::line(), "the name", "title in pictures and lists"},
    {"source", types::line(), "none", "origin of the scene, such as a paper"},
    {"dim", types::whole(2, 3), "2", "number of dimensions; 2 is plane strain"},
    {"spacing", types::number("m", above(0)), "",
     "particle spacing dp; "
     "changed to the nearest value that divides the thinnest side of the first shape into whole particles, "
     "unless that is a polygon, an expression, or a shape from a file"},
    {"jitter", types::number("dp", {0, 0.5, false, true}), "0",
     "largest random shift of a particle to either side along each axis, in spacings. Volumes do not change. "
     "Particles are not shifted along clamped and driven axes, nor across a face with on_boundary"},
    {"jitter_seed", types::whole(1, 1e9), "1",
     "seed of the random shifts; bodies of the same shape get the same shifts"},
    {"until", types::number("s", above(0)), "", "end time of the run"},
    {"history", types::number("s", above(0)), "until/1000", "interval between rows of history.csv"},
    {"method", method_name, default_method, "simulation method: `taut list methods`"},
    {"method_constants", types::number().by_name("NAME"), "the method's",
     "constants of the method, some with names as values: `taut describe METHOD`"},
    {"law", types::one_of("LAW", [] { return allowed_words("law"); }), "the method's",
     "law of elasticity; the method must support it: `taut list laws`"},
    {"contact", types::one_of("CONTACT", [] { return allowed_words("contact"); }), "published",
     "contact law between bodies: `taut list contacts`"},
    {"stepping", types::word("dual", "single"), "dual",
     "dual: recomputes the geometry of pairs at advection steps only; single: at every step. "
     "Only the methods of [Zhang2024], [Zhang2024b] and [SPHinXsys2025] use it"},
    {"cfl", types::number("", at_least(1e-6)), "the method's", "factor of the time step (CFL number)"},
    {"gravity", types::vector("[x, y] of t", "m/s²"), "none", "gravitational acceleration"},
    {"damping", types::number("1/s", at_least(0)), "0",
     "coefficient c of a viscous force −c m v, for scenes that come to rest"},
    {"parameters", types::table("parameters", "[parameters]").by_name("NAME", identifier), "none",
     "values that --set and sweeps can change"},
    {"material", types::table("material", "[material.NAME]").by_name("NAME"), "", "materials of the bodies"},
    {"body", types::table("body", "[[body]]").list(1), "", "elastic bodies, at least one"},
    {"wall", types::table("wall", "[[wall]]").list(), "none", "rigid half-spaces"},
    {"probe", types::table("probe", "[[probe]]").list(), "none", "quantities recorded at every step"},
    {"line", types::table("line", "[[line]]").list(), "none", "fields sampled along lines at given times"},
    {"measure", types::table("measure", "[[measure]]").list(), "none",
     "result numbers, computed from probes, lines and bodies"},
    {"reference", types::table("reference", "[[reference]]").list(), "none",
     "independent solutions for the measures"},
    {"render", types::table("render", "[render]"), "all defaults", "settings of the pictures"},
};

constexpr KeyInfo parameter_keys[] = {
    {"value", types::number(), "", "value; an expression may use dp and the parameters above it"},
    {"unit", types::line(), "none", "only shown; values are not converted"},
    {"min", types::number(), "none", "smallest allowed value"},
    {"max", types::number(), "none", "largest allowed value"},
    {"help", types::line(), "none", "description of the parameter"},
    {"default", types::number(), "the value",
     "value before --set; taut writes this key into the scene.toml of a run"},
};

constexpr KeyInfo material_keys[] = {
    {"density", types::number("kg/m³", above(0)), "", "initial density ρ"},
    {"youngs_modulus", types::number("Pa", above(0)), "", "Young's modulus E"},
    {"poisson_ratio", types::number("", {-1, 0.5, true, true}), "", "Poisson's ratio ν"},
    {"bulk_modulus", types::number("Pa", above(0)), "E/(3*(1 - 2*nu))",
     "bulk modulus K; the default follows from E and ν"},
};

constexpr KeyInfo body_keys[] = {
    {"name", types::label(), "", "name of the body"},
    {"material", types::text("name of a material"), "",
     "material of all particles outside the regions of `parts`"},
    {"shape", types::table("shape", "SHAPE").or_list(1), "",
     "shape of the body; an array is the union of its shapes, filled with one lattice"},
    {"without", types::table("shape", "SHAPE").or_list(1), "none", "shapes that are cut out of the body"},
    {"on_boundary", types::flag(), "false",
     "true: particles lie on the faces of a single rectangle or box, one more along each side than there are cells. "
     "A particle on one, two or three faces has about 1/2, 1/4 or 1/8 of a cell. "
     "false: particles lie at the centres of cells"},
    {"lattice", types::word("square", "hexagonal"), "square",
     "lattice that shapes are cut from. hexagonal (2D only): rows along the longer side of the first shape, "
     "with particles 1.075 dp apart. Each particle has the area dp² on both lattices"},
    {"layout", types::word("regular", "relaxed"), "regular",
     "relaxed: particles cut from the lattice are moved to follow the faces of the body, half a spacing inside, "
     "and have the volumes of their Voronoi cells. Parts of the lattice that fit the faces stay. "
     "regular: particles stay on the lattice, or on the layers of a round shape"},
    {"rotate", rotation, "none",
     "rotation of the layout. Expressions of the place, such as `held`, use the rotated positions. "
     "A single number is allowed in 2D only"},
    {"velocity", types::vector("[x, y] of the place", "m/s"), "0", "initial velocity"},
    {"held", of_place.or_list(2, 3), "none",
     "particles where the expression is not 0 are clamped. "
     "An array, [\"x < dp\", \"\"], clamps single components of the velocity; an empty text leaves its component free. "
     "A body can turn about a single clamped particle, in 3D about a clamped row"},
    {"displacement", types::vector("[x, y] of the place", "m"), "0",
     "displacement at the start from the stress-free layout; only for methods that use initial neighbours"},
    {"mirror", types::word("x", "y", "z").or_list(), "none",
     "axis, \"x\", \"y\" or \"z\", along which the layout is reflected; two bodies can then be exact mirror images"},
    {"parts", types::table("parts", "[{ material, where }]").list(), "none", "regions of another material"},
    {"driven", types::table("driven", "[{ where, velocity, until }]").list(), "none",
     "regions with a prescribed motion along all axes. The motion replaces a `held` array of single components; "
     "the regions must not overlap fully held particles"},
    {"loaded", types::table("loaded", "[{ where, force, ramp }]").list(), "none",
     "loads on regions. A load moves with its particles and keeps its direction, so a compressed body may tip over"},
};

constexpr KeyInfo rotate_keys[] = {
    {"axis", types::vector_of(3, "[x, y, z]"), "needed in 3D",
     "direction of the axis, by the right-hand rule; not allowed in 2D"},
    {"angle", types::number("degrees"), "", "angle of rotation; counter-clockwise in 2D"},
    {"about", types::vector("[x, y]", "m"), "the centre of the first shape", "point on the axis"},
};

constexpr KeyInfo part_keys[] = {
    {"material", types::text("name of a material"), "", "material of the region"},
    {"where", of_place, "", "region: the particles where the expression is not 0"},
};

constexpr KeyInfo driven_keys[] = {
    {"where", of_place, "", "region: the particles where the expression is not 0"},
    {"velocity", types::vector("[x, y] of t", "m/s"), "", "prescribed velocity of the particles"},
    {"until", types::number("s", above(0)), "never",
     "end of the prescribed motion, after which the particles are free. "
     "It has no effect at or after the end of the run"},
};

constexpr KeyInfo loaded_keys[] = {
    {"where", of_place, "", "region: the particles where the expression is not 0"},
    {"force", types::vector("[x, y] of the place", "N"), "or force_density or traction",
     "force, "
     "spread by volume over the particles of the region that are neither clamped nor driven to the end of the run; "
     "in 2D per metre of depth"},
    {"force_density", types::vector("[x, y] of the place", "N/m³"), "or force or traction",
     "force per initial volume"},
    {"traction", types::vector("[x, y] of the place", "Pa"), "or force or force_density",
     "force per area on the outer face of a layer one spacing deep, such as x > 0.04 - dp; "
     "deeper regions are refused, and faces that meet at an edge need one entry each. "
     "It acts on the particles of the layer in methods that search neighbours, in tl-small-strain, "
     "and on curved faces cut from a lattice. The force is up to 7.5 % off on a hexagonal lattice, "
     "and up to 18 % on curved faces cut from a lattice in 3D"},
    {"ramp", types::expression("expression of t"), "1", "factor of the load over time"},
};

constexpr KeyInfo shape_keys[] = {
    {"type", types::one_of("SHAPE", [] { return names_of(shape_kinds()); }), "",
     "type of the shape: `taut list shapes`; it determines the other keys"},
    {"rotate", rotation, "none",
     "rotation, by default about the centre of the shape. "
     "The lattice of a body rotates with its first shape. A single number is allowed in 2D only"},
};

constexpr KeyInfo wall_keys[] = {
    {"name", types::label(), "", "name of the wall"},
    {"at", types::vector("[x, y]", "m"), "", "point on the face of the wall"},
    {"normal", types::vector(), "", "direction from the wall to the bodies, of any length above 0"},
};

constexpr KeyInfo probe_keys[] = {
    {"name", types::label(), "", "name of the column in history.csv"},
    {"of", types::one_of("PROBE", [] { return names_of(probe_kinds()); }), "",
     "kind of probe: `taut list probes`; it determines the other keys"},
};

constexpr KeyInfo line_keys[] = {
    {"name", types::label(), "", "name in lines.csv"},
    {"body", types::text("name of a body"), "", "body in which the field is sampled"},
    {"field", types::one_of("FIELD", names_of_fields), "", "field to sample: `taut list fields`"},
    {"from", types::vector("[x, y]", "m"), "", "first point, in the initial configuration"},
    {"to", types::vector("[x, y]", "m"), "", "last point, in the initial configuration"},
    {"points", types::whole(2, 100000), "", "number of evenly spaced points"},
    {"times", types::number("s", at_least(0)).list(1), "", "sampling times, in increasing order"},
    {"frame", types::word("body", "space"), "body",
     "body: material points; space: fixed points, through which the body moves"},
};

constexpr KeyInfo measure_keys[] = {
    {"name", types::label(), "", "name of the key in run.json"},
    {"of", types::one_of("MEASURE", [] { return names_of(measure_kinds()); }), "",
     "kind of measure: `taut list measures`; it determines the other keys"},
    {"unit", types::line(), "none", "only shown; values are not converted"},
};

constexpr KeyInfo reference_keys[] = {
    {"law", types::one_of("LAW", names_of_reference_laws), "",
     "law of elasticity for which the reference is valid: `taut list laws`"},
    {"name", types::line(), "", "description of the reference"},
    {"when", types::number().by_name("PARAMETER"), "the scene's own values",
     "parameter values for which the reference is valid"},
    {"methods", method_name.list(), "all", "methods for which the reference is valid"},
    {"values", types::number().by_name("MEASURE"), "none", "reference values of measures"},
    {"tables", types::table("tables", "{ file, column }").by_name("MEASURE"), "none",
     "reference series of measures, from CSV files"},
    {"solutions", types::expression("expression of t").or_list(1).by_name("MEASURE"), "none",
     "exact solutions of measures; for a number such as a period, its value. "
     "Solutions of lines and fields may also use the place. Measures of several probes or fields take an array. "
     "A solution is valid for all values of the parameters that `when` does not name"},
    {"let", types::number().by_name("NAME"), "none",
     "names for use in values and solutions; each may use the names above it. "
     "If the scene has one material, also its c0, E, nu, rho, K, G"},
};

constexpr KeyInfo table_keys[] = {
    {"file", types::text("path"), "",
     "path of a CSV file, relative to the scene's folder; lines that start with # are comments"},
    {"column", types::text(), "for one probe or line",
     "name of the column with the values. The table also needs a column t, the time in s; "
     "for a line a column s, the distance from its first point in m"},
    {"columns", types::text().list(1), "for several probes", "one column name for each probe"},
};

constexpr KeyInfo sweep_keys[] = {
    {"title", types::line(), "the file's name", "title of the study"},
    {"scene", types::text("SCENE"), "",
     "name of a scene (`taut list scenes`), or a path relative to this file"},
    {"set", types::table("set", "{ NAME = value }"), "none", "settings of every run, as with --set"},
    {"grid", types::table("grid", "[grid]"), "or row or both", "every combination of values"},
    {"row", types::table("row", "[[row]]").list(), "or grid or both",
     "settings of single runs; beside a [grid]: of further runs"},
    {"repeat", types::whole(1, 100), "1",
     "number of times that each run is made; the median cost counts. Above 1, jobs do not share cores"},
    {"chart", types::table("chart", "[chart]"), "none", "picture of error against cost"},
    {"map", types::table("map", "[map]"), "none", "picture of the verdicts"},
    {"history", types::table("history", "[history]"), "none", "picture of the histories"},
};

constexpr KeyInfo grid_keys[] = {
    {any_name, types::expression("value").or_list(1), "",
     "values of a name that --set accepts: \"low:high:step\" with both ends, \"a, b\", or [a, b]. "
     "A name \"method.CONSTANT\" needs quotes"},
};

constexpr KeyInfo setting_keys[] = {
    {any_name, types::expression("value"), "none",
     "value of a name that --set accepts. A name \"method.CONSTANT\" needs quotes"},
};

constexpr KeyInfo chart_keys[] = {
    {"measure", types::text("MEASURE").or_list(1), "shared by most runs",
     "measure whose error is drawn into chart-MEASURE.png; without this key the picture is chart.png"},
    {"cost", types::word("cpu", "wall", "steps", "seconds"), "cpu",
     "x axis. cpu: CPU time to solve, s; wall: elapsed time to solve, s; steps: particles × time steps; "
     "seconds: earlier name of wall"},
    {"methods", method_name.or_list(1), "all", "methods to draw"},
    {"against", method_name, "the references", "method whose finest stable run replaces the references"},
};

constexpr KeyInfo map_keys[] = {
    {"parameter", types::text("NAME"), "the swept parameter", "parameter of the x axis"},
};

constexpr KeyInfo history_keys[] = {
    {any_name, types::text(), "", "axis label of the column NAME of history.csv, such as tip = \"tip, m\""},
};

constexpr KeyInfo paper_keys[] = {
    {"title", types::line(), "", "the paper"},
    {"claim", types::table("claim", "[[claim]]").list(1), "", "statements of the paper"},
};

constexpr KeyInfo claim_keys[] = {
    {"key", types::label(), "", "name of the claim in this file, such as fig-3a"},
    {"place", types::line(), "", "place in the paper, such as Fig. 3(a)"},
    {"text", types::text(), "", "statement of the paper"},
    {"published", types::line(), "none", "published value"},
    {"scene", types::text("SCENE"), "",
     "name of a scene (`taut list scenes`), or a path relative to this file"},
    {"cost", types::word("quick", "slow"), "quick",
     "quick: the runs take seconds, and the tests repeat them"},
    {"set", types::table("set", "{ NAME = value }"), "none", "settings of every run, as with --set"},
    {"run", types::table("set", "{ NAME = value }").by_name("RUN"), "",
     "runs of the claim with their settings; the criteria refer to their names"},
    {"criterion", types::expression("condition of quantities"), "",
     "true if the claim holds here. A quantity is RUN.verdict, RUN.since.VERDICT, RUN.MEASURE, RUN.error.MEASURE, "
     "RUN.min.COLUMN, RUN.max.COLUMN, RUN.first.COLUMN or RUN.last.COLUMN of history.csv, "
     "RUN.PATH of a number in run.json, or RUN.critical_step, the largest stable time step in s"},
    {"part", types::expression("condition of quantities"), "none",
     "weaker criterion, used if the criterion is false; true if the claim holds in part"},
    {"looser", types::line(), "none", "how the criterion is weaker than the statement"},
    {"state", types::word("holds", "in part", "does not hold"), "holds", "recorded state"},
    {"reason", types::text(), "none",
     "why the claim does not hold, or holds in part; required for these states"},
    {"evidence", types::expression("condition of quantities"), "none",
     "condition, tested by an experiment, that confirms the reason"},
    {"last_run", types::line(), "", "date of the runs that confirmed the state"},
};

constexpr KeyType settings_of_entry = types::table("set", "{ NAME = value }");
constexpr KeyType drawing_of_entry = types::table("render", "{ KEY = value }");
constexpr KeyType color_difference = types::number("ΔE*ab", at_least(0));

constexpr KeyInfo suite_keys[] = {
    {"title", types::line(), "the file's name", "title of the suite"},
    {"baselines", types::text("path"), "the file's name without .toml",
     "folder of the baselines, one subfolder for each entry; relative to this file"},
    {"set", settings_of_entry, "none", "settings of every entry, as with --set"},
    {"render", drawing_of_entry, "none",
     "drawing of every entry: keys of [render] that override those of the scenes"},
    {"warn", color_difference, "none", "`warn` of every entry"},
    {"fail", color_difference, "none", "`fail` of every entry"},
    {"entry", types::table("entry", "[[entry]]").list(1), "", "scenes to run and to compare"},
};

constexpr KeyInfo entry_keys[] = {
    {"name", types::label(), "", "name of the entry, its run folder and its baseline"},
    {"scene", types::text("SCENE"), "or differs_from",
     "name of a scene (`taut list scenes`), or a path relative to this file"},
    {"differs_from", types::text("name of an entry"), "or scene",
     "makes this entry a control: it has the scene, settings and limits of that entry, "
     "except for the keys given here, and fails if all its frames are like that entry's baseline"},
    {"method", method_name, "the scene's", "simulation method: `taut list methods`"},
    {"until", types::number("s", above(0)), "the scene's", "end of the run"},
    {"set", settings_of_entry, "the suite's", "settings, in addition to those of the suite"},
    {"render", drawing_of_entry, "the suite's", "drawing, in addition to that of the suite"},
    {"warn", color_difference, "the suite's",
     "greatest difference of a pixel without a warning; a warning does not change the exit code"},
    {"fail", color_difference, "the suite's",
     "greatest allowed difference of a pixel, as --max-difference; without it, few pixels may differ visibly"},
};

std::vector<KeyInfo> all_material_keys() {
  std::vector<KeyInfo> keys(std::begin(material_keys), std::end(material_keys));
  static std::vector<std::string> texts;
  texts.reserve(2 * laws().size());
  for (const LawRow& law : laws())
    for (const LawParameter& parameter : law.parameters)
      keys.push_back({parameter.key, types::number("", {parameter.low, parameter.high}),
                      texts.emplace_back(exact(parameter.value)), parameter.help});
  return keys;
}

std::string default_text(const DrawingKey& key) {
  const DrawingValue value = key.get({});
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  std::vector<std::string> numbers;
  for (const double number : std::get<std::vector<double>>(value)) numbers.push_back(exact(number));
  return numbers.size() == 1 ? numbers.front() : "[" + join(numbers) + "]";
}

KeyType type_of(const DrawingKey& key) {
  constexpr std::size_t most_shown = 4;
  const DrawingKey::Numbers& numbers = key.numbers;
  const NumberRange bounds{numbers.low, numbers.high};
  KeyType type = types::vector_of(numbers.count, numbers.in_file, "", bounds);
  if (numbers.count == 1)
    type = numbers.whole ? types::whole(bounds.low, bounds.high) : types::number("", bounds);
  if (key.is_free_text) type = types::text(key.placeholder.substr(0, key.placeholder.find('|')));
  if (!key.pattern.empty())
    type = {.shown = numbers.typed, .pattern = key.pattern};
  else if (key.takes_words())
    type = types::one_of(key.words.names().size() > most_shown ? key.words.kind : "", key.words.names);
  if (key.words.or_formula) return type.or_other("=EXPRESSION");
  return key.allows_auto ? type.or_other(automatic) : type;
}

std::vector<KeyInfo> all_render_keys() {
  std::vector<KeyInfo> keys;
  static std::vector<std::string> defaults;
  defaults.reserve(drawing_keys().size());
  for (const DrawingKey& key : drawing_keys()) {
    keys.push_back({key.name, type_of(key), defaults.emplace_back(default_text(key)), key.help});
  }
  return keys;
}

}  // namespace

std::span<const Section> scene_sections() {
  static const std::vector<KeyInfo> material = all_material_keys(), render = all_render_keys();
  static const Section sections[] = {
      {"scene", "", "the file itself: keys above the first [header], and its sections", top_keys},
      {"parameters", "[parameters]", "values that --set and sweeps can change, one NAME = { ... } each",
       parameter_keys},
      {"material", "[material.NAME]", "a material of bodies or parts of bodies", material},
      {"body", "[[body]]", "an elastic body", body_keys},
      {"shape", "shape = { ... }", "the shape of a body or of a cut-out", shape_keys},
      {"rotate", "rotate = { ... }", "the rotation of a body or shape", rotate_keys},
      {"parts", "parts = [{ ... }]",
       "regions of a body with another material; the last matching region applies", part_keys},
      {"driven", "driven = [{ ... }]",
       "regions of a body with a prescribed motion; the last matching region applies", driven_keys},
      {"loaded", "loaded = [{ ... }]", "loads on regions of a body; loads of overlapping regions add up",
       loaded_keys},
      {"wall", "[[wall]]", "a rigid half-space", wall_keys},
      {"probe", "[[probe]]", "a quantity recorded at every step, a column of history.csv", probe_keys},
      {"line", "[[line]]", "a field sampled along a straight line, written to lines.csv", line_keys},
      {"measure", "[[measure]]", "one result number of a run, written to run.json", measure_keys},
      {"reference", "[[reference]]", "an independent solution for the measures, for one law of elasticity",
       reference_keys},
      {"tables", "tables = { MEASURE = { ... } }", "tables of a reference, over time or along a line",
       table_keys},
      {"render", "[render]",
       "settings of the pictures; options of `taut run` with the same names override them", render},
  };
  return sections;
}

std::span<const Section> sweep_sections() {
  static constexpr Section sections[] = {
      {"sweep", "", "the file itself: keys above the first [header], and its sections", sweep_keys},
      {"set", "set = { ... }", "settings of every run", setting_keys},
      {"grid", "[grid]", "one run for every combination of the values", grid_keys},
      {"row", "[[row]]",
       "settings of one run. "
       "Beside a [grid], a row is run with every combination of the grid's names that it does not set",
       setting_keys},
      {"chart", "[chart]", "a picture of error against cost", chart_keys},
      {"map", "[map]", "a picture of the verdicts by parameter and method, in map.png", map_keys},
      {"history", "[history]", "a picture of the histories of all runs, in history.png", history_keys},
  };
  return sections;
}

std::span<const Section> claim_sections() {
  static constexpr Section sections[] = {
      {"claims", "", "the file itself", paper_keys},
      {"claim", "[[claim]]", "a statement of a paper, with the runs and the criterion that decide it",
       claim_keys},
  };
  return sections;
}

std::span<const Section> suite_sections() {
  static constexpr Section sections[] = {
      {"suite", "", "the file itself: keys above the first [[entry]]", suite_keys},
      {"entry", "[[entry]]", "a scene with settings, whose frames are compared with a baseline", entry_keys},
  };
  return sections;
}

const Section& find_section(std::string_view name) {
  for (const auto& sections : {scene_sections(), sweep_sections(), claim_sections(), suite_sections()})
    for (const Section& section : sections)
      if (section.name == name) return section;
  throw std::logic_error("there is no section '" + std::string(name) +
                         "' of scene, sweep, claim and suite files");
}

std::span<const KeyInfo> keys_of(std::string_view section) { return find_section(section).keys; }

const KeyInfo& key_of_scene(std::string_view name) {
  return *std::ranges::find(top_keys, name, &KeyInfo::name);
}

}  // namespace taut::cli
