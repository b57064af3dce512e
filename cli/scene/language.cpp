#include <algorithm>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "cli/drawing/keys.hpp"
#include "cli/scene/key_info.hpp"
#include "cli/text/format.hpp"
#include "engine/families/catalogue.hpp"
#include "engine/settings.hpp"

/// The language of scene and sweep files: every table and its keys. What shapes, probes and measures of a
/// kind take stands with the kinds.
namespace taut::cli {
namespace {

constexpr KeyInfo top_keys[] = {
    {"name", "text", "the file's name", "name of the run folder"},
    {"title", "text", "the name", "title in pictures and lists"},
    {"source", "text", "none", "origin of the scene, such as a paper"},
    {"dim", "2 or 3", "2", "number of dimensions; 2 is plane strain"},
    {"spacing", "number, m", "",
     "particle spacing dp; changed to the nearest value that divides the thinnest side of the first shape "
     "into whole particles"},
    {"jitter", "number, dp", "0",
     "largest random shift of a particle to either side along each axis, in spacings; from 0 to below 0.5. "
     "Volumes do not change. Particles are not shifted along held and driven axes, nor across a face with "
     "on_boundary"},
    {"jitter_seed", "whole number", "1",
     "seed of the random shifts, from 1 to 1e9; bodies of the same shape get the same shifts"},
    {"until", "number, s", "", "end time of the run"},
    {"history", "number, s", "until/1000", "interval between rows of history.csv"},
    {"method", "METHOD", default_method, "simulation method: `taut list methods`"},
    {"method_constants", "{ NAME = number }", "the method's",
     "constants of the method: `taut describe METHOD`"},
    {"law", "LAW", "the method's", "law of elasticity; the method must support it: `taut list laws`"},
    {"contact", "CONTACT", "published", "contact law between bodies: `taut list contacts`"},
    {"stepping", "dual or single", "dual",
     "dual: recomputes the geometry of pairs at advection steps only; single: at every step. Only the "
     "methods of [Zhang2024] use it"},
    {"cfl", "number", "the method's", "factor of the time step (CFL number), 1e-6 or more"},
    {"gravity", "[x, y] of t, m/s²", "none", "gravitational acceleration"},
    {"damping", "number, 1/s", "0",
     "coefficient c of a viscous force −c m v, 0 or more, for scenes that come to rest"},
    {"parameters", "[parameters]", "none", "values that --set and sweeps can change"},
    {"material", "[material.NAME]", "", "materials of the bodies"},
    {"body", "[[body]]", "", "elastic bodies, at least one"},
    {"wall", "[[wall]]", "none", "rigid half-spaces"},
    {"probe", "[[probe]]", "none", "quantities recorded at every step"},
    {"line", "[[line]]", "none", "fields sampled along lines at given times"},
    {"measure", "[[measure]]", "none", "result numbers, computed from probes, lines and bodies"},
    {"reference", "[[reference]]", "none", "independent solutions for the measures"},
    {"render", "[render]", "all defaults", "settings of the pictures"},
};

constexpr KeyInfo parameter_keys[] = {
    {"value", "number", "", "value; an expression may use dp and the parameters above it"},
    {"unit", "text", "none", "only shown; values are not converted"},
    {"min", "number", "none", "smallest allowed value"},
    {"max", "number", "none", "largest allowed value"},
    {"help", "text", "none", "description of the parameter"},
    {"default", "number", "the value",
     "value before --set; taut writes this key into the scene.toml of a run"},
};

constexpr KeyInfo material_keys[] = {
    {"density", "number, kg/m³", "", "initial density ρ, above 0"},
    {"youngs_modulus", "number, Pa", "", "Young's modulus E, above 0"},
    {"poisson_ratio", "number", "", "Poisson's ratio ν, above −1 and below 0.5"},
    {"bulk_modulus", "number, Pa", "E/(3*(1 - 2*nu))",
     "bulk modulus K, above 0; the default follows from E and ν"},
};

constexpr KeyInfo body_keys[] = {
    {"name", "letters, digits, _ and -", "", "name of the body"},
    {"material", "name of a material", "", "material of all particles outside the regions of `parts`"},
    {"shape", "SHAPE or an array of them", "",
     "shape of the body; an array is the union of its shapes, filled with one lattice"},
    {"without", "SHAPE or an array of them", "none", "shapes that are cut out of the body"},
    {"on_boundary", "true or false", "false",
     "true: particles lie on the faces of a single rectangle or box, one more along each side than there are "
     "cells. A particle on one, two or three faces has about 1/2, 1/4 or 1/8 of a cell. false: particles lie "
     "at the centres of cells"},
    {"lattice", "square or hexagonal", "square",
     "lattice that shapes are cut from. hexagonal (2D only): rows along the longer side of the first shape, "
     "with particles 1.075 dp apart. Each particle has the area dp² on both lattices"},
    {"rotate", "degrees or { angle, about, axis }", "none",
     "rotation of the layout. Expressions of the place, such as `held`, use the rotated positions. A single "
     "number is allowed in 2D only"},
    {"velocity", "[x, y] of the place, m/s", "0", "initial velocity"},
    {"held", "expression of the place", "none",
     "particles where the expression is not 0 are clamped. An array, [\"x < dp\", \"\"], clamps single "
     "components of the velocity; an empty text leaves its component free. A body can turn about a single "
     "clamped particle, in 3D about a clamped row"},
    {"displacement", "[x, y] of the place, m", "0",
     "displacement at the start from the stress-free layout; only for methods that use initial neighbours"},
    {"mirror", "axis or an array of them", "none",
     "axis, \"x\", \"y\" or \"z\", along which the layout is reflected; two bodies can then be exact mirror "
     "images"},
    {"parts", "[{ material, where }]", "none", "regions of another material"},
    {"driven", "[{ where, velocity, until }]", "none",
     "regions with a prescribed motion along all axes; overrides `held` along single axes"},
    {"loaded", "[{ where, force, ramp }]", "none",
     "loads on regions. A load moves with its particles and keeps its direction, so a compressed body may "
     "tip over"},
};

constexpr KeyInfo rotate_keys[] = {
    {"axis", "[x, y, z]", "needed in 3D", "direction of the axis, by the right-hand rule; not allowed in 2D"},
    {"angle", "number, degrees", "", "angle of rotation; counter-clockwise in 2D"},
    {"about", "[x, y], m", "the centre of the first shape", "point on the axis"},
};

constexpr KeyInfo part_keys[] = {
    {"material", "name of a material", "", "material of the region"},
    {"where", "expression of the place", "", "region: the particles where the expression is not 0"},
};

constexpr KeyInfo driven_keys[] = {
    {"where", "expression of the place", "", "region: the particles where the expression is not 0"},
    {"velocity", "[x, y] of t, m/s", "", "prescribed velocity of the particles"},
    {"until", "number, s", "never",
     "end of the prescribed motion, after which the particles are free. It has no effect at or after the end "
     "of the run"},
};

constexpr KeyInfo loaded_keys[] = {
    {"where", "expression of the place", "", "region: the particles where the expression is not 0"},
    {"force", "[x, y] of the place, N", "or another load",
     "force, spread by volume over the region without particles that are clamped or driven to the end of the "
     "run; in 2D per metre of depth"},
    {"force_density", "[x, y] of the place, N/m³", "or another load", "force per initial volume"},
    {"traction", "[x, y] of the place, Pa", "or another load",
     "force per area on the outer face of a layer one spacing deep; each face needs its own entry. It acts "
     "on the particles of the layer in methods that search neighbours, in tl-small-strain, and on curved "
     "faces cut from a lattice. On a hexagonal lattice the force is up to 7.5 % off"},
    {"ramp", "expression of t", "1", "factor of the load over time"},
};

constexpr KeyInfo shape_keys[] = {
    {"type", "SHAPE", "", "type of the shape: `taut list shapes`; it determines the other keys"},
    {"rotate", "degrees or { angle, about, axis }", "none",
     "rotation, by default about the centre of the shape. The lattice of a body rotates with its first "
     "shape. A single number is allowed in 2D only"},
};

constexpr KeyInfo wall_keys[] = {
    {"name", "letters, digits, _ and -", "", "name of the wall"},
    {"at", "[x, y], m", "", "point on the face of the wall"},
    {"normal", "[x, y]", "", "direction from the wall to the bodies, of any length above 0"},
};

constexpr KeyInfo probe_keys[] = {
    {"name", "letters, digits, _ and -", "", "name of the column in history.csv"},
    {"of", "PROBE", "", "kind of probe: `taut list probes`; it determines the other keys"},
};

constexpr KeyInfo line_keys[] = {
    {"name", "letters, digits, _ and -", "", "name in lines.csv"},
    {"body", "name of a body", "", "body in which the field is sampled"},
    {"field", "FIELD", "", "field to sample: `taut list fields`"},
    {"from", "[x, y], m", "", "first point, in the initial configuration"},
    {"to", "[x, y], m", "", "last point, in the initial configuration"},
    {"points", "whole number", "", "number of evenly spaced points, from 2 to 100000"},
    {"times", "[number, ...], s", "", "sampling times, in increasing order"},
    {"frame", "body or space", "body",
     "body: material points; space: fixed points, through which the body moves"},
};

constexpr KeyInfo measure_keys[] = {
    {"name", "letters, digits, _ and -", "", "name of the key in run.json"},
    {"of", "MEASURE", "", "kind of measure: `taut list measures`; it determines the other keys"},
    {"unit", "text", "none", "only shown; values are not converted"},
};

constexpr KeyInfo reference_keys[] = {
    {"law", "LAW", "", "law of elasticity for which the reference is valid: `taut list laws`"},
    {"name", "text", "", "description of the reference"},
    {"when", "{ PARAMETER = number }", "the scene's own values",
     "parameter values for which the reference is valid"},
    {"methods", "[METHOD, ...]", "all", "methods for which the reference is valid"},
    {"values", "{ MEASURE = number }", "none", "reference values of measures"},
    {"tables", "{ MEASURE = { file, column } }", "none", "reference series of measures, from CSV files"},
    {"solutions", "{ MEASURE = expression of t }", "none",
     "exact solutions of measures. Solutions of lines and fields may also use the place. Measures of several "
     "probes or fields take an array. A solution is valid for all values of the parameters that `when` does "
     "not name"},
    {"let", "{ NAME = number }", "none", "names for use in the solutions; each may use the names above it"},
};

constexpr KeyInfo table_keys[] = {
    {"file", "path", "",
     "path of a CSV file, relative to the scene's folder; lines that start with # are comments"},
    {"column", "text", "for one probe or line",
     "name of the column with the values. The table also needs a column t, the time in s; for a line a "
     "column s, the distance from its first point in m"},
    {"columns", "[text, ...]", "for several probes", "one column name for each probe"},
};

constexpr KeyInfo sweep_keys[] = {
    {"title", "text", "the file's name", "title of the study"},
    {"scene", "SCENE", "", "name of a scene (`taut list scenes`), or a path relative to this file"},
    {"set", "{ NAME = value }", "none", "settings of every run, as with --set"},
    {"grid", "[grid]", "or [[row]]", "every combination of values"},
    {"row", "[[row]]", "or [grid]", "settings of single runs"},
    {"chart", "[chart]", "none", "picture of error against cost"},
    {"map", "[map]", "none", "picture of the verdicts"},
    {"history", "[history]", "none", "picture of the histories"},
};

constexpr KeyInfo grid_keys[] = {
    {any_name, "values", "",
     "values of a name that --set accepts: \"low:high:step\" with both ends, \"a, b\", or [a, b]. A name "
     "\"method.CONSTANT\" needs quotes"},
};

constexpr KeyInfo setting_keys[] = {
    {any_name, "value", "", "value of a name that --set accepts. A name \"method.CONSTANT\" needs quotes"},
};

constexpr KeyInfo chart_keys[] = {
    {"measure", "MEASURE or an array of them", "shared by most runs",
     "measure whose error is drawn into chart-MEASURE.png; without this key the picture is chart.png"},
    {"cost", "seconds or steps", "seconds", "axis of the cost: seconds of solving, or particles × steps"},
    {"methods", "METHOD or an array of them", "all", "methods to draw"},
    {"against", "METHOD", "the references", "method whose finest run replaces the references"},
};

constexpr KeyInfo map_keys[] = {
    {"parameter", "NAME", "the swept parameter", "parameter of the x axis"},
};

constexpr KeyInfo history_keys[] = {
    {any_name, "text", "", "label of the axis of a column of history.csv: tip = \"tip, m\""},
};

/// Of the numbers of a law those that are keys of a material too.
std::vector<KeyInfo> all_material_keys() {
  std::vector<KeyInfo> keys(std::begin(material_keys), std::end(material_keys));
  static std::vector<std::string> texts;
  texts.reserve(2 * laws().size());
  for (const LawRow& law : laws())
    for (const LawParameter& parameter : law.parameters)
      keys.push_back({parameter.key, "number", texts.emplace_back(exact(parameter.value)), parameter.help});
  return keys;
}

std::string default_text(const DrawingKey& key) {
  const DrawingValue value = key.get({});
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  std::vector<std::string> numbers;
  for (const double number : std::get<std::vector<double>>(value)) numbers.push_back(exact(number));
  return numbers.size() == 1 ? numbers.front() : "[" + join(numbers) + "]";
}

/// From the table of drawing keys.
std::vector<KeyInfo> all_render_keys() {
  std::vector<KeyInfo> keys;
  static std::vector<std::string> defaults;
  defaults.reserve(drawing_keys().size());
  for (const DrawingKey& key : drawing_keys()) {
    std::string_view value = key.words.kind;
    if (key.of_text) value = key.placeholder.substr(0, key.placeholder.find('|'));
    if (value.empty()) value = key.numbers.in_file;
    keys.push_back({key.name, value, defaults.emplace_back(default_text(key)), key.help});
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
      {"row", "[[row]]", "settings of one run, instead of [grid]", setting_keys},
      {"chart", "[chart]", "a picture of error against cost", chart_keys},
      {"map", "[map]", "a picture of the verdicts by parameter and method, in map.png", map_keys},
      {"history", "[history]", "a picture of the histories of all runs, in history.png", history_keys},
  };
  return sections;
}

std::span<const KeyInfo> keys_of(std::string_view name) {
  for (const auto& sections : {scene_sections(), sweep_sections()})
    for (const Section& section : sections)
      if (section.name == name) return section.keys;
  throw std::logic_error("there is no section '" + std::string(name) + "' of scene and sweep files");
}

}  // namespace taut::cli
