#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "cli/scene/sections.hpp"
#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"
#include "engine/diagnostics/fields.hpp"
#include "engine/families/catalogue.hpp"
#include "render/colormap.hpp"
#include "render/renderer.hpp"

namespace taut::cli {
namespace {

constexpr std::string_view automatic = "auto";

const std::vector<std::string> stepping_names = {"dual", "single"};

constexpr std::array contact_laws = {ContactLaw::published, ContactLaw::sph, ContactLaw::impulse,
                                     ContactLaw::penalty, ContactLaw::lennard_jones};

std::vector<std::string> names_of_laws() {
  std::vector<std::string> names;
  for (const ContactLaw law : contact_laws) names.emplace_back(name(law));
  return names;
}

/// One of `names`, the first by default: as changed, else as in the file.
std::string chosen(TomlCursor& root, const std::string& key, const std::vector<std::string>& names,
                   const std::optional<std::string>& change) {
  root.text(key, names.front());
  const std::string in_file = root.choice(key, names);
  if (!change) return in_file;
  if (std::find(names.begin(), names.end(), *change) == names.end())
    throw UsageError("unknown " + key + " '" + *change + "'" + did_you_mean(*change, names) +
                     "; there are: " + join(names));
  root.table().set(key, TomlValue(*change));
  return *change;
}

std::string bounds_text(const MethodConstant& constant) {
  return "; allowed: " + exact(constant.low) + " to " + exact(constant.high);
}

bool within_bounds(const MethodConstant& constant, double value) {
  return value >= constant.low && value <= constant.high;
}

/// The method of the file.
const MethodInfo& file_method(TomlCursor& root) {
  const std::string name = root.text("method", Settings().method);
  const MethodInfo* method = find_method(name);
  if (!method) root.fail_unknown(*root.find("method"), "method", "method", name, names_of(methods()));
  return *method;
}

const MethodInfo& changed_method(const std::string& name) {
  const MethodInfo* method = find_method(name);
  const std::vector<std::string> known = names_of(methods());
  if (!method)
    throw UsageError("unknown method '" + name + "'" + did_you_mean(name, known) +
                     "; there are: " + join(known));
  return *method;
}

/// Checks the file's constants against the method of the file.
void check_constants(TomlCursor& section, const MethodInfo& method) {
  for (TomlEntry& entry : section.table().entries) {
    const std::size_t i = index_of(method.constants, entry.key);
    if (i == method.constants.size())
      section.fail(entry.place, entry.key,
                   "the method '" + std::string(method.name) + "' has no constant '" + entry.key + "'" +
                       did_you_mean(entry.key, names_of(method.constants)) +
                       "; it has: " + (method.constants.empty() ? "none" : join(names_of(method.constants))));
    const double value = section.number(entry.key);
    if (!within_bounds(method.constants[i], value))
      section.fail(entry.value, entry.key,
                   entry.key + " = " + exact(value) + " is out of bounds" + bounds_text(method.constants[i]));
  }
}

/// Every constant of the method: as changed, else as in the file, else the published default.
void read_constants(TomlCursor& root, const MethodInfo& of_file, const MethodInfo& method,
                    const Changes& changes, Settings& settings) {
  TomlCursor section = root.section("method_constants", "[method_constants]");
  check_constants(section, of_file);
  if (&of_file != &method) section.table().entries.clear();
  for (const MethodConstant& constant : method.constants) {
    const std::string name(constant.name);
    double value = section.number(name, constant.value);
    if (const auto change = changes.constants.find(name); change != changes.constants.end()) {
      value = changed_number("method." + name, change->second, root.names());
      if (!within_bounds(constant, value))
        throw UsageError("method." + name + " = " + change->second + " is out of bounds" +
                         bounds_text(constant));
    }
    section.table().set(name, TomlValue(value));
    settings.constants[name] = value;
  }
}

/// The law of elasticity of a method that leaves it open. That of a file belongs to the method of the file.
void read_law(TomlCursor& root, const MethodInfo& of_file, const MethodInfo& method, const Changes& changes,
              Settings& settings) {
  if (const TomlValue* given = root.find("law"); given && of_file.laws.empty())
    root.fail(*given, "law", "the law of the method '" + std::string(of_file.name) + "' cannot be chosen");
  if (!of_file.laws.empty()) {
    root.text("law", of_file.laws.front().name);
    settings.law = root.choice("law", names_of(of_file.laws));
  }
  if (method.laws.empty()) {
    settings.law.clear();
    std::erase_if(root.table().entries, [](const TomlEntry& entry) { return entry.key == "law"; });
    if (changes.law)
      throw UsageError("the law of the method '" + std::string(method.name) + "' cannot be chosen");
    return;
  }
  if (&method != &of_file) settings.law = method.laws.front().name;
  if (changes.law) settings.law = *changes.law;
  const std::vector<std::string> known = names_of(method.laws);
  if (std::ranges::find(known, settings.law) == known.end())
    throw UsageError(unknown_name("law", settings.law, known));
  root.table().set("law", TomlValue(settings.law));
}

void read_range(TomlCursor& render, Drawing& drawing) {
  const TomlValue* range = render.find("range");
  if (!range) render.table().set("range", TomlValue(std::string(automatic)));
  if (!range || (range->kind == TomlValue::Kind::text && range->text == automatic)) return;
  if (range->kind != TomlValue::Kind::array)
    render.fail(*range, "range",
                "range must be \"auto\" or [low, high], this is " + std::string(range->kind_name()));
  const std::vector<double> ends = render.numbers("range", 2);
  if (!(ends[0] < ends[1]))
    render.fail(
        *range, "range",
        "range = [" + exact(ends[0]) + ", " + exact(ends[1]) + "]: the first must be less than the second");
  drawing.range = {ends[0], ends[1]};
}

void read_view(TomlCursor& render, Drawing& drawing) {
  const TomlValue* view = render.find("view");
  if (!view) render.table().set("view", TomlValue(std::string(automatic)));
  if (!view || (view->kind == TomlValue::Kind::text && view->text == automatic)) return;
  if (view->kind != TomlValue::Kind::array)
    render.fail(
        *view, "view",
        "view must be \"auto\" or [x_min, x_max, y_min, y_max], this is " + std::string(view->kind_name()));
  const std::vector<double> ends = render.numbers("view", 4);
  if (!(ends[0] < ends[1]) || !(ends[2] < ends[3]))
    render.fail(*view, "view", "view = [x_min, x_max, y_min, y_max] needs x_min < x_max and y_min < y_max");
  drawing.view = {ends[0], ends[1], ends[2], ends[3]};
}

void read_colors(TomlCursor& render, Drawing& drawing) {
  drawing.color = render.text("color", drawing.color);
  if (!find_field(drawing.color))
    render.fail_unknown(*render.find("color"), "color", "field", drawing.color, names_of_fields());
  drawing.colormap = render.text("colormap", automatic);
  if (drawing.colormap == automatic) drawing.colormap.clear();
  if (drawing.colormap.empty() || render::find_colormap(drawing.colormap)) return;
  std::vector<std::string> known = {std::string(automatic)};
  for (const render::Colormap& map : render::colormaps()) known.emplace_back(map.key);
  render.fail_unknown(*render.find("colormap"), "colormap", "colour map", drawing.colormap, known);
}

void read_size(TomlCursor& render, Drawing& drawing) {
  if (!render.find("size")) {
    TomlValue size;
    size.kind = TomlValue::Kind::array;
    for (const int pixels : drawing.size) size.items.emplace_back(static_cast<double>(pixels)).whole = true;
    render.table().set("size", std::move(size));
  }
  const std::vector<double> size = render.numbers("size", 2);
  for (std::size_t i = 0; i < 2; ++i) {
    if (!(size[i] >= render::least_size && size[i] <= render::greatest_size) ||
        size[i] != std::floor(size[i]))
      render.fail(*render.find("size"), "size",
                  "size must be two whole numbers of pixels from " + std::to_string(render::least_size) +
                      " to " + std::to_string(render::greatest_size));
    drawing.size[i] = static_cast<int>(size[i]);
  }
}

TomlValue number_array(const auto& numbers, bool whole) {
  TomlValue array;
  array.kind = TomlValue::Kind::array;
  for (const auto number : numbers) array.items.emplace_back(static_cast<double>(number)).whole = whole;
  return array;
}

}  // namespace

std::vector<std::string> names_of_fields() {
  std::vector<std::string> names;
  for (const Field& field : fields()) names.emplace_back(field.key);
  return names;
}

std::vector<std::string> texts_to_set(std::string_view name) {
  if (name == "method") return names_of(methods());
  if (name == "stepping") return stepping_names;
  return name == "contact" ? names_of_laws() : std::vector<std::string>();
}

void read_settings(TomlCursor& root, const Changes& changes, SceneFile& file) {
  const MethodInfo& of_file = file_method(root);
  const MethodInfo& method = changes.method ? changed_method(*changes.method) : of_file;
  file.settings.method = std::string(method.name);
  root.table().set("method", TomlValue(file.settings.method));
  check_names(changes, file);

  const std::string stepping = chosen(root, "stepping", stepping_names, changes.stepping);
  file.settings.stepping = stepping == stepping_names.front() ? Stepping::dual : Stepping::single;
  const std::string contact = chosen(root, "contact", names_of_laws(), changes.contact);
  file.scene.contact = *std::ranges::find(contact_laws, contact, [](ContactLaw law) { return name(law); });
  const ContactLaw law = file.scene.contact == ContactLaw::published ? method.contact : file.scene.contact;
  // the gap below which bodies are in touch: particles that act on those of another body as on their own
  // repel them before faces meet; with the other laws faces that meet obliquely leave a tenth of a spacing
  root.names()["touching"] = (law == ContactLaw::sph ? 0.9 : 0.1) * root.names().at("dp");

  read_law(root, of_file, method, changes, file.settings);
  // constants and CFL number of a file belong to the method of the file; another one takes its own
  double cfl = root.find("cfl") ? root.positive("cfl") : of_file.cfl;
  if (&method != &of_file) cfl = method.cfl;
  if (changes.cfl) cfl = changed_positive("cfl", *changes.cfl, root.names());
  root.table().set("cfl", TomlValue(cfl));
  file.settings.cfl = cfl;
  read_constants(root, of_file, method, changes, file.settings);
}

void read_drawing(TomlCursor& root, Drawing& drawing) {
  constexpr int most_frames = 1000000;
  TomlCursor render = root.section("render", "[render]");
  read_colors(render, drawing);
  read_range(render, drawing);
  read_view(render, drawing);
  read_size(render, drawing);
  drawing.frames = render.whole("frames", drawing.frames, 1, most_frames);
  render.finish();
}

TomlValue drawing_table(const Drawing& drawing) {
  TomlValue table;
  table.section = true;
  const TomlValue none{std::string(automatic)};
  table.set("color", TomlValue(drawing.color));
  table.set("range", drawing.range ? number_array(*drawing.range, false) : none);
  table.set("colormap", drawing.colormap.empty() ? none : TomlValue(drawing.colormap));
  table.set("view", drawing.view ? number_array(*drawing.view, false) : none);
  table.set("size", number_array(drawing.size, true));
  TomlValue frames(static_cast<double>(drawing.frames));
  frames.whole = true;
  table.set("frames", std::move(frames));
  return table;
}

}  // namespace taut::cli
