#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <sstream>
#include <string_view>

#include <fmt/core.h>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/drawing/bounds.hpp"
#include "cli/drawing/frames.hpp"
#include "cli/drawing/options.hpp"
#include "cli/drawing/page_keys.hpp"
#include "cli/drawing/staging.hpp"
#include "cli/run/labels.hpp"
#include "cli/run/panel_cells.hpp"
#include "cli/run/saved_run.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/text/checks.hpp"
#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"
#include "render/image/png.hpp"
#include "render/panel.hpp"

namespace taut::cli {
namespace {

constexpr int default_rows = 4;

struct CompareArguments : DrawingOptions {
  std::vector<std::string> runs;
  std::string out;
  std::vector<double> times;  // s
  std::vector<std::string> labels;
  std::vector<std::string> beside;  // "color=pressure; range=0:1e6"
  bool times_across = false;
};

struct Column {
  Staging staging;
  std::vector<PanelCell> cells;
};

/// One column per run.
struct Block {
  Drawing drawing;
  bool bounded = false;  // limited to the view of the scenes
  std::vector<Column> columns{};
};

std::vector<SavedRun> open_runs(const std::vector<std::string>& folders) {
  std::vector<SavedRun> runs;
  for (const std::string& folder : folders) runs.push_back(open_saved_run(folder));
  for (const SavedRun& run : runs)
    if (run.file.scene.dim != runs.front().file.scene.dim)
      throw UsageError(
          fmt::format("the runs {} and {} differ in dim; compare runs with the same number of dimensions",
                      folders.front(), run.folder.path().string()));
  return runs;
}

double longest(const std::vector<SavedRun>& runs) {
  double until = 0;
  for (const SavedRun& run : runs) until = std::max(until, run.file.scene.until);
  return until;
}

std::vector<double> chosen_times(const CompareArguments& options, double until) {
  std::vector<double> times = options.times;
  if (times.empty())
    for (int k = 1; k <= default_rows; ++k) times.push_back(until * k / default_rows);
  for (const double time : times)
    if (time > until)
      throw UsageError(
          fmt::format("--times contains {} s; times must be at most {} s, the end of the longest run",
                      brief(time), brief(until)));
  return times;
}

std::optional<render::View> common_view(const std::vector<SavedRun>& runs) {
  const auto& view = runs.front().file.drawing.look.view;
  for (const SavedRun& run : runs)
    if (run.file.drawing.look.view != view) return std::nullopt;
  return view;
}

/// Particles that fly away must not widen the view.
render::View within(const render::View& all, const std::optional<render::View>& window) {
  if (!window) return all;
  return {std::max(all.x_min, window->x_min), std::min(all.x_max, window->x_max),
          std::max(all.y_min, window->y_min), std::min(all.y_max, window->y_max)};
}

Drawing chosen_drawing(const std::vector<SavedRun>& runs, const CompareArguments& options) {
  Drawing drawing = runs.front().file.drawing;
  drawing.look.size.reset();
  drawing.look.view.reset();
  drawing = with_options(drawing, options);
  apply_scene(drawing, runs.front().file);
  return drawing;
}

void check_followed_body(const Drawing& drawing, const std::vector<SavedRun>& runs, std::string_view advice) {
  for (const SavedRun& run : runs) {
    std::vector<std::string> names;
    for (const Body& body : run.file.scene.bodies) names.push_back(body.name);
    if (drawing.followed && std::ranges::find(names, drawing.follow) == names.end())
      throw UsageError(fmt::format("the picture follows body '{}', but '{}' has only the bodies {}; {}",
                                   drawing.follow, run.folder.path().string(), join(names), advice));
  }
}

bool is_bounded(const Drawing& drawing, bool has_chosen_view) {
  return !has_chosen_view && !drawing.look.view && !drawing.look.camera && !drawing.followed;
}

struct Change {
  const DrawingKey* key;
  std::string value;
};

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// `color` comes first because it resets range and map.
std::vector<Change> changes_in(const std::string& beside) {
  std::vector<Change> changes;
  std::istringstream parts(beside);
  for (std::string part; std::getline(parts, part, ';');) {
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos)
      throw UsageError(
          fmt::format("--beside contains '{}'; it must be KEY=VALUE, such as color=pressure", trimmed(part)));
    const std::string name = trimmed(part.substr(0, equals));
    if (std::ranges::find(keys_beside, name) == keys_beside.end())
      throw UsageError("--beside: " +
                       unknown_name("drawing option", name, {keys_beside.begin(), keys_beside.end()}));
    changes.push_back({&drawing_key(name), trimmed(part.substr(equals + 1))});
  }
  std::ranges::stable_partition(changes, [](const Change& change) { return change.key->name == "color"; });
  return changes;
}

std::vector<Block> make_blocks(const Drawing& first, const CompareArguments& options, const SceneFile& file) {
  const bool chosen = options.contains("view");
  std::vector<Block> blocks{{first, is_bounded(first, chosen)}};
  for (const std::string& beside : options.beside) {
    Block block{first};
    const std::vector<Change> changes = changes_in(beside);
    for (const Change& change : changes) set_typed(block.drawing, *change.key, change.value);
    apply_scene(block.drawing, file);
    block.bounded =
        is_bounded(block.drawing, chosen || std::ranges::any_of(changes, [](const Change& change) {
                                    return change.key->name == "view";
                                  }));
    blocks.push_back(std::move(block));
  }
  return blocks;
}

Drawing fitted_to(const Drawing& drawing, bool bounded, const std::vector<SavedRun>& runs,
                  const std::vector<Column>& columns) {
  SequenceBounds shown(drawing.look.camera);
  for (const auto& [staging, cells] : columns)
    for (const PanelCell& cell : cells)
      if (cell.particles) staging.extend(shown, staging(cell.particles->view()));
  Drawing result = fitted(drawing, shown);
  if (bounded) result.look.view = within(*result.look.view, common_view(runs));
  return result;
}

/// Updates the greatest share of each run's shown particles outside `view`.
void add_shares_outside(std::vector<double>& most, const render::View& view,
                        const std::vector<Column>& columns) {
  for (std::size_t k = 0; k < columns.size(); ++k) {
    for (const PanelCell& cell : columns[k].cells) {
      if (!cell.particles) continue;
      const std::vector<double> x = columns[k].staging(cell.particles->view()).x;
      double outside = 0;
      for (std::size_t i = 0; i < x.size(); i += 2)
        outside += x[i] < view.x_min || x[i] > view.x_max || x[i + 1] < view.y_min || x[i + 1] > view.y_max;
      most[k] = std::max(most[k], 2 * outside / static_cast<double>(x.size()));
    }
  }
}

void warn_about_particles_outside(const std::vector<SavedRun>& runs, const std::vector<double>& most,
                                  std::ostream& err) {
  constexpr double worth_a_warning = 0.02;  // share of particles
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (most[k] > worth_a_warning)
      err << "taut: up to " << percent(most[k]) << " of the particles of " << runs[k].folder.path().string()
          << " are outside the view of the scene; use --view auto to show them\n";
}

void draw(render::Panel& panel, const std::vector<Column>& columns, int first_column, bool times_across) {
  for (int run = 0; const auto& [staging, cells] : columns) {
    for (int time = 0; const PanelCell& cell : cells) {
      const int column = first_column + (times_across ? time : run), row = times_across ? run : time;
      if (cell.particles) panel.draw(column, row, staging.completed(staging(cell.particles->view())).view());
      if (!cell.particles)
        panel.write_middle(column, row, cell.remark);
      else if (!cell.remark.empty())
        panel.write_corner(column, row, cell.remark);
      ++time;
    }
    ++run;
  }
}

render::PanelBlock panel_block(const Drawing& drawing) {
  const ColorMeaning colors = meaning(drawing);
  return {sized(drawing).look, std::string(colors.name), std::string(colors.unit)};
}

render::PanelOptions panel_options(const Drawing& drawing, RunLabels labels) {
  render::PanelOptions panel;
  static_cast<render::PanelBlock&>(panel) = panel_block(drawing);
  if (const auto width = pixels_on_paper(drawing); width && !panel.look.size)
    panel.width = static_cast<int>(std::lround(*width));
  panel.title = drawing.title.value_or(std::move(labels.title));
  panel.note = std::move(labels.note);
  panel.columns = std::move(labels.columns);
  return panel;
}

void transpose(render::PanelOptions& panel) {
  std::vector<std::string> runs;
  for (const auto& [title, note] : panel.columns) runs.push_back(note.empty() ? title : title + ", " + note);
  panel.columns.clear();
  for (const std::string& time : panel.rows) panel.columns.push_back({time, ""});
  panel.rows = std::move(runs);
}

std::vector<Column> make_columns(const Drawing& chosen, const std::vector<SavedRun>& runs,
                                 const std::vector<double>& times, double until) {
  std::vector<Column> columns;
  for (const SavedRun& run : runs) {
    Drawing drawing = chosen;
    apply_scene(drawing, run.file);  // body numbers may differ
    if (drawing.look.categories != chosen.look.categories)
      throw UsageError(
          fmt::format("'{}' has {}, '{}' has {}, so they cannot have a common legend; choose another color",
                      runs.front().folder.path().string(), join(chosen.look.categories),
                      run.folder.path().string(), join(drawing.look.categories)));
    const Origins origins = origins_of(run.file.scene);
    columns.push_back({Staging(drawing, origins), {}});
    for (const double time : times)
      columns.back().cells.push_back(cell_at(run, time, until, drawing, origins));
  }
  return columns;
}

int compare_runs(const CompareArguments& options, Streams streams) {
  if (!options.labels.empty() && options.labels.size() != options.runs.size())
    throw UsageError(fmt::format("--labels must give one label for each run (labels: {}, runs: {})",
                                 options.labels.size(), options.runs.size()));
  const std::vector<SavedRun> runs = open_runs(options.runs);
  const Drawing chosen = chosen_drawing(runs, options);
  const double until = longest(runs);
  const std::vector<double> times = chosen_times(options, until);
  std::vector<Block> blocks = make_blocks(chosen, options, runs.front().file);
  std::vector<double> most_outside(runs.size(), 0);
  for (Block& block : blocks) {
    check_followed_body(block.drawing, runs,
                        &block == &blocks.front() ? "choose another body with --follow, or --follow none"
                                                  : "choose another body in --beside, or follow=none");
    block.columns = make_columns(block.drawing, runs, times, until);
    block.drawing = fitted_to(block.drawing, block.bounded, runs, block.columns);
    if (block.bounded) add_shares_outside(most_outside, *block.drawing.look.view, block.columns);
  }
  warn_about_particles_outside(runs, most_outside, streams.err);
  RunLabels labels = label_runs(runs);
  for (std::size_t k = 0; k < options.labels.size(); ++k) labels.columns[k] = {options.labels[k], ""};
  render::PanelOptions about = panel_options(blocks.front().drawing, std::move(labels));
  for (std::size_t k = 1; k < blocks.size(); ++k) about.beside.push_back(panel_block(blocks[k].drawing));
  about.rows = time_labels(times, until);
  if (options.times_across) transpose(about);
  render::Panel panel(about);
  for (int first = 0; const Block& block : blocks) {
    draw(panel, block.columns, first, options.times_across);
    first += static_cast<int>(about.columns.size());
  }
  const render::Image& image = panel.finish();
  streams.err << remark_on_texts(panel.cut_texts());
  make_folder_of(options.out);
  render::write_png(image, options.out);
  streams.out << "panel  " << options.out << " (" << image.width << "x" << image.height << ")\n";
  return exit_fine;
}

}  // namespace

std::function<int(Streams)> declare_compare(Options& command) {
  auto options = std::make_shared<CompareArguments>();
  command.add("DIR", "...", options->runs, "run folders with particles (`taut run --save-particles`)")
      .required();
  command.add("--out", "panel.png", options->out, "picture to write").required().check(png_name);
  command
      .add("--times", "T,...", options->times,
           "times to draw, s; default: 1/4, 1/2, 3/4 and the end of the longest run")
      .comma_separated()
      .check(not_negative_number);
  command
      .add("--labels", "LABEL,...", options->labels,
           "names of the runs in the picture; default: the settings in which the runs differ")
      .comma_separated()
      .check(line_of_text);
  command
      .add("--beside", "KEY=VALUE;...", options->beside,
           "the same pictures beside the others, with other drawing options, such as color=pressure, "
           "or 'camera=0:-1:0; color=speed'; can be repeated")
      .one_word_each();
  command.add_flag("--times-across", options->times_across,
                   "times from left to right, runs from top to bottom");
  declare_drawing_options(command, *options);
  return [options](Streams streams) { return compare_runs(*options, streams); };
}

}  // namespace taut::cli
