#include <algorithm>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "cli/drawing/keys.hpp"
#include "cli/scene/key_info.hpp"
#include "cli/text/format.hpp"
#include "engine/families/catalogue.hpp"

/// The language of scene and sweep files: every table and its keys. What shapes, probes and measures of a
/// kind take stands with the kinds.
namespace taut::cli {
namespace {

constexpr KeyInfo top_keys[] = {
    {"name", "text", "the file's name", "of the run folder"},
    {"title", "text", "the name", "what pictures and lists show"},
    {"source", "text", "none", "where the scene is from"},
    {"dim", "2 or 3", "2", "dimensions; 2 is plane strain"},
    {"spacing", "number, m", "", "dp, the distance of particles; changed to divide the first body"},
    {"jitter", "number, dp", "0",
     "how far each particle is moved at random, at most, in spacings, to either side along each axis; not "
     "where it is held, driven or on a face (on_boundary), and its volume stays"},
    {"jitter_seed", "whole number", "1",
     "another seed, other moves; bodies of the same shape are moved alike"},
    {"until", "number, s", "", "end of the run"},
    {"history", "number, s", "until/1000", "time between rows of history.csv"},
    {"method", "METHOD", default_method, "`taut list methods`"},
    {"method_constants", "{ NAME = number }", "as published", "of the method: `taut describe METHOD`"},
    {"law", "LAW", "the method's", "of elasticity, for every method that takes it: `taut list laws`"},
    {"contact", "CONTACT", "published", "how bodies act on each other: `taut list contacts`"},
    {"stepping", "dual or single", "dual", "geometry of pairs held between advection steps, or not"},
    {"cfl", "number", "the method's", "factor of the time step, 1e-6 or more"},
    {"gravity", "[x, y] of t, m/s²", "none", "acts on all particles"},
    {"damping", "number, 1/s", "0", "c of a viscous force −c m v, for scenes that come to rest"},
    {"parameters", "[parameters]", "none", "what can be changed from outside"},
    {"material", "[material.NAME]", "", "what bodies are made of"},
    {"body", "[[body]]", "", "at least one"},
    {"wall", "[[wall]]", "none", "rigid half-spaces"},
    {"probe", "[[probe]]", "none", "what is followed at every step"},
    {"line", "[[line]]", "none", "fields along lines at given times"},
    {"measure", "[[measure]]", "none", "numbers that are made of probes, lines and bodies"},
    {"reference", "[[reference]]", "none", "what independent solutions say of the measures"},
    {"render", "[render]", "all open", "what pictures show"},
};

constexpr KeyInfo parameter_keys[] = {
    {"value", "number", "", "may use dp and the parameters before it"},
    {"unit", "text", "none", "shown to people; nothing is converted"},
    {"min", "number", "none", "least value allowed"},
    {"max", "number", "none", "greatest value allowed"},
    {"help", "text", "none", "what it is"},
    {"default", "number", "the value", "in the scene.toml of a run: the value of the scene that was run"},
};

constexpr KeyInfo material_keys[] = {
    {"density", "number, kg/m³", "", "ρ at the start"},
    {"youngs_modulus", "number, Pa", "", "E"},
    {"poisson_ratio", "number", "", "ν, above −1 and below 0.5"},
    {"bulk_modulus", "number, Pa", "E/(3*(1 - 2*nu))", "K, where it is not the one of E and ν"},
};

constexpr KeyInfo body_keys[] = {
    {"name", "letters, digits, _ and -", "", "of the body"},
    {"material", "name of a material", "", "of all its particles but those of `parts`"},
    {"shape", "SHAPE or an array of them", "", "several: their union, laid as one lattice"},
    {"without", "SHAPE or an array of them", "none", "cut out of it"},
    {"on_boundary", "true or false", "false",
     "of one rectangle or box: particles stand on its faces, one more along a side than there are cells, and "
     "have a half, a quarter or an eighth of a cell there; else in the middle of cells"},
    {"lattice", "square or hexagonal", "square",
     "of what is cut from a lattice; hexagonal (2D): rows along the longer side of the first shape, "
     "particles 1.075 dp "
     "apart, so that each has dp² of the area as on the square one"},
    {"rotate", "degrees or { angle, about, axis }", "none",
     "the layout is turned; all other keys mean the places after it; the number in 2D only"},
    {"velocity", "[x, y] of the place, m/s", "0", "at the start"},
    {"held", "expression of the place", "none",
     "particles where it is not 0 stay where they are; or one for each component, [\"x < dp\", \"\"]: that "
     "component of the velocity stays 0; an empty text holds nothing; a body turns about one particle that "
     "is held alone, in 3D about a row of them"},
    {"displacement", "[x, y] of the place, m", "0",
     "where particles start less where they are laid, which is the stressless state; for methods that keep "
     "the neighbours of the start"},
    {"mirror", "axis or an array of them", "none",
     "\"x\", \"y\", \"z\": the layout is reflected along the axis, so that two bodies are images to the bit"},
    {"parts", "[{ material, where }]", "none", "regions of another material"},
    {"driven", "[{ where, velocity, until }]", "none",
     "regions that move as they are told, along all axes, whatever `held` says of some"},
    {"loaded", "[{ where, force, ramp }]", "none",
     "forces on regions, which go along with the particles; their directions stay, so that a body that is "
     "pressed may tip over"},
};

constexpr KeyInfo rotate_keys[] = {
    {"axis", "[x, y, z]", "needed in 3D", "not in 2D; the right-hand rule holds"},
    {"angle", "number, degrees", "", "counter-clockwise in 2D"},
    {"about", "[x, y], m", "the middle of the first shape", "a point of the axis"},
};

constexpr KeyInfo part_keys[] = {
    {"material", "name of a material", "", "of the region"},
    {"where", "expression of the place", "", "the region: where it is not 0"},
};

constexpr KeyInfo driven_keys[] = {
    {"where", "expression of the place", "", "the region: where it is not 0"},
    {"velocity", "[x, y] of t, m/s", "", "of its particles"},
    {"until", "number, s", "never", "free from then on, if that is before the run's end"},
};

constexpr KeyInfo loaded_keys[] = {
    {"where", "expression of the place", "", "the region: where it is not 0"},
    {"force", "[x, y] of the place, N", "one of three",
     "spread by volume over what of the region is not held, nor driven to the end; 2D: N per metre"},
    {"force_density", "[x, y] of the place, N/m³", "one of three", "of the initial volume"},
    {"traction", "[x, y] of the place, Pa", "one of three",
     "on the outer face of a layer one spacing deep, each face in an entry of its own; by methods without "
     "fixed neighbours and "
     "tl-small-strain, and "
     "where a curved face is cut from a lattice, in the layer; up to 7.5 % off on a hexagonal lattice"},
    {"ramp", "expression of t", "1", "factor of it"},
};

constexpr KeyInfo shape_keys[] = {
    {"type", "SHAPE", "", "`taut list shapes`; the other keys are those of the shape"},
    {"rotate", "degrees or { angle, about, axis }", "none",
     "it is turned about its middle, and with it the lattice of a body whose first shape it is; the number "
     "in 2D only"},
};

constexpr KeyInfo wall_keys[] = {
    {"name", "letters, digits, _ and -", "", "of the wall"},
    {"at", "[x, y], m", "", "a point of its face"},
    {"normal", "[x, y]", "", "to the side where the bodies are; of any length"},
};

constexpr KeyInfo probe_keys[] = {
    {"name", "letters, digits, _ and -", "", "its column in history.csv"},
    {"of", "PROBE", "", "`taut list probes`; the other keys are those of the kind"},
};

constexpr KeyInfo line_keys[] = {
    {"name", "letters, digits, _ and -", "", "in lines.csv"},
    {"body", "name of a body", "", "whose points they are"},
    {"field", "FIELD", "", "`taut list fields`"},
    {"from", "[x, y], m", "", "the first point, at the start"},
    {"to", "[x, y], m", "", "the last point, at the start"},
    {"points", "whole number", "", "of points, 2 or more, evenly spaced"},
    {"times", "[number, ...], s", "", "when they are sampled, in growing order"},
    {"frame", "body or space", "body",
     "material points, or points that stand still while the body moves through them"},
};

constexpr KeyInfo measure_keys[] = {
    {"name", "letters, digits, _ and -", "", "its key in run.json"},
    {"of", "MEASURE", "", "`taut list measures`; the other keys are those of the kind"},
    {"unit", "text", "none", "shown to people; nothing is converted"},
};

constexpr KeyInfo reference_keys[] = {
    {"law", "LAW", "", "that it holds for: `taut list laws`"},
    {"name", "text", "", "what it is"},
    {"when", "{ PARAMETER = number }", "the scene's own values", "parameters for which it holds"},
    {"methods", "[METHOD, ...]", "all", "for these methods only"},
    {"values", "{ MEASURE = number }", "none", "what the measure should be"},
    {"tables", "{ MEASURE = { file, column } }", "none", "what the series should be"},
    {"solutions", "{ MEASURE = expression of t }", "none",
     "the same as a formula, of lines and fields also of the place; an array for several probes or fields; "
     "holds for any parameters that `when` does not name"},
    {"let", "{ NAME = number }", "none", "names for the solutions, each of the ones before"},
};

constexpr KeyInfo table_keys[] = {
    {"file", "path", "", "CSV, seen from the scene's folder; lines that start with # are comments"},
    {"column", "text", "of one probe or line", "beside the column t, s, or for a line s, m from its start"},
    {"columns", "[text, ...]", "of several probes", "a column for each"},
};

constexpr KeyInfo sweep_keys[] = {
    {"title", "text", "the file's name", "of the study"},
    {"scene", "SCENE", "", "a name of `taut list scenes`, or a path seen from this file"},
    {"set", "{ NAME = value }", "none", "for every run, as with --set"},
    {"grid", "[grid]", "this or [[row]]", "every combination of values"},
    {"row", "[[row]]", "this or [grid]", "one for each run"},
    {"chart", "[chart]", "none", "a picture of the results"},
    {"map", "[map]", "none", "a picture of the results"},
    {"history", "[history]", "none", "a picture of the results"},
};

constexpr KeyInfo grid_keys[] = {
    {any_name, "values", "",
     "what --set takes: \"low:high:step\" with both ends, \"a, b\", or [a, b]; \"method.CONSTANT\" in "
     "quotes"},
};

constexpr KeyInfo setting_keys[] = {
    {any_name, "value", "", "what --set takes; \"method.CONSTANT\" in quotes"},
};

constexpr KeyInfo chart_keys[] = {
    {"measure", "MEASURE or an array of them", "what most runs have",
     "whose error is drawn, into chart-MEASURE.png; without it into chart.png"},
    {"cost", "seconds or steps", "seconds", "what it is drawn over; steps: particles × steps"},
    {"methods", "METHOD or an array of them", "all", "whose runs are drawn"},
    {"against", "METHOD", "the references", "whose finest run stands for a reference"},
};

constexpr KeyInfo map_keys[] = {
    {"parameter", "NAME", "the one swept beside the method", "what it is drawn over"},
};

constexpr KeyInfo history_keys[] = {
    {any_name, "text", "", "a column of history.csv, with the label of its axis: tip = \"tip, m\""},
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
      {"parameters", "[parameters]", "NAME = { ... }: numbers that --set and sweeps change", parameter_keys},
      {"material", "[material.NAME]", "what bodies are made of", material},
      {"body", "[[body]]", "an elastic body", body_keys},
      {"shape", "shape = { ... }", "of a body, or what is cut out of it", shape_keys},
      {"rotate", "rotate = { ... }", "of a body", rotate_keys},
      {"parts", "parts = [{ ... }]", "of a body; where several hold the last one counts", part_keys},
      {"driven", "driven = [{ ... }]", "of a body; where several hold the last one counts", driven_keys},
      {"loaded", "loaded = [{ ... }]", "of a body; loads of several regions add up", loaded_keys},
      {"wall", "[[wall]]", "a rigid half-space", wall_keys},
      {"probe", "[[probe]]", "a quantity followed at every step, a column of history.csv", probe_keys},
      {"line", "[[line]]", "a field along a straight line of points, into lines.csv", line_keys},
      {"measure", "[[measure]]", "one number of a run, in run.json", measure_keys},
      {"reference", "[[reference]]", "what is known of the measures, for one law of elasticity",
       reference_keys},
      {"tables", "tables = { MEASURE = { ... } }", "of a reference: a measure over time or along a line",
       table_keys},
      {"render", "[render]", "what pictures show; options of `taut run` with the same names replace it",
       render},
  };
  return sections;
}

std::span<const Section> sweep_sections() {
  static constexpr Section sections[] = {
      {"sweep", "", "the file itself: keys above the first [header], and its sections", sweep_keys},
      {"set", "set = { ... }", "for every run", setting_keys},
      {"grid", "[grid]", "a run for every combination of the values", grid_keys},
      {"row", "[[row]]", "a run, in place of [grid]", setting_keys},
      {"chart", "[chart]", "error against cost, from the results", chart_keys},
      {"map", "[map]", "verdict, parameter × method, into map.png", map_keys},
      {"history", "[history]", "histories of all runs, into history.png", history_keys},
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
