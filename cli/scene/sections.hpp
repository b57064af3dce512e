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

#include "cli/scene/expression.hpp"
#include "cli/scene/key_info.hpp"
#include "cli/scene/scene_file.hpp"
#include "cli/scene/toml_cursor.hpp"
#include "engine/diagnostics/measure_kinds.hpp"
#include "engine/scene/scene.hpp"

/// The parts of a scene file, each read by a function of its own: it takes the cursor of the whole file and
/// writes what it finds into the scene, and defaults and settings into the file's table.
namespace taut::cli {

/// Settings by what they change.
struct Changes {
  std::optional<std::string> method, stepping, contact, law, cfl, spacing, until, jitter, jitter_seed;
  std::map<std::string, std::string> parameters;
  std::map<std::string, std::string> constants;  // of the method
};
Changes by_target(const std::vector<Setting>& settings);
/// Throws UsageError for what is neither a parameter nor a constant of the method.
void check_names(const Changes& changes, const SceneFile& file);
/// The value of a setting; throws UsageError where it is not a finite number.
double changed_number(std::string_view name, const std::string& text, const Names& names);
/// The same, greater than 0.
double changed_positive(std::string_view name, const std::string& text, const Names& names);

/// The parameters become names of `root`. Without `dp` those that depend on it are left out.
void read_parameters(TomlCursor& root, const Changes& changes, std::optional<double> dp, SceneFile& file);
/// dp and the parameters that follow from it.
std::set<std::string> names_that_need_dp(TomlCursor& root, const Changes& changes);
/// Method, its constants and law, stepping, cfl, contact.
void read_settings(TomlCursor& root, const Changes& changes, SceneFile& file);
/// `touching` in expressions: the gap below which bodies are in touch. Bodies may change what it is.
void name_touching(TomlCursor& root, const SceneFile& file);
/// Gravity and damping.
void read_outside(TomlCursor& root, Scene& scene);
void read_materials(TomlCursor& root, Scene& scene);
void read_bodies(TomlCursor& root, bool keeps_neighbors, SceneFile& file);
void read_walls(TomlCursor& root, Scene& scene);
void read_probes(TomlCursor& root, Scene& scene);
void read_lines(TomlCursor& root, Scene& scene);
void read_measures(TomlCursor& root, Scene& scene);
void read_references(TomlCursor& root, SceneFile& file);
/// The paths of tables and of what shapes are read from, as they are seen from `folder`.
void see_files_from(const std::filesystem::path& folder, TomlValue& scene);
/// The file that the key `file` names, from `folder` or from what comes with taut, and in the table from then
/// on so that it is found; `what` it is, for a message.
std::filesystem::path named_file(TomlCursor& table, const std::filesystem::path& folder,
                                 std::string_view what);
/// Of a scene whose bodies are known.
void read_drawing(TomlCursor& root, const Scene& scene, Drawing& drawing);
/// The drawing as a table of its own.
TomlValue drawing_table(const Drawing& drawing);

/// Columns `lead`, which grows, and `columns` of a CSV file; lines that start with # are comments. Throws
/// SceneError with the place in that file.
ReferenceTable read_table(const std::filesystem::path& path, const std::string& lead,
                          const std::vector<std::string>& columns);
/// The columns that a CSV file must have, then those that it may have, empty where it has not; and the line
/// of each row.
struct ColumnTable {
  std::vector<std::vector<double>> columns;
  std::vector<int> lines;

