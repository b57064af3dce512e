#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include <fmt/core.h>

#include "cli/scene/sections.hpp"
#include "cli/text/format.hpp"
#include "engine/diagnostics/measure_kinds.hpp"
#include "engine/methods/catalogue.hpp"

namespace taut::cli {
namespace {

std::vector<std::string_view> material_laws() {
  std::vector<std::string_view> names{in_plane_law};
  for (const LawRow& law : laws())
    if (!law.choice.empty()) names.push_back(law.material_law);
  return names;
}

/// Accepts neo-hookean and neo_hookean.
std::string read_law(TomlCursor& reference) {
  const std::string given = reference.text("law");
  std::vector<std::string> known;
  for (const std::string_view law : material_laws()) {
    if (given == law || given == law_name(law)) return std::string(law);
    known.push_back(law_name(law));
  }
  reference.fail_unknown(reference.need("law"), "law", "law", given, known);
}

bool alike(double a, double b) {
  constexpr double tolerance = 1e-9;  // relative
  return std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b));
}

struct Validity {
  bool values = false;     // each parameter has the value of `when`, else its default
  bool solutions = false;  // each parameter in `when` has that value
};

Validity validity(TomlCursor& reference, const std::vector<Parameter>& parameters) {
  std::map<std::string, double> wanted;
  if (TomlValue* value = reference.find("when")) {
    TomlCursor when = reference.enter(*value, "when", "'when' of " + reference.what(), named_by_user);
    for (const TomlEntry& entry : when.table().entries) {
      if (index_of(parameters, entry.key) == parameters.size())
        when.fail_unknown(entry.value, entry.key, "parameter", entry.key, names_of(parameters));
      wanted[entry.key] = when.number(entry.key);
    }
  }
  Validity valid{true, true};
  for (const Parameter& parameter : parameters) {
    const auto found = wanted.find(parameter.name);
    const bool asked = found != wanted.end();
    const bool as_made = alike(parameter.value, asked ? found->second : parameter.default_value);
    valid.values = valid.values && as_made;
    valid.solutions = valid.solutions && (as_made || !asked);
  }
  return valid;
}

void read_names(TomlCursor& reference) {
  TomlValue* table = reference.find("let");
  if (!table) return;
  TomlCursor cursor = reference.enter(*table, "let", "'let' of " + reference.what(), named_by_user);
  for (const TomlEntry& entry : cursor.table().entries) {
    check_new_name(cursor, entry, "number");
    if (cursor.names().contains(entry.key))
      cursor.fail(entry.place, entry.key,
                  fmt::format("the name '{}' is already a parameter; choose another name", entry.key));
    const double value = cursor.number(entry.key);
    cursor.names()[entry.key] = value;
  }
  reference.names() = cursor.names();
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
  TomlCursor cursor = reference.enter(*table, "values", "'values' of " + reference.what(), named_by_user);
  for (const TomlEntry& entry : cursor.table().entries) {
    const MeasureKind& kind = *find_measure_kind(known_measure(cursor, entry, scene).kind);
    if (!kind.number)
      cursor.fail(entry.place, entry.key,
                  fmt::format("the measure '{}' cannot have a value; give {}", entry.key,
                              !kind.table     ? "a solution"
                              : kind.solution ? "a table or a solution"
                                              : "a table"));
    values[entry.key] = cursor.number(entry.key);
  }
  return values;
}

const Measure& measure_with_table(TomlCursor& cursor, const TomlEntry& entry, const Scene& scene) {
  const Measure& measure = known_measure(cursor, entry, scene);
  if (find_measure_kind(measure.kind)->table) return measure;
  std::vector<std::string> kinds;
  for (const MeasureKind& kind : measure_kinds())
    if (kind.table) kinds.emplace_back(kind.name);
  cursor.fail(
      entry.place, entry.key,
      fmt::format("the measure '{}' cannot have a table; only {} can", entry.key, join_with_or(kinds)));
}

std::vector<std::string> column_names(TomlCursor& entry, const Measure& measure) {
  const std::size_t number = std::max(std::size_t{1}, measure.probes.size());
  if (number == 1) return {entry.text("column")};
  const TomlValue& value = entry.need("columns");
  if (value.kind != TomlValue::Kind::array || value.items.size() != number)
    entry.fail(value, "columns",
               fmt::format("columns must be an array of {} names of columns, one per probe", number));
  std::vector<std::string> names;
  for (const TomlValue& item : value.items) names.push_back(entry.text_of(item, "columns"));
  return names;
}

