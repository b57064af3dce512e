#include "cli/run/dry_run.hpp"

#include <cmath>
#include <limits>
#include <ostream>
#include <sys/resource.h>

#include <fmt/core.h>

#include "cli/drawing/frames.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/system/stopwatch.hpp"
#include "cli/text/format.hpp"
#include "engine/methods/catalogue.hpp"
#include "engine/simulation.hpp"
#include "engine/warnings.hpp"
#include "render/image/png.hpp"

namespace taut::cli {
namespace {

/// The first step sets up contact and does not count.
struct Trial {
  double step = 0;     // mean, s
  double seconds = 0;  // per step
};

Trial make_steps(Simulation& simulation) {
  constexpr int most_steps = 50;
  constexpr double most_seconds = 2;
  const auto make_one = [&] {
    simulation.advance_to(std::nextafter(simulation.time(), std::numeric_limits<double>::infinity()));
  };
  make_one();
  const double start = simulation.time();
  const Stopwatch watch;
  int steps = 0;
  while (steps < most_steps && (steps == 0 || watch.seconds() < most_seconds)) make_one(), ++steps;
  return {(simulation.time() - start) / steps, watch.seconds() / steps};
}

/// Peak memory so far, bytes.
double memory_in_use() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/// Automatic ranges and views keep frames in memory until the end.
double memory_of_frames(const RunPlan& plan, std::size_t particles) {
  if (!plan.drawing) return 0;
  const render::Look& look = plan.drawing->look;
  if ((look.range || !look.categories.empty()) && look.view) return 0;
  const double bytes = plan.file.scene.dim == 2 ? 24 : 32;
  return bytes * static_cast<double>(particles * plan.frame_times.size());
}

std::string duration(double seconds) {
  constexpr double minute = 60, hour = 3600;
  return seconds < 2 * minute ? fmt::format("{:.2g} s", seconds)
         : seconds < 2 * hour ? fmt::format("{:.2g} min", seconds / minute)
                              : fmt::format("{:.3g} h", seconds / hour);
}

std::filesystem::path picture_of(const RunPlan& plan) {
  return plan.folder.path().lexically_normal().string() + "-first.png";
}

void draw_first(const RunPlan& plan, const Snapshot& start) {
  const Captions captions{plan.file.scene.title, plan.file.settings.method, plan.file.scene.until};
  const render::Image picture = draw_picture(fitted(*plan.drawing, start), captions, start);
  make_folder_of(picture_of(plan));
  render::write_png(picture, picture_of(plan));
}

}  // namespace

std::string dry_run(const RunPlan& plan, std::ostream& err) {
  const SceneFile& file = plan.file;
  const auto simulation = start(file);
  for (const std::string& warning :
       warnings_at_start(file.scene, *find_method(file.settings.method), *simulation))
    err << "taut: " << warning << '\n';
  const std::size_t particles = simulation->snapshot().size();
  if (plan.drawing) draw_first(plan, simulation->snapshot());
  const Trial trial = make_steps(*simulation);
  const double steps = std::ceil(file.scene.until / trial.step), seconds = steps * trial.seconds;
  const double bytes = memory_in_use() + memory_of_frames(plan, particles);
  std::string text = fmt::format("{} with {}: {} particles at dp = {} m, about {:.0f} step{} to t = {} s\n\n",
                                 file.scene.name, file.settings.method, particles, brief(file.scene.spacing),
                                 steps, steps == 1 ? "" : "s", brief(file.scene.until));
  const auto row = [&](const char* name, const std::string& value) {
    text += fmt::format("  {:<10}  {}\n", name, value);
  };
  row("step", brief(trial.step) + " s; it can become shorter or longer");
  row("solving", fmt::format("about {} on {} thread{}", duration(seconds), simulation->threads(),
                             simulation->threads() == 1 ? "" : "s"));
  row("memory", fmt::format("about {:.2g} GB", bytes / 1e9));
  row("frames", plan.drawing ? std::to_string(plan.frame_times.size()) : "none");
  row("run", plan.folder.path().string() + " (not written)");
  if (plan.drawing) row("picture", picture_of(plan).string());
  return text;
}

}  // namespace taut::cli
