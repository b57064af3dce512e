#include "cli/report/run_data.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "cli/drawing/frames.hpp"
#include "cli/run/folder.hpp"
#include "cli/run/frame_folders.hpp"
#include "cli/run/history.hpp"
#include "cli/run/record.hpp"
#include "cli/run/schedule.hpp"
#include "cli/scene/scene_file.hpp"
#include "cli/study/csv.hpp"
#include "cli/study/reference_curves.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

Json numbers(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.add(value);
  return list;
}

/// Times in s, or null if unknown.
Json frames_data(const RunFolder& folder, const std::optional<SceneFile>& scene, const Links& links) {
  const std::vector<double> times =
      scene ? times_in_parts(scene->scene.until, scene->drawing.frames) : std::vector<double>();
  Json frames = Json::array();
  for (const std::string& name : picture_names(folder.frames())) {
    if (!is_frame(name)) continue;
    const auto number = parsed<std::size_t>(name.substr(6, name.size() - 10));  // frame_00012.png
    const bool timed = number && *number < times.size();
    frames.add(
        {{"src", links.to_picture(folder.frames() / name)}, {"t", timed ? Json(times[*number]) : Json()}});
  }
  return frames;
}

Json history_data(const CsvTable& table, const std::optional<SceneFile>& scene, std::size_t most_rows) {
  const std::size_t every = (table.rows.size() + most_rows - 1) / most_rows;
  Json columns = Json::array();
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    Json values = Json::array();
    for (std::size_t r = 0; r < table.rows.size(); ++r)
      if (r % every == 0 || r + 1 == table.rows.size()) {
        const auto value = parsed<double>(table.rows[r][c]);
        values.add(value ? Json(*value) : Json());
      }
    columns.add({{"name", table.columns[c]},
                 {"unit", scene ? history_unit(table.columns[c], scene->scene) : ""},
                 {"values", values}});
  }
  return {{"every", std::max<std::size_t>(every, 1)}, {"columns", columns}};
}

Json to_json(const std::vector<ReferenceCurve>& references) {
  Json curves = Json::array();
  for (const ReferenceCurve& curve : references)
    curves.add({{"column", curve.column},
                {"name", curve.name},
                {"t", numbers(curve.t)},
                {"values", numbers(curve.values)}});
  return curves;
}

}  // namespace

Json to_json(const CurveStyle& style) {
  return {{"color", style.color}, {"dash", style.dash}, {"marker", style.filled}};
}

Json run_data(const fs::path& path, const Links& links, std::size_t most_rows) {
  const RunFolder folder(path);
  const auto record = checked_record(folder.record());
  if (!record) throw UsageError("'" + path.string() + "' contains no run.json; name a run folder");
  Json data{{"folder", path.string()}, {"link", links.to(path)}, {"record", record->all}};
  std::optional<SceneFile> scene;
  std::string problem;
  try {
    scene = read_scene(folder.scene());
  } catch (const std::exception& error) {  // the rest can still be shown
    problem = "scene.toml: " + std::string(error.what());
  }
  data["title"] = scene ? scene->scene.title : "";
  data["source"] = scene ? scene->scene.source : "";
  data["scene"] = scene ? scene->text : "";
  data["frames"] = frames_data(folder, scene, links);
  std::error_code error;
  if (fs::exists(folder.history(), error))
    data["history"] = history_data(read_csv(folder.history()), scene, most_rows);
  const Json* law = record->all.find("material_law");
  data["references"] = scene && law && law->is_text()
                           ? to_json(reference_curves(scene->scene, law->text(),
                                                      times_in_parts(scene->scene.until, solution_samples)))
                           : Json::array();
  data["problem"] = problem;
  return data;
}

}  // namespace taut::cli
