#include "cli/report/report.hpp"

#include <algorithm>
#include <cstdlib>

#include "cli/report/difference_data.hpp"
#include "cli/report/links.hpp"
#include "cli/report/page.hpp"
#include "cli/report/particle_data.hpp"
#include "cli/report/run_data.hpp"
#include "cli/report/suite_data.hpp"
#include "cli/report/sweep_data.hpp"
#include "cli/run/folder.hpp"
#include "cli/study/curve_style.hpp"
#include "cli/study/stored_results.hpp"
#include "cli/sweep/suite_record.hpp"
#include "cli/system/build_info.hpp"
#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

// limit the size of the page
constexpr std::size_t most_rows = 5000, most_rows_in_sweep = 250;

bool is_sweep(const fs::path& path) {
  std::error_code error;
  return path.filename() == "results.csv" || fs::exists(path / "results.csv", error);
}

bool is_run(const fs::path& path) {
  std::error_code error;
  return fs::exists(RunFolder(path).record(), error);
}

PageKind kind_of(const ReportRequest& request) {
  if (request.baseline) {
    if (request.paths.size() > 1)
      throw UsageError("--baseline compares one folder; " + std::to_string(request.paths.size()) +
                       " are given");
    return PageKind::difference;
  }
  if (std::ranges::any_of(request.paths, has_suite_record)) {
    if (request.paths.size() == 1) return PageKind::suite;
    throw UsageError("a page shows one suite of snapshots; " + std::to_string(request.paths.size()) +
                     " folders are given");
  }
  std::size_t sweeps = 0;
  for (const std::string& path : request.paths) {
    if (is_sweep(path))
      ++sweeps;
    else if (!is_run(path))
      throw UsageError("'" + path +
                       "' is neither a run folder nor the folder of a sweep or suite; "
                       "name a folder that `taut run`, `taut sweep` or `taut snapshot` has written");
  }
  if (sweeps == 0) return request.paths.size() == 1 ? PageKind::run : PageKind::runs;
  if (sweeps < request.paths.size())
    throw UsageError("runs and sweeps are given; a page shows either runs or sweeps");
  return PageKind::sweep;
}

fs::path place_of(const ReportRequest& request) {
  if (request.out) return *request.out;
  fs::path folder = request.paths.size() == 1 ? fs::path(request.paths.front()) : fs::path("out");
  if (folder.filename() == "results.csv") folder = folder.parent_path();
  return folder / (request.embed ? "report.html" : "report");
}

class TemporaryPictures {
 public:
  TemporaryPictures() {
    std::string name = (fs::temp_directory_path() / "taut-report-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw OutputError(name, "cannot be created");
    path_ = name;
  }
  ~TemporaryPictures() {
    std::error_code error;
    fs::remove_all(path_, error);
  }
  TemporaryPictures(const TemporaryPictures&) = delete;
  TemporaryPictures& operator=(const TemporaryPictures&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

Json compared_pictures(const ReportRequest& request, PageKind kind, const fs::path& page,
                       const Links& links) {
  const auto data = [&](const fs::path& pictures) {
    if (kind == PageKind::suite) return suite_data(request.paths.front(), pictures, links);
    return difference_data({*request.baseline, request.paths.front(), request.limit}, pictures, links);
  };
  return request.embed ? data(TemporaryPictures().path()) : data(page / "difference");
}

bool is_running(const Json& run) {
  const Json* record = run.find("record");
  const Json* status = record ? record->find("status") : nullptr;
  return status && status->is_text() && status->text() == "running";
}

std::string method_of(const Json& run) {
  const Json* method = run.find("record")->find("method");
  return method && method->is_text() ? method->text() : "";
}

void add_runs(PageData& data, const ReportRequest& request, const Links& links) {
  std::vector<std::string> methods;
  for (const std::string& path : request.paths) {
    data.runs.push_back(run_data(path, links, most_rows));
    methods.push_back(method_of(data.runs.back()));
    data.particles.push_back(particle_data(path).value_or(Json()));
  }
  const std::vector<CurveStyle> styles = line_styles(methods);
  for (std::size_t k = 0; k < styles.size(); ++k) data.runs[k]["style"] = to_json(styles[k]);
}

void add_sweep(PageData& data, const ReportRequest& request, const Links& links) {
  const StoredResults results = read_results(request.paths);
  data.report = data.report.with({{"title", results.title}}).with(sweep_data(results, links));
  for (const StoredRun& run : results.runs)
    data.runs.push_back(has_run_folder(run) ? run_data(run.folder(), links, most_rows_in_sweep) : Json());
}

/// Script names; null without data or if embedded.
Json scripts_of(const std::vector<Json>& runs, std::string (*name)(std::size_t), const Links& links) {
  Json scripts = Json::array();
  for (std::size_t k = 0; k < runs.size(); ++k)
    scripts.add(runs[k].is_null() || links.embeds() ? Json() : Json(name(k)));
  return scripts;
}

}  // namespace

std::string_view name(PageKind kind) {
  switch (kind) {
    case PageKind::run:
      return "run";
    case PageKind::runs:
      return "runs";
    case PageKind::sweep:
      return "sweep";
    case PageKind::difference:
      return "difference";
    case PageKind::suite:
      return "suite";
  }
  return "";
}

WrittenPage write_report(const ReportRequest& request) {
  const PageKind kind = kind_of(request);
  const fs::path place = place_of(request);
  check_page(place);
  const Links links(request.embed ? fs::absolute(place).parent_path() : place, request.embed);
  PageData data{.report = {{"taut", build_info.version}, {"kind", name(kind)}}, .runs = {}, .particles = {}};
  if (kind == PageKind::difference || kind == PageKind::suite)
    data.report = data.report.with(compared_pictures(request, kind, place, links));
  else if (kind == PageKind::sweep)
    add_sweep(data, request, links);
  else
    add_runs(data, request, links);
  const bool running = std::ranges::any_of(data.runs, is_running);
  data.report["running"] = running && !request.embed;
  data.report["scripts"] = scripts_of(data.runs, run_script_name, links);
  data.report["particle_scripts"] = scripts_of(data.particles, particle_script_name, links);
  if (request.embed)
    write_embedded_page(place, data);
  else
    write_page(place, data);
  return {kind, request.embed ? place : place / "index.html", data.runs.size(), running};
}

}  // namespace taut::cli
