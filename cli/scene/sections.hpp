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

#include <fmt/core.h>

#include "cli/drawing/keys.hpp"
#include "cli/scene/expression.hpp"
#include "cli/scene/key_info.hpp"
#include "cli/scene/scene_file.hpp"
#include "cli/scene/toml_cursor.hpp"
#include "engine/diagnostics/measure_kinds.hpp"
#include "engine/scene/scene.hpp"

/// Readers write defaults and settings into the table. They throw SceneError for the file, UsageError for settings.
namespace taut::cli {

/// Texts of settings, by name.
struct Changes {
  std::map<std::string, std::string, std::less<>> general, parameters, constants;

  const std::string* find(std::string_view name) const;
};
Changes by_target(const std::vector<Setting>& settings);
/// Throws UsageError for unknown names.
void check_names(const Changes& changes, const SceneFile& file);
/// `in_scene`: value without settings; `usual`: default.
void resolve(SceneFile& file, std::string name, const std::string& value, const std::string& in_scene,
             const std::string& usual);
void resolve(SceneFile& file, std::string name, double value, double in_scene, double usual);
/// Throws UsageError unless finite.
double changed_number(std::string_view name, const std::string& text, const Names& names);
/// Throws UsageError unless finite and within the key's bounds.
double changed_number(const KeyInfo& key, const std::string& text, const Names& names);

/// Without `dp`, reads only parameters independent of dp.
void read_parameters(TomlCursor& root, const Changes& changes, std::optional<double> dp, SceneFile& file);
/// Includes `dp`.
std::set<std::string> names_that_need_dp(TomlCursor& root, const Changes& changes);
void read_settings(TomlCursor& root, const Changes& changes, SceneFile& file);
/// Defines `touching`: gap in m below which faces count as touching. The published contact law depends on the bodies:
/// call again after read_bodies.
void name_touching(TomlCursor& root, const SceneFile& file);
void read_gravity_and_damping(TomlCursor& root, Scene& scene);
void read_materials(TomlCursor& root, Scene& scene);
void read_bodies(TomlCursor& root, bool keeps_neighbors, SceneFile& file);
void read_walls(TomlCursor& root, Scene& scene);
void read_probes(TomlCursor& root, Scene& scene);
void read_lines(TomlCursor& root, Scene& scene);
void read_measures(TomlCursor& root, Scene& scene);
void read_references(TomlCursor& root, SceneFile& file);
void make_paths_relative(const std::filesystem::path& folder, TomlValue& scene);
/// Searches `folder`, then the scene folders. Makes the key `file` relative to a scene folder, or absolute.
std::filesystem::path named_file(TomlCursor& table, const std::filesystem::path& folder,
                                 std::string_view what);
/// Requires the scene's bodies.
void read_drawing(TomlCursor& root, const Scene& scene, Drawing& drawing);
/// For files other than scenes.
DrawingValues read_drawing_values(TomlCursor& render);
TomlValue drawing_table(const Drawing& drawing);

/// Values of `lead` must increase. Throws SceneError with the place.
ReferenceTable read_table(const std::filesystem::path& path, const std::string& lead,
                          const std::vector<std::string>& columns);
struct ColumnTable {
  std::vector<std::vector<double>> columns;  // empty if optional and missing
  std::vector<int> lines;

  std::size_t rows() const { return lines.size(); }
};
ColumnTable read_columns(const std::filesystem::path& path, const std::vector<std::string>& needed,
                         const std::vector<std::string>& optional);
/// Throws SceneError.
std::string file_text(const std::filesystem::path& path, std::size_t most_bytes = 4 << 20);

inline const std::vector<std::string> axis_names = {"x", "y", "z"};

/// Layout of round shapes.
enum class Layers : std::uint8_t {
  for_initial_neighbours,
  for_searched_neighbours,
  of_lattice,  // cut from the lattice
  none
};
struct ShapeSetting {
  int dim = 2;
  double dp = 0;  // m
  std::filesystem::path folder;
  Layers layers{};
  bool alone = false;  // only shape of its body, no cut-outs
  int level = 0;       // enclosing shapes
};
struct ShapeKind {
  std::string_view name;
  int dim;  // 0: both
  std::string_view help;
  std::span<const KeyInfo> keys;  // besides common keys
  std::string_view otherwise;     // similar types in the other dimension
  Shape (*read)(TomlCursor&, const ShapeSetting&);
};
std::span<const ShapeKind> shape_kinds();

std::vector<Shape> read_shapes(TomlCursor& body, std::string_view key, const ShapeSetting& setting);
/// Degrees (2D), or { angle, about, axis }; default: about `middle`.
std::optional<Rotation> read_rotation(TomlCursor& cursor, int dim, const Point& middle);

/// Throws SceneError if too long for expressions.
void check_name_length(const TomlCursor& table, FilePlace place, std::string_view key,
                       const std::string& name);
/// Throws SceneError for invalid and reserved names.
void check_new_name(const TomlCursor& table, const TomlEntry& entry, std::string_view kind);
/// Reads `name`: letters, digits, '_' and '-'; not in `taken`.
std::string label(TomlCursor& entry, const std::vector<std::string>& taken);
void add_names(Names& names, const Material& material);

/// Unit vector; default and in 2D: z.
Point turning_axis(TomlCursor& cursor, const Scene& scene);

struct ProbeKind {
  std::string_view name;
  std::string_view unit, help;
  std::vector<KeyInfo> keys;

  static constexpr std::string_view force_unit = "N, in 2D N/m";
  Probe::Kind kind() const { return {name, unit == force_unit}; }
  bool takes(std::string_view key) const;
};
std::span<const ProbeKind> probe_kinds();
/// Empty for expressions.
std::string_view unit_of(const Probe& probe, int dim);

std::vector<KeyInfo> keys_of_measure(const MeasureKind& kind);

struct ContactChoice {
  ContactLaw law;
  std::string_view help;
};
std::span<const ContactChoice> contact_choices();

/// Law of methods with a 2D deviator, in references and run.json.
inline constexpr std::string_view in_plane_law = "2d_deviator";
/// neo_hookean (run.json) to neo-hookean.
std::string law_name(std::string_view material_law);

int body_index(TomlCursor& cursor, const TomlValue& value, std::string_view key, const Scene& scene);

template <class Read>
void read_each(TomlCursor& root, const std::string& key, const Read& read) {
  int number = 0;
  for (TomlValue& value : root.list(key)) {
    const TomlEntry* name = value.find("name");
    const std::string label = name ? name->value.text : std::to_string(++number);
    TomlCursor cursor =
        root.enter(value, fmt::format("{}.{}", key, label), fmt::format("{} '{}'", key, label), keys_of(key));
    read(cursor);
  }
}

template <class Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.emplace_back(item.name);
  return names;
}

/// items.size() if not found.
template <class Items>
std::size_t index_of(const Items& items, std::string_view name) {
  std::size_t i = 0;
  while (i < items.size() && items[i].name != name) ++i;
  return i;
}

}  // namespace taut::cli