void check_covers(TomlCursor& entry, const ReferenceTable& table, const SampleLine& line) {
  const TomlValue& file = entry.need("file");
  if (line.times.size() > 1)
    entry.fail(file, "file",
               fmt::format("a table must be of one time, but the line '{}' has {}; "
                           "give a solution, or define one line for each time",
                           line.name, line.times.size()));
  const double length = length_of(line), slack = 1e-9 * length;
  if (table.t.empty() || table.t.front() > slack || table.t.back() < length - slack)
    entry.fail(
        file, "file",
        fmt::format("the table must go from s = 0 to {} m, like the line '{}'", exact(length), line.name));
}

ReferenceTable read_one_table(TomlCursor entry, const Measure& measure, const SceneFile& file) {
  const std::vector<std::string> columns = column_names(entry, measure);
  const std::filesystem::path folder = std::filesystem::absolute(file.path).parent_path();
  const std::filesystem::path path = named_file(entry, folder, "table");
  entry.finish();
  if (measure.line.empty()) return read_table(path, "t", columns);
  ReferenceTable table = read_table(path, "s", columns);
  check_covers(entry, table, *std::ranges::find(file.scene.lines, measure.line, &SampleLine::name));
  return table;
}

std::map<std::string, ReferenceTable> read_tables(TomlCursor& reference, const SceneFile& file) {
  std::map<std::string, ReferenceTable> tables;
  TomlValue* table = reference.find("tables");
  if (!table) return tables;
  TomlCursor cursor = reference.enter(*table, "tables", "'tables' of " + reference.what(), named_by_user);
  for (TomlEntry& entry : cursor.table().entries) {
    const Measure& measure = measure_with_table(cursor, entry, file.scene);
    TomlCursor one =
        cursor.enter(entry.value, entry.key, fmt::format("table '{}'", entry.key), keys_of("tables"));
    tables[entry.key] = read_one_table(std::move(one), measure, file);
  }
  return tables;
}

std::map<std::string, std::vector<Solution>> read_solutions(TomlCursor& reference, const Scene& scene) {
  std::map<std::string, std::vector<Solution>> solutions;
  TomlValue* table = reference.find("solutions");
  if (!table) return solutions;
  TomlCursor cursor =
      reference.enter(*table, "solutions", "'solutions' of " + reference.what(), named_by_user);
  for (const TomlEntry& entry : cursor.table().entries) {
    const Measure& measure = known_measure(cursor, entry, scene);
    const std::size_t number = std::max({std::size_t{1}, measure.probes.size(), measure.fields.size()});
    const bool several = entry.value.kind == TomlValue::Kind::array;
    if (number != (several ? entry.value.items.size() : 1))
      cursor.fail(entry.value, entry.key,
                  number == 1
                      ? fmt::format("the measure '{}' takes one expression, not {}", entry.key,
                                    entry.value.items.size())
                      : fmt::format("the measure '{}' has {} {}; write an array with one expression for each",
                                    entry.key, number, measure.fields.empty() ? "probes" : "fields"));
    const std::span<const TomlValue> items =
        several ? std::span<const TomlValue>(entry.value.items) : std::span(&entry.value, 1);
    const bool in_space = !measure.line.empty() || !measure.fields.empty();
    for (const TomlValue& item : items)
      solutions[entry.key].push_back(in_space ? cursor.solution(item, entry.key)
                                              : cursor.solution_of_time(item, entry.key));
  }
  return solutions;
}

bool is_for(TomlCursor& reference, const std::string& method) {
  const TomlValue* value = reference.find("methods");
  if (!value) return true;
  if (value->kind != TomlValue::Kind::array)
    reference.fail(*value, "methods", "methods must be an array of names of methods");
  bool named = false;
  for (const TomlValue& item : value->items) {
    const std::string name = reference.text_of(item, "methods");
    if (!find_method(name)) reference.fail_unknown(item, "methods", "method", name, names_of(methods()));
    named |= name == method;
  }
  return named;
}

void refuse_second_curve(TomlCursor& cursor, const TomlValue& value, const Reference& reference) {
  for (const auto& entry : reference.solution)
    if (reference.table.contains(entry.first))
      cursor.fail(
          value, "solutions",
          fmt::format("the measure '{}' has a table and a solution; remove one of them", entry.first));
}

