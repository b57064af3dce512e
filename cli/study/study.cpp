#include "cli/study/study.hpp"

#include <algorithm>
#include <ostream>
#include <tuple>

#include <fmt/core.h>

#include "cli/study/chart_drawing.hpp"
#include "cli/study/chart_tables.hpp"
#include "cli/study/curve_style.hpp"
#include "cli/study/map_drawing.hpp"
#include "cli/study/study_tables.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

std::vector<std::pair<std::string, FilePlace>> texts(TomlCursor& section, std::string_view key) {
  const TomlValue* value = section.find(key);
  std::vector<std::pair<std::string, FilePlace>> all;
  if (!value) return all;
  if (value->kind != TomlValue::Kind::array) return {{section.text_of(*value, key), value->place}};
  for (const TomlValue& item : value->items) all.emplace_back(section.text_of(item, key), item.place);
  if (all.empty()) section.fail(*value, key, std::string(key) + " is an empty list");
  return all;
}

void read_charts(TomlCursor& section, FilePlace begins, StudyPictures& pictures) {
  const auto measures = texts(section, "measure");
  const Cost cost = section.find("cost") ? find_cost(section.choice("cost")) : ChartRequest{}.cost;
  ChartRequest request{.measure = "", .cost = cost};
  for (const auto& [method, place] : texts(section, "methods")) {
    request.methods.push_back(method);
    pictures.methods.push_back({method, place});
  }
  request.against = section.text("against", "");
  if (!request.against.empty()) pictures.methods.push_back({request.against, section.need("against").place});
  section.finish();
  std::vector<StudyPictures::Charted>& charts = pictures.charts;
  charts = {{request, begins}};
  if (!measures.empty()) charts.assign(measures.size(), {request, {}});
  for (std::size_t k = 0; k < measures.size(); ++k)
    std::tie(charts[k].request.measure, charts[k].place) = measures[k];
}

void check_name(const std::filesystem::path& file, std::string_view kind, const std::string& name,
                FilePlace place, const std::set<std::string>& known) {
  if (name.empty() || known.contains(name)) return;
  throw SceneError(file.string(), place.line, place.column, name,
                   unknown_name(kind, name, {known.begin(), known.end()}));
}

/// Requires a swept parameter, by name if there are several.
void check_map(const StudyPictures::Mapped& map, const std::filesystem::path& file, AvailableData available) {
  const std::string& wanted = map.request.parameter;
  for (auto* names : {&available.swept, &available.varied}) std::erase(*names, "method");
  check_name(file, "swept parameter", wanted, map.place, {available.swept.begin(), available.swept.end()});
  if (!wanted.empty()) return;
  const std::vector<std::string>& all = available.varied.empty() ? available.swept : available.varied;
  if (all.size() != 1)
    throw SceneError(
        file.string(), map.place.line, map.place.column, "map",
        all.empty()
            ? "only the method is swept: there is no parameter to map"
            : fmt::format(R"(several parameters are swept ({}); name one of them, such as parameter = "{}")",
                          join(all), all.front()));
}

void check_chart(const StudyPictures::Charted& chart, const std::filesystem::path& file,
                 const AvailableData& available) {
  const auto& [request, place] = chart;
  const auto fail = [&](const std::string& why) {
    throw SceneError(file.string(), place.line, place.column,
                     request.measure.empty() ? "chart" : request.measure, why);
  };
  check_name(file, "measure", request.measure, place, available.measures);
  if (!request.against.empty() && available.differences.contains(request.measure))
    fail(fmt::format("'{}' is itself a difference from a reference of the scene; chart it without `against`",
                     request.measure));
  if (!request.against.empty()) return;
  const std::string way_out =
      " with these parameters and methods, so no run has an error; "
      "against = METHOD compares with the finest stable run of a method";
  if (request.measure.empty() && available.referenced.empty()) fail("no measure has a reference" + way_out);
  if (!request.measure.empty() && !available.referenced.contains(request.measure))
    fail(fmt::format("'{}' has no reference{}", request.measure, way_out));
}

void print_files(const char* kind, const PlotFiles& files, const std::string& remark, Streams streams) {
  streams.out << '\n'
              << kind << "  " << files.picture.string() << remark << ", "
              << files.script().filename().string() << ", " << files.data().filename().string() << '\n';
}

}  // namespace

StudyPictures read_pictures(TomlCursor& root) {
  StudyPictures pictures;
  if (TomlValue* chart = root.find("chart")) {
    TomlCursor section = root.enter(*chart, "chart", "[chart]", keys_of("chart"));
    read_charts(section, chart->place, pictures);
  }
  if (TomlValue* map = root.find("map")) {
    TomlCursor section = root.enter(*map, "map", "[map]", keys_of("map"));
    const TomlValue* parameter = section.find("parameter");
    pictures.map = {{section.text("parameter", "")}, parameter ? parameter->place : map->place};
    section.finish();
  }
  if (TomlValue* history = root.find("history")) {
    TomlCursor section = root.enter(*history, "history", "[history]", keys_of("history"));
    for (const TomlEntry& entry : history->entries)
      pictures.history.push_back({entry.key, section.text_of(entry.value, entry.key), entry.place});
    if (pictures.history.empty())
      root.fail(*history, "history", "[history] is empty; it needs a line COLUMN = \"label, unit\"");
  }
  return pictures;
}

