#include <algorithm>
#include <ostream>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/language/reference.hpp"
#include "cli/scene/scene_file.hpp"
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

/// `rows` returns objects with equal keys, the name first.
struct Listing {
  std::string_view kind;
  Json (*rows)();
  std::string_view help;
};

/// An unreadable scene file does not hide the others.
Json scene_row(const std::string& name) try {
  const Scene scene = read_scene(find_scene(name)).scene;
  return {{"name", name}, {"title", scene.title}, {"source", scene.source}};
} catch (const std::runtime_error& error) {
  return {{"name", name}, {"title", "cannot be read: " + std::string(error.what())}, {"source", ""}};
}

Json scene_rows() {
  Json rows = Json::array();
  for (const std::string& name : scene_names()) rows.add(scene_row(name));
  return rows;
}

Json as_objects(const Rows& rows) {
  Json objects = Json::array();
  for (std::size_t r = 1; r < rows.size(); ++r) {
    Json object;
    for (std::size_t k = 0; k < rows[r].size(); ++k) object[rows.front()[k]] = rows[r][k];
    objects.add(std::move(object));
  }
  return objects;
}

template <Rows (*rows)()>
Json of_language() {
  return as_objects(rows());
}

Json equation_rows() {
  Json rows = Json::array();
  for (const MethodInfo& m : methods()) {
    for (const TermInfo& t : m.terms) {
      const Json row = {{"name", t.what}, {"source", t.source}, {"function", t.function}, {"test", t.test}};
      if (std::ranges::find(rows.items(), row) == rows.items().end()) rows.add(row);
    }
  }
  return rows;
}

constexpr Listing listings[] = {
    {"scenes", scene_rows, "scenes, shipped or in TAUT_SCENES"},
    {"methods", of_language<method_rows>, "SPH formulations, and finite elements"},
    {"equations", equation_rows, "equations of all methods, with function and test"},
    {"laws", of_language<law_rows>, "laws of elasticity"},
    {"contacts", of_language<contact_rows>, "contact laws"},
    {"shapes", of_language<shape_rows>, "shapes of bodies"},
    {"probes", of_language<probe_rows>, "quantities that history.csv records"},
    {"measures", of_language<measure_rows>, "numbers that can be compared with references"},
    {"fields", of_language<field_rows>, "quantities that colour the particles"},
    {"colormaps", of_language<colormap_rows>, "colour maps"},
    {"keys", of_language<key_rows>, "keys of scene, sweep, claim and suite files"}};

std::string as_text(const Json& rows, std::optional<std::size_t> columns) {
  std::vector<std::vector<std::string>> cells;
  for (const Json& row : rows.items()) {
    cells.emplace_back();
    for (const auto& [key, value] : row.members()) cells.back().push_back(value.text());
  }
  return in_columns(cells, 2, columns);
}

std::vector<std::string> kinds() {
  std::vector<std::string> names;
  for (const Listing& l : listings) names.emplace_back(l.kind);
  names.emplace_back("all");
  return names;
}

const Listing& find_listing(const std::string& kind) {
  const auto* found = std::ranges::find(listings, kind, &Listing::kind);
  if (found != std::end(listings)) return *found;
  throw UsageError(unknown_name("kind", kind, kinds()));
}

int list_kinds(std::ostream& out) {
  std::vector<std::vector<std::string>> rows;
  for (const Listing& l : listings) {
    const std::string kind(l.kind);
    rows.push_back({kind, std::to_string(l.rows().items().size()), "taut list " + kind, std::string(l.help)});
  }
  out << in_columns(rows, 2, text_columns(out)) << '\n'
      << "taut list all prints everything; taut describe NAME explains a name.\n";
  return exit_fine;
}

int list_all(bool json, std::ostream& out) {
  Json all;
  for (const Listing& l : listings) {
    const Json rows = l.rows();
    if (json)
      all[std::string(l.kind)] = rows;
    else
      out << l.kind << '\n' << as_text(rows, text_columns(out)) << '\n';
  }
  if (json) out << all.dump(2) << '\n';
  return exit_fine;
}

int list_one(const std::string& kind, bool json, std::ostream& out) {
  const Json rows = find_listing(kind).rows();
  out << (json ? rows.dump(2) + "\n" : as_text(rows, text_columns(out)));
  return exit_fine;
}

int list(const std::string& kind, bool json, std::ostream& out) {
  if (kind.empty() && !json) return list_kinds(out);
  if (kind.empty() || kind == "all") return list_all(json, out);
  return list_one(kind, json, out);
}

}  // namespace

std::function<int(Streams)> declare_list(Options& command) {
  struct ListArguments {
    std::string kind;
    bool json = false;
  };
  auto options = std::make_shared<ListArguments>();
  command.add_argument(join(kinds(), "|"), options->kind,
                       "the kind to list; default: the kinds with their counts");
  command.add_flag("--json", options->json, "print JSON, for scripts; without a kind: everything");
  return [options](Streams streams) { return list(options->kind, options->json, streams.out); };
}

}  // namespace taut::cli