/// Values and tables, or solutions, of a [[reference]].
struct Part {
  std::string law;
  bool of_method;
  int specificity;  // 2: given values of all parameters, 1: of those in `when`, 0: any
  const TomlValue* from;
  Reference what;
};

bool counts_before(const Part& a, const Part& b) {
  return std::pair(a.of_method, a.specificity) > std::pair(b.of_method, b.specificity);
}

/// Merges the parts of a law, added by falling rank. For each measure, the first part that has it counts.
class Merged {
 public:
  void add(const Part& part) {
    take(part, part.what.value, merged_.value);
    take(part, part.what.table, merged_.table);
    take(part, part.what.solution, merged_.solution);
  }
  /// Second [[reference]] of equal rank, or null.
  const TomlValue* ambiguous() const { return ambiguous_; }
  const std::string& ambiguous_measure() const { return measure_; }
  Reference finish() {
    merged_.name = join(names_, "; ");
    if (names_.size() > 1)
      for (const auto& [measure, part] : owner_) merged_.names[measure] = part->what.name;
    return std::move(merged_);
  }

 private:
  template <class Map>
  void take(const Part& part, const Map& from, Map& to) {
    for (const auto& [measure, what] : from) {
      const auto [found, is_new] = owner_.emplace(measure, &part);
      const Part* owner = found->second;
      if (is_new && std::ranges::find(names_, part.what.name) == names_.end())
        names_.push_back(part.what.name);
      if (owner->from == part.from) {
        to.emplace(measure, what);
      } else if (!counts_before(*owner, part) && !ambiguous_) {
        ambiguous_ = part.from;
        measure_ = measure;
      }
    }
  }

  Reference merged_;
  std::vector<std::string> names_;
  std::map<std::string, const Part*> owner_;
  const TomlValue* ambiguous_ = nullptr;
  std::string measure_;
};

}  // namespace

void read_references(TomlCursor& root, SceneFile& file) {
  std::vector<Part> parts;
  for (TomlValue& value : root.list("reference")) {
    TomlCursor cursor = root.enter(value, "reference", "a reference", keys_of("reference"));
    const std::string law = read_law(cursor);
    if (file.scene.materials.size() == 1) add_names(cursor.names(), file.scene.materials.front());
    read_names(cursor);
    const Reference all{.name = cursor.line("name"),
                        .value = read_values(cursor, file.scene),
                        .table = read_tables(cursor, file),
                        .solution = read_solutions(cursor, file.scene)};
    refuse_second_curve(cursor, value, all);
    if (all.value.size() + all.table.size() + all.solution.size() == 0)
      cursor.fail(
          value, "reference",
          fmt::format("the reference '{}' is empty; it must have values, tables or solutions", all.name));
    const Validity valid = validity(cursor, file.parameters);
    const bool applies = is_for(cursor, file.settings.method), of_method = cursor.find("methods") != nullptr;
    const int for_some = cursor.find("when") ? 1 : 0;
    cursor.finish();
    const auto unmet = [&](const auto& measures, const std::string& condition) {
      for (const auto& [measure, what] : measures) file.unmet_references.emplace(measure, condition);
    };
    if (!valid.values || !applies) {
      const std::string condition = applies ? "holds for other parameters" : "holds for other methods";
      unmet(all.value, condition), unmet(all.table, condition);
    }
    if (!valid.solutions || !applies)
      unmet(all.solution, applies ? "holds for other parameters" : "holds for other methods");
    if (!applies) continue;
    if (valid.values && all.value.size() + all.table.size() > 0)
      parts.push_back(
          {law, of_method, 2, &value, {.name = all.name, .value = all.value, .table = all.table}});
    if (valid.solutions && !all.solution.empty())
      parts.push_back({law, of_method, for_some, &value, {.name = all.name, .solution = all.solution}});
  }
  std::ranges::stable_sort(parts, counts_before);
  std::map<std::string, Merged> merged;
  for (const Part& part : parts) {
    Merged& of_law = merged[part.law];
    of_law.add(part);
    if (const TomlValue* twin = of_law.ambiguous())
      root.fail(
          *twin, "law",
          fmt::format("two references of the law '{}' are valid for the measure '{}' with these parameters; "
                      "give them different conditions with 'when'",
                      part.law, of_law.ambiguous_measure()));
  }
  for (auto& [law, of_law] : merged) file.scene.references[law] = of_law.finish();
}

}  // namespace taut::cli