void check_pictures(const StudyPictures& pictures, const std::filesystem::path& file,
                    const AvailableData& available) {
  for (const StudyPictures::Charted& chart : pictures.charts) check_chart(chart, file, available);
  for (const StudyPictures::Named& method : pictures.methods)
    check_name(file, "method", method.name, method.place, available.methods);
  if (pictures.map) check_map(*pictures.map, file, available);
  for (const HistoryColumn& column : pictures.history)
    check_name(file, "history column", column.name, column.place, available.columns);
}

int draw_pictures(const StudyPictures& pictures, const std::filesystem::path& folder, Streams streams) {
  const std::vector<std::string> results{(folder / "results.csv").string()};
  int code = exit_fine;
  for (const StudyPictures::Charted& chart : pictures.charts) {
    const std::string& measure = chart.request.measure;
    const std::string name = measure.empty() ? "chart.png" : fmt::format("chart-{}.png", measure);
    streams.out << '\n';
    if (code == exit_fine) try {
        code = draw_chart(results, chart.request, {folder / name}, streams);
      } catch (const NoErrors& error) {
        streams.err << "taut: " << name << " is not drawn: " << error.what() << '\n';
      }
  }
  if (pictures.map && code == exit_fine) {
    streams.out << '\n';
    code = draw_map(results, pictures.map->request, {folder / "map.png"}, streams);
  }
  if (!pictures.history.empty() && code == exit_fine) {
    StoredResults ended = read_results(results);
    std::erase_if(ended.runs, [](const StoredRun& run) { return !run.has_result(); });
    code = draw_history(make_history_plot(ended, pictures.history), {folder / "history.png"}, streams);
  }
  if (code == exit_fine && (!pictures.charts.empty() || pictures.map || !pictures.history.empty())) {
    const std::filesystem::path tables = folder / "tables.md";
    write_atomically(tables, study_tables(pictures, results));
    streams.out << "\ntables  " << tables.string() << '\n';
  }
  return code;
}

Chart read_chart(const std::vector<std::string>& results, const ChartRequest& request, std::ostream& err) {
  Chart chart = make_chart(read_results(results), request);
  if (chart.without_result > 0)
    err << "taut: runs without a result, which are not on the chart: " << chart.without_result << '\n';
  if (chart.lacks_cpu)
    err << "taut: some runs were stored without CPU seconds, so the cost is the wall time; "
           "repeat the sweep for --cost cpu\n";
  if (is_time(chart.cost) && chart.machines.size() > 1)
    err << "taut: the runs come from several machines or numbers of threads, so their seconds are not comparable; "
           "use --cost steps\n";
  return chart;
}

int draw_chart(const std::vector<std::string>& results, const ChartRequest& request, const PlotFiles& files,
               Streams streams) {
  const Chart chart = read_chart(results, request, streams.err);
  streams.out << orders_table(chart);
  const int code = draw_plot(files, chart_script(chart, files), chart_data(chart));
  print_files("chart", files, fmt::format(" ({})", chart.measure), streams);
  return code;
}

int draw_history(const HistoryPlot& plot, const PlotFiles& files, Streams streams, const PlotLook& look) {
  if (plot.curves.size() > most_distinct_lines)
    streams.err << "taut: " << files.picture.string() << " has " << plot.curves.size() << " lines; only "
                << most_distinct_lines << " can be told apart; their numbers are in "
                << files.data().filename().string() << '\n';
  const std::string hidden = hidden_by_log(plot, look);
  if (!hidden.empty()) streams.err << "taut: " << hidden << '\n';
  const int code = draw_plot(files, history_script(plot, files, look), history_data(plot));
  print_files(plot.kind, files, "", streams);
  return code;
}

int draw_response(const ResponsePlot& plot, const PlotFiles& files, Streams streams, const PlotLook& look) {
  if (plot.without_value > 0)
    streams.err << "taut: runs without a number, whose points are missing: " << plot.without_value << '\n';
  const int code = draw_plot(files, response_script(plot, files, look), response_data(plot));
  print_files("plot", files, "", streams);
  return code;
}

int draw_map(const std::vector<std::string>& results, const MapRequest& request, const PlotFiles& files,
             Streams streams) {
  const StabilityMap map = make_map(read_results(results), request);
  streams.out << map_table(map);
  const int code = draw_plot(files, map_script(map, files), map_data(map));
  print_files("map", files, "", streams);
  return code;
}

}  // namespace taut::cli
