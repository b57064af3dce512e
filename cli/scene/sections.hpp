#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/drawing/keys.hpp"
#include "cli/scene/expression.hpp"
#include "cli/scene/key_info.hpp"
#include "cli/scene/scene_file.hpp"
#include "cli/scene/toml_cursor.hpp"
#include "engine/diagnostics/measure_kinds.hpp"
#include "engine/scene/scene.hpp"

/// Readers of sections of a scene file. They fill the scene, write defaults and settings into the file's table, and
/// throw SceneError for wrong values in the file, UsageError for wrong settings.
namespace taut::cli {

/// Texts of settings by name.
struct Changes {
  std::map<std::string, std::string, std::less<>> general, parameters, constants;  // constants of the method

  /// A general setting, or nullptr.
  const std::string* find(std::string_view name) const;
};
Changes by_target(const std::vector<Setting>& settings);
/// Throws UsageError for a name that is neither a parameter nor a constant of the method.
void check_names(const Changes& changes, const SceneFile& file);
/// Adds a resolved setting. `in_scene` is its value without changes by settings, `usual` its default.
void resolve(SceneFile& file, std::string name, const std::string& value, const std::string& in_scene,
             const std::string& usual);
void resolve(SceneFile& file, std::string name, double value, double in_scene, double usual);
/// Value of a setting. Throws UsageError unless it is finite.
double changed_number(std::string_view name, const std::string& text, const Names& names);
/// Value of a setting. Throws UsageError unless it is finite and greater than 0.
double changed_positive(std::string_view name, const std::string& text, const Names& names);

/// Makes the parameters names of `root`. Without `dp`, skips those that depend on it.
void read_parameters(TomlCursor& root, const Changes& changes, std::optional<double> dp, SceneFile& file);
/// `dp`, and the parameters that depend on it.
std::set<std::string> names_that_need_dp(TomlCursor& root, const Changes& changes);
/// Reads method, constants, law, stepping, cfl and contact.
void read_settings(TomlCursor& root, const Changes& changes, SceneFile& file);
/// Defines `touching`, the gap below which bodies touch, m. Call it again after read_bodies: bodies can change the
/// published contact law.
void name_touching(TomlCursor& root, const SceneFile& file);
/// Reads gravity and damping.
void read_gravity_and_damping(TomlCursor& root, Scene& scene);
void read_materials(TomlCursor& root, Scene& scene);
void read_bodies(TomlCursor& root, bool keeps_neighbors, SceneFile& file);
void read_walls(TomlCursor& root, Scene& scene);
void read_probes(TomlCursor& root, Scene& scene);
void read_lines(TomlCursor& root, Scene& scene);
void read_measures(TomlCursor& root, Scene& scene);
void read_references(TomlCursor& root, SceneFile& file);
/// Makes the paths of tables and shape files relative to `folder`.
void make_paths_relative(const std::filesystem::path& folder, TomlValue& scene);
/// Finds the file of the key `file` in `folder` or a scene folder, and writes its path into the table. `what` names
/// the kind of file in messages.
std::filesystem::path named_file(TomlCursor& table, const std::filesystem::path& folder,
                                 std::string_view what);
/// Reads the drawing. Requires the scene's bodies.
void read_drawing(TomlCursor& root, const Scene& scene, Drawing& drawing);
/// Reads keys of [render] in a file other than a scene. Whether they fit the scene is checked by apply_scene.
DrawingValues read_drawing_values(TomlCursor& render);
TomlValue drawing_table(const Drawing& drawing);

/// Reads columns of a CSV file, in which `lead` must increase. Lines that start with # are comments. Throws
/// SceneError with the place in that file.
ReferenceTable read_table(const std::filesystem::path& path, const std::string& lead,
                          const std::vector<std::string>& columns);
struct ColumnTable {
  std::vector<std::vector<double>> columns;  // needed, then optional; a missing one is empty
  std::vector<int> lines;                    // line of each row in the file

