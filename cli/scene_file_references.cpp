#include <algorithm>
#include <cmath>
#include <map>

#include "cli/scene_file_parts.hpp"
#include "cli/text.hpp"

namespace taut {
namespace {

const std::vector<std::string> laws = {"2d_deviator", "neo_hookean"};

bool alike(double a, double b) {
  constexpr double tolerance = 1e-9;  // relative
  return std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b));
}

/// A reference was made for one set of parameters: those of `when`, and the scene's own for the rest.
bool holds(TomlCursor& reference, const std::vector<Parameter>& parameters) {
  std::map<std::string, double> wanted;
  for (const Parameter& parameter : parameters) wanted[parameter.name] = parameter.default_value;
  if (TomlValue* value = reference.find("when")) {
    TomlCursor when = reference.enter(*value, "when", "'when' of " + reference.what());
    for (const TomlEntry& entry : when.table().entries) {
      if (!wanted.contains(entry.key))
        when.fail_unknown(entry.value, entry.key, "parameter", entry.key, names_of(parameters));
      wanted[entry.key] = when.number(entry.key);
    }
  }
  return std::all_of(parameters.begin(), parameters.end(), [&](const Parameter& parameter) {
    return alike(parameter.value, wanted[parameter.name]);
  });
}

const Measure& known_measure(TomlCursor& cursor, const TomlEntry& entry, const Scene& scene) {
  const std::size_t i = index_of(scene.measures, entry.key);
  if (i < scene.measures.size()) return scene.measures[i];
  TomlValue key;
  key.place = entry.place;
  cursor.fail_unknown(key, entry.key, "measure", entry.key, names_of(scene.measures));
}

std::map<std::string, double> read_values(TomlCursor& reference, const Scene& scene) {
  std::map<std::string, double> values;
  TomlValue* table = reference.find("values");
  if (!table) return values;
  TomlCursor cursor = reference.enter(*table, "values", "'values' of " + reference.what());
  for (const TomlEntry& entry : cursor.table().entries) {
    known_measure(cursor, entry, scene);
    values[entry.key] = cursor.number(entry.key);
  }
  return values;
}

ReferenceTable read_one_table(TomlCursor entry, const std::filesystem::path& folder) {
  const std::filesystem::path path = (folder / entry.text("file")).lexically_normal();
  const std::string column = entry.text("column");
  entry.finish();
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    entry.fail(entry.need("file"), "file",
               "there is no table '" + path.string() + "'; the path starts at the scene's folder");
  entry.table().set("file", TomlValue(path.string()));
  return read_table(path, column);
}

std::map<std::string, ReferenceTable> read_tables(TomlCursor& reference, const SceneFile& file) {
  std::map<std::string, ReferenceTable> tables;
  TomlValue* table = reference.find("tables");
  if (!table) return tables;
  const std::filesystem::path folder = std::filesystem::absolute(file.path).parent_path();
  TomlCursor cursor = reference.enter(*table, "tables", "'tables' of " + reference.what());
  for (TomlEntry& entry : cursor.table().entries) {
    if (known_measure(cursor, entry, file.scene).kind != Measure::Kind::rmse)
      cursor.fail(entry.place, entry.key,
                  "the measure '" + entry.key + "' is compared with a value; only one of rmse takes a table");
    tables[entry.key] =
        read_one_table(cursor.enter(entry.value, entry.key, "table '" + entry.key + "'"), folder);
  }
  return tables;
}

}  // namespace

void read_references(TomlCursor& root, SceneFile& file) {
  for (TomlValue& value : root.list("reference")) {
    TomlCursor cursor = root.enter(value, "reference", "a reference");
    const std::string law = cursor.choice("law", laws);
    const Reference reference{.name = cursor.text("name"),
                              .value = read_values(cursor, file.scene),
                              .table = read_tables(cursor, file)};
    const bool applies = holds(cursor, file.parameters);
    cursor.finish();
    if (applies && !file.scene.references.emplace(law, reference).second)
      cursor.fail(
          value, "law",
          "two references of the law '" + law + "' hold for these parameters; tell them apart with 'when'");
  }
}

}  // namespace taut
