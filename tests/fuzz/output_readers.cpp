#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "cli/formats/mask.hpp"
#include "cli/formats/particle_file.hpp"
#include "cli/run/panel_cells.hpp"
#include "cli/run/record.hpp"
#include "cli/run/run.hpp"
#include "cli/run/saved_run.hpp"
#include "cli/scene/sections.hpp"
#include "cli/study/chart.hpp"
#include "cli/study/chart_drawing.hpp"
#include "cli/study/chart_tables.hpp"
#include "cli/study/choose.hpp"
#include "cli/study/expectation.hpp"
#include "cli/study/history_plot.hpp"
#include "cli/study/map_drawing.hpp"
#include "cli/study/stability_map.hpp"
#include "cli/study/stored_results.hpp"
#include "cli/sweep/options.hpp"
#include "cli/sweep/results.hpp"
#include "render/image/image_difference.hpp"
#include "render/image/png.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/fuzz/readers.hpp"
#include "tests/fuzz/small_scenes.hpp"

namespace taut::fuzz {

using namespace cli;

namespace {

void draw_charts(const StoredResults& results) {
  const PlotFiles files = plot_files("chart.png");
  const std::string method = results.runs.front().method();
  for (const std::string& name : cost_names())
    for (const std::string& against : {std::string(), method})
      attempt([&] {
        const Chart chart = make_chart(results, {.measure = "", .cost = find_cost(name), .against = against});
        chart_data(chart);
        orders_table(chart);
        markdown(chart);
        markdown_of_prices(chart);
        chart_json(chart);
        for (const double error : {1e-3, 0.1}) advice(chart, {.error = error, .seconds = 1});
        price_list(chart, std::nullopt);
        chart_script(chart, files);
      });
}

void draw_maps(const StoredResults& results) {
  for (const char* parameter : {"", "spacing", "v0"})
    attempt([&] {
      const StabilityMap map = make_map(results, {parameter});
      map_table(map);
      map_data(map);
      map_script(map, plot_files("map.svg"));
    });
}

void draw_histories(const StoredResults& results) {
  attempt([&] {
    const HistoryPlot plot = make_history_plot(results, {{"tip", "tip, m"}, {"total_energy", ""}});
    history_data(plot);
    history_script(plot, plot_files("history.png"));
  });
}

void look_at(const StoredResults& results) {
  draw_charts(results);
  draw_maps(results);
  draw_histories(results);
  StoredResults of_one = results;
  keep_methods(of_one, {results.runs.front().method()});
}

/// A sweep whose run folders contain `record`.
SweepPlan sweep_with(const std::string& record) {
  SweepOptions options;
  options.what = write("small.toml", small_scenes.front().text).string();
  options.grid = {"speed=1,2"};
  options.run.out = (folder() / "sweep").string();
  SweepPlan plan = plan_sweep(make_request(options));
  for (SweepRun& run : plan.runs) {
    write("sweep/" + run.folder + "/run.json", record);
    write("sweep/" + run.folder + "/scene.toml", run.scene);
    run.read_folder();
  }
  return plan;
}

}  // namespace

void read_particle_file(std::string_view bytes) {
  const std::filesystem::path path = write("particles.vtp", bytes);
  const ParticleFile file(path);
  std::vector<std::string> names = file.fields();
  names.emplace_back("pressure");
  for (const std::string& name : names)
    attempt([&] { expect(file.field(name).size() == file.size(), "a field has the wrong length"); });
  attempt([&] { expect(file.diameter().size() == file.size(), "the number of diameters is wrong"); });
  for (const int dim : {2, 3})
    attempt([&] {
      expect(file.positions(dim).size() == file.size() * static_cast<std::size_t>(dim),
             "the number of positions is wrong");
    });
  const std::filesystem::path scene =
      write("scene.toml",
            "spacing = 0.25\nuntil = 1\nmethod = 'tl'\n[material.m]\ndensity = 1\nyoungs_modulus = 1\n"
            "poisson_ratio = 0.3\n[[body]]\nname = 'b'\nmaterial = 'm'\n"
            "shape = { type = 'particles', file = 'particles.vtp' }\n");
  attempt([&] {
    SceneFile body = read_scene(scene);
    body.settings.threads = 1;
    if (is_small(body.scene)) start(body);
  });
}

void read_picture(std::string_view bytes) {
  const std::filesystem::path path = write("picture.png", bytes);
  attempt([&] {
    const Mask mask = read_mask(path, MaskOf::alpha);
    faces_of(cropped(mask), 0.5);
  });
  attempt([&] { faces_of(read_mask(path, MaskOf::darkness), 0.3); });
  render::read_png(path, render::Alpha::kept);
  const render::Image picture = render::read_png(path);
  constexpr int most = 512;  // pixels per side
  if (picture.width > most || picture.height > most) return;
  render::write_png(picture, folder() / "again.png");
  expect(render::read_png(folder() / "again.png") == picture,
         "a picture changes when written and read again");
  expect(alike(render::compare(picture, picture)), "a picture differs from itself");
  render::difference_picture(picture, picture);
}

void read_results_files(std::string_view bytes) {
  const std::vector<std::string> parts = parts_of(bytes, 3);
  write("results.csv", parts[0]);
  write("results.json", parts[1]);
  write("r/history.csv", parts[2]);
  look_at(read_results({folder().string()}));
}

void read_records(std::string_view bytes) {
  const std::vector<std::string> parts = parts_of(bytes, 2);
  const std::string record = write("r/run.json", parts[0]).string();
  const std::string baseline = write("baseline.json", parts[1]).string();
  read_record(record);
  attempt([&] {
    const StoredRun run = read_stored_run("r");
    std::vector<cli::Finding> findings{check_end(run), check_verdict(run, "hourglass")};
    for (const Expectation& expected : expectations_of(read_stored_run(baseline), Tolerance{0.1, true}))
      findings.push_back(check_expectation(run, expected));
    findings_table(findings);
  });
  attempt([&] {
    SweepPlan plan = sweep_with(parts[0]);
    for (const SweepRun& run : plan.runs) outcome(run);
    results_table(plan);
    write_results(plan);
    look_at(read_results({plan.folder.string()}));
  });
}

void read_tables(std::string_view bytes) {
  const std::filesystem::path path = write("table.csv", bytes);
  attempt([&] {
    const ColumnTable table = read_columns(path, {"x", "y"}, {"volume"});
    for (std::size_t k = 0; k < 2; ++k)
      expect(table.columns[k].size() == table.rows(), "columns of different lengths");
  });
  attempt([&] {
    const ReferenceTable table = read_table(path, "t", {"x"});
    expect(table.value.front().size() == table.t.size(), "columns of different lengths");
  });
}

}  // namespace taut::fuzz