  std::size_t rows() const { return lines.size(); }
};
ColumnTable read_columns(const std::filesystem::path& path, const std::vector<std::string>& needed,
                         const std::vector<std::string>& optional);
/// Contents of a file. Throws SceneError if it is missing, unreadable or larger than `most_bytes`.
std::string file_text(const std::filesystem::path& path, std::size_t most_bytes = 4 << 20);

inline const std::vector<std::string> axis_names = {"x", "y", "z"};

/// Default layout of round shapes.
enum class Layers : std::uint8_t {
  for_initial_neighbours,   // methods with initial neighbours
  for_searched_neighbours,  // methods that search neighbours
  of_lattice,               // the body has a hexagonal lattice
  none                      // cut-outs, combined shapes
};
struct ShapeSetting {
  int dim = 2;
  double dp = 0;                 // m
  std::filesystem::path folder;  // of the scene file
  Layers layers{};
  bool alone = false;  // only shape of its body, without cut-outs
  int level = 0;       // number of combined shapes around it
};
struct ShapeKind {
  std::string_view name;
  int dim;  // 0: 2D and 3D
  std::string_view help;
  std::span<const KeyInfo> keys;  // besides the keys of every shape
  std::string_view otherwise;     // nearest type in the other dimension
  Shape (*read)(TomlCursor&, const ShapeSetting&);
};
std::span<const ShapeKind> shape_kinds();

/// Reads one table or an array of tables.
std::vector<Shape> read_shapes(TomlCursor& body, std::string_view key, const ShapeSetting& setting);
/// Reads the key `rotate`: degrees (2D only) or { angle, about, axis }, by default about `middle`.
std::optional<Rotation> read_rotation(TomlCursor& cursor, int dim, const Point& middle);

/// Throws SceneError for a name that is too long for expressions.
void check_name_length(const TomlCursor& table, FilePlace place, std::string_view key,
                       const std::string& name);
/// Throws SceneError for a key that cannot be a name in expressions, or is one already.
void check_new_name(const TomlCursor& table, const TomlEntry& entry, std::string_view kind);
/// Reads the key `name`: letters, digits, '_' and '-', none of `taken`.
std::string label(TomlCursor& entry, const std::vector<std::string>& taken);
/// Adds c0, E, nu, rho, K and G of the material to the names of expressions.
void add_names(Names& names, const Material& material);

/// Reads the rotation axis, the key `axis`, as a unit vector: z by default, and always in 2D, which has no such key.
Point turning_axis(TomlCursor& cursor, const Scene& scene);

struct ProbeKind {
  std::string_view name;
  std::string_view unit, help;
  std::vector<KeyInfo> keys;  // beside `name` and `of`

  static constexpr std::string_view force_unit = "N, in 2D N/m";
  Probe::Kind kind() const { return {name, unit == force_unit}; }
  bool takes(std::string_view key) const;
};
std::span<const ProbeKind> probe_kinds();
/// Unit of a probe's values; empty for expressions. Forces in 2D are per metre of depth.
std::string_view unit_of(const Probe& probe, int dim);

/// Keys of a kind of measure, beside `name`, `of` and `unit`.
std::vector<KeyInfo> keys_of_measure(const MeasureKind& kind);

struct ContactChoice {
  ContactLaw law;
  std::string_view help;
};
std::span<const ContactChoice> contact_choices();

/// Law of methods without out-of-plane stress, as references and run.json name it. Scenes cannot choose it.
inline constexpr std::string_view in_plane_law = "2d_deviator";
/// Converts a law's name from run.json (neo_hookean) to the form of scene files and options (neo-hookean).
std::string law_name(std::string_view material_law);

int body_index(TomlCursor& cursor, const TomlValue& value, std::string_view key, const Scene& scene);

template <class Read>
void read_each(TomlCursor& root, const std::string& key, const Read& read) {
  int number = 0;
  for (TomlValue& value : root.list(key)) {
    const TomlEntry* name = value.find("name");
    const std::string label = name ? name->value.text : std::to_string(++number);
    TomlCursor cursor = root.enter(value, key + "." + label, key + " '" + label + "'", keys_of(key));
    read(cursor);
  }
}

template <class Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.emplace_back(item.name);
  return names;
}

/// Index of the item called `name`, or the number of items.
template <class Items>
std::size_t index_of(const Items& items, std::string_view name) {
  std::size_t i = 0;
  while (i < items.size() && items[i].name != name) ++i;
  return i;
}

}  // namespace taut::cli
