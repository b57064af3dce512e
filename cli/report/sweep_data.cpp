#include "cli/report/sweep_data.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "cli/report/run_data.hpp"
#include "cli/run/folder.hpp"
#include "cli/study/curve_style.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

std::vector<std::string> columns_of(const StoredResults& results) {
  std::vector<std::string> columns;
  std::set<std::string> seen;
  for (const StoredRun& run : results.runs)
    for (const auto& [column, value] : run.cells)
      if (seen.insert(column).second) columns.push_back(column);
  return columns;
}

Json rows_of(const StoredResults& results, const std::vector<std::string>& columns) {
  Json rows = Json::array();
  for (const StoredRun& run : results.runs) {
    const std::map<std::string, std::string> cells(run.cells.begin(), run.cells.end());
    Json row = Json::array();
    for (const std::string& column : columns) {
      const auto cell = cells.find(column);
      if (column == "method")  // also of a run without a result
        row.add(run.method());
      else
        row.add(cell == cells.end() ? Json() : number_or_text(cell->second));
    }
    rows.add(std::move(row));
  }
  return rows;
}

Json swept_names(const StoredResults& results, const std::vector<std::string>& columns) {
  Json swept = Json::array();
  for (const std::string& column : columns) {
    if (!column.starts_with(set_prefix)) continue;
    const std::string name = column.substr(set_prefix.size());
    swept.add({{"name", name}, {"label", results.label(name)}});
  }
  return swept;
}

Json styles_of_methods(const StoredResults& results) {
  std::vector<std::string> methods;
  for (const StoredRun& run : results.runs)
    if (std::ranges::find(methods, run.method()) == methods.end()) methods.push_back(run.method());
  const std::vector<CurveStyle> styles = curve_styles(methods);
  Json of_methods = Json::object();
  for (std::size_t k = 0; k < methods.size(); ++k) of_methods[methods[k]] = to_json(styles[k]);
  return of_methods;
}

Json pictures_of(const StoredResults& results, const Links& links) {
  std::set<fs::path> files;
  std::error_code error;
  for (const StoredRun& run : results.runs)
    for (const auto& entry : fs::directory_iterator(fs::path(run.file).parent_path(), error))
      if (entry.path().extension() == ".png") files.insert(entry.path());
  Json pictures = Json::array();
  for (const fs::path& file : files)
    pictures.add({{"name", file.stem().string()}, {"src", links.to_picture(file)}});
  return pictures;
}

}  // namespace

bool has_run_folder(const StoredRun& run) {
  std::error_code error;
  return fs::exists(RunFolder(run.folder()).record(), error);
}

Json sweep_data(const StoredResults& results, const Links& links) {
  const std::vector<std::string> columns = columns_of(results);
  Json fixed = Json::object();
  for (const auto& [name, value] : results.fixed) fixed[name] = number_or_text(value);
  return {{"scene", results.scene},
          {"fixed", fixed},
          {"swept", swept_names(results, columns)},
          {"measures", Json(results.measures())},
          {"styles", styles_of_methods(results)},
          {"columns", Json(columns)},
          {"rows", rows_of(results, columns)},
          {"pictures", pictures_of(results, links)}};
}

}  // namespace taut::cli