  std::size_t rows() const { return lines.size(); }
};
ColumnTable read_columns(const std::filesystem::path& path, const std::vector<std::string>& needed,
                         const std::vector<std::string>& optional);
/// The whole file; throws SceneError if it is not there, cannot be read or is larger than `most_bytes`.
std::string file_text(const std::filesystem::path& path, std::size_t most_bytes = 4 << 20);

inline const std::vector<std::string> axis_names = {"x", "y", "z"};

/// How the round shapes of a body are laid where the file does not say: for a method that keeps the
/// neighbours of the start, for one that searches for them; of a body that asks for a lattice; none are laid
/// of what is cut out.
enum class Layers : std::uint8_t { that_fit_faces, evenly_spaced, of_lattice, none };
/// What a shape is read with.
struct ShapeSetting {
  int dim = 2;
  double dp = 0;                 // m
  std::filesystem::path folder;  // of the scene file
  Layers layers{};
  bool alone = false;  // a body by itself
  int level = 0;       // combined shapes around the shape
};
/// A shape as scene files name it.
struct ShapeKind {
  std::string_view name;
  int dim;  // 0: either
  std::string_view help;
  std::span<const KeyInfo> keys;  // beside those of every shape
  std::string_view otherwise;     // what comes nearest in the other dimension
  Shape (*read)(TomlCursor&, const ShapeSetting&);
};
std::span<const ShapeKind> shape_kinds();

/// The shapes of `key`: one table, or an array of tables.
std::vector<Shape> read_shapes(TomlCursor& body, std::string_view key, const ShapeSetting& setting);
/// The key `rotate` of a body or a shape: in 2D degrees, or a table with them and the point that it turns
/// about; about `middle` unless it says otherwise. None if it is not there.
std::optional<Rotation> read_rotation(TomlCursor& cursor, int dim, const Point& middle);

/// Throws SceneError for a name longer than one of an expression may be.
void check_name_length(const TomlCursor& table, FilePlace place, std::string_view key,
                       const std::string& name);
/// Throws SceneError for a key that cannot be a name in expressions, or is one already.
void check_new_name(const TomlCursor& table, const TomlEntry& entry, std::string_view kind);
/// The name of an entry: letters, digits, '_' and '-', not one of `taken`.
std::string label(TomlCursor& entry, const std::vector<std::string>& taken);
/// The names that an expression about a body knows besides the parameters: c0, E, nu, rho, K, G.
void add_names(Names& names, const Material& material);

/// `axis = [0, 0, 1]`, unless given, of a turn in 3D: of length 1. In 2D there is no such key: it is z.
Point turning_axis(TomlCursor& cursor, const Scene& scene);

/// A kind of probe.
struct ProbeKind {
  std::string_view name;
  std::string_view unit, help;
  std::vector<KeyInfo> keys;  // beside `name` and `of`

  static constexpr std::string_view force_unit = "N, in 2D N/m";
  Probe::Kind kind() const { return {name, unit == force_unit}; }
  bool takes(std::string_view key) const;
};
std::span<const ProbeKind> probe_kinds();
/// Of the values of a probe; empty where it is not known. Forces in the plane are per metre of depth.
std::string_view unit_of(const Probe& probe, int dim);

/// The keys of a kind of measure, beside `name`, `of` and `unit`.
std::vector<KeyInfo> keys_of_measure(const MeasureKind& kind);

/// A way in which bodies act on each other.
struct ContactChoice {
  ContactLaw law;
  std::string_view help;
};
std::span<const ContactChoice> contact_choices();

/// The law of methods whose stress has no part out of the plane, as references and run.json name it. It
/// cannot be chosen.
inline constexpr std::string_view in_plane_law = "2d_deviator";
/// "neo-hookean": as scene files and options name what run.json calls neo_hookean.
std::string law_name(std::string_view material_law);

/// The body that `value` names.
int body_index(TomlCursor& cursor, const TomlValue& value, std::string_view key, const Scene& scene);

/// The tables of [[key]], each with a cursor that knows its name and its keys.
template <class Read>
void read_each(TomlCursor& root, const std::string& key, const Read& read) {
  int number = 0;
  for (TomlValue& value : root.list(key)) {
    const TomlEntry* name = value.find("name");
    const std::string known_as = name ? name->value.text : std::to_string(++number);
    TomlCursor cursor = root.enter(value, key + "." + known_as, key + " '" + known_as + "'", keys_of(key));
    read(cursor);
  }
}

template <class Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.emplace_back(item.name);
  return names;
}

/// The place of `name` among the items' names, or their number.
template <class Items>
std::size_t index_of(const Items& items, std::string_view name) {
  std::size_t i = 0;
  while (i < items.size() && items[i].name != name) ++i;
  return i;
}

}  // namespace taut::cli
