#include "cli/session/session.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "cli/drawing/frames.hpp"
#include "cli/run/checkpoint.hpp"
#include "cli/run/folder.hpp"
#include "cli/run/run.hpp"
#include "cli/run/schedule.hpp"
#include "cli/scene/reference_table.hpp"
#include "cli/system/stopwatch.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"
#include "engine/methods/catalogue.hpp"
#include "engine/snapshot_blend.hpp"
#include "render/image/png.hpp"

namespace taut::cli {
namespace {

std::unique_ptr<Simulation> start_interruptible(const SceneFile& file) {
  std::unique_ptr<Simulation> simulation = start(file);
  simulation->set_stop_flag(Interrupts::flag());
  return simulation;
}

std::string reason_against(const std::string& name, const SceneFile& file) {
  const auto infos = setting_infos();
  if (const auto info = std::ranges::find(infos, name, &SettingInfo::name); info != infos.end())
    return std::string(info->fixed_since);
  if (!name.starts_with(constant_prefix)) return "the initial bodies depend on it";
  const Formulation& method = find_method(file.settings.method)->formulation;
  for (const MethodConstant& constant : method_constants(method, file.scene.dim))
    if (constant.at_set_up && name.substr(constant_prefix.size()) == constant.name)
      return "the initial neighbours and their weights depend on it";
  return "";
}

/// Scene in a saved state; independent of the spelling of the scene's path.
std::string state_scene(const SceneFile& file) {
  return resolved_text(file, std::filesystem::absolute(file.path).parent_path());
}

}  // namespace

Session::Session(const RunOptions& options)
    : options_(options),
      file_(scene_to_run(options)),
      file_checksum_(file_checksum(file_)),
      drawing_(with_options(file_.drawing, options.drawing)),
      simulation_(start_interruptible(file_)) {
  apply_scene(drawing_, file_);
}

void Session::step(long count, const Interrupts& interrupts) {
  constexpr double later = std::numeric_limits<double>::infinity();
  between_.reset();
  for (long k = 0; k < count && !interrupts.interrupted(); ++k)
    simulation_->advance_to(std::nextafter(simulation_->time(), later));
}

void Session::run_until(double t, const Interrupts& interrupts, Progress& progress) {
  if (simulation_->time() >= t) return;
  Pace pace(t);
  const double start = simulation_->time();
  between_.reset();
  progress.begin(fmt::format("to {} s", brief(t)));
  while (simulation_->time() < t && !interrupts.interrupted()) {
    const Stopwatch watch;
    const double from = simulation_->time(), to = std::min(t, from + pace.slice());
    simulation_->advance(to, t);
    if (simulation_->time() < to) {
      const Snapshot before = simulation_->snapshot();
      simulation_->advance_to(to);
      if (simulation_->steps() > before.step) between_ = blend(before, simulation_->snapshot(), t);
    }
    pace.took(simulation_->time() - from, watch.seconds());
    progress.show((simulation_->time() - start) / (t - start),
                  fmt::format("t = {} s", brief(simulation_->time())));
  }
  progress.clear();
}

void Session::reset() {
  simulation_ = start_interruptible(file_);
  between_.reset();
}

std::string_view Session::law() const {
  return material_law(*find_method(file_.settings.method), file_.settings, file_.scene.dim);
}

std::vector<MeasureResult> Session::measures() const {
  return measure(file_.scene, simulation_->series(), law(), {}, &simulation_->snapshot());
}

void Session::set(const Setting& setting) {
  RunOptions options = options_;
  options.settings.push_back(setting);
  SceneFile file = scene_to_run(options, file_);
  if (const std::string reason = reason_against(setting.name, file_); !reason.empty())
    throw UsageError(
        fmt::format("'{}' cannot change during a session: {}; only cfl can, "
                    "and constants of the method that are not fixed at the start. "
                    "Start another session with --set {}",
                    setting.name, reason, text_of(setting)));
  if (file_checksum(file) != file_checksum_)
    throw UsageError(
        fmt::format("a table or shape that '{}' names has changed since the session started; "
                    "restore it, or start another session",
                    file_.path.string()));
  std::unique_ptr<Simulation> simulation = start_interruptible(file);
  simulation->load(simulation_->save());
  simulation_ = std::move(simulation);
  options_ = std::move(options);
  file_ = std::move(file);
}

std::vector<std::string> Session::names_to_change() const {
  std::vector<std::string> names = names_to_set(file_);
  std::erase_if(names, [&](const std::string& name) { return !reason_against(name, file_).empty(); });
  return names;
}

void Session::set_look(const DrawingKey& key, const std::string& text) {
  Drawing drawing = drawing_;
  set_typed(drawing, key, text);
  const bool other_origin = drawing.follow != drawing_.follow;
  if (other_origin) drawing.look.view.reset();  // it is relative to the followed body
  apply_scene(drawing, file_);
  fitted(drawing, shown());  // throws if a cut leaves nothing
  if (key.name == "view" || other_origin || drawing.look.camera != drawing_.look.camera) window_.reset();
  drawing_ = std::move(drawing);
}

Drawing Session::drawing() const {
  Drawing drawing = fitted(drawing_, shown());
  if (window_) drawing.look.view = window_;
  return drawing;
}

void Session::see(const render::View& view) { (drawing_.look.camera ? window_ : drawing_.look.view) = view; }

void Session::pan(double dx, double dy) {
  const render::View now = *drawing().look.view;
  see({now.x_min + dx, now.x_max + dx, now.y_min + dy, now.y_max + dy});
}

void Session::zoom(double factor) {
  if (!(factor > 0)) throw UsageError("the factor of zoom must be above 0");
  const render::View now = *drawing().look.view;
  const double x = (now.x_min + now.x_max) / 2, y = (now.y_min + now.y_max) / 2;
  const double half_x = (now.x_max - now.x_min) / 2 / factor, half_y = (now.y_max - now.y_min) / 2 / factor;
  see({x - half_x, x + half_x, y - half_y, y + half_y});
}

void Session::orbit(double right, double upwards) {
  if (!drawing_.look.camera)
    throw UsageError("orbit needs a scene in 3D; use view pan and view zoom in this scene");
  drawing_.look.camera = orbited(*drawing_.look.camera, right, upwards);
  window_.reset();
}

void Session::frame(const std::filesystem::path& file) const {
  const auto lock = lock_around(file, "taut session");
  render::write_png(picture(drawing()), file);
}

render::Image Session::picture(const Drawing& drawing) const {
  const Captions captions{file_.scene.title, file_.settings.method, file_.scene.until};
  return draw_picture(drawing, captions, shown());
}

void Session::save(const std::filesystem::path& file) const {
  Checkpoint checkpoint;
  checkpoint.method = file_.settings.method;
  checkpoint.scene = state_scene(file_);
  checkpoint.state = simulation_->save();
  const auto lock = lock_around(file, "taut session");
  write_checkpoint(file, std::move(checkpoint));
}

void Session::load(const std::filesystem::path& path) {
  const Checkpoint checkpoint = read_checkpoint(path);
  if (checkpoint.method != file_.settings.method)
    throw UsageError(fmt::format("'{}' has method '{}', but this session has '{}'", path.string(),
                                 checkpoint.method, file_.settings.method));
  if (without_drawing(checkpoint.scene) != without_drawing(state_scene(file_)))
    throw UsageError(
        fmt::format("'{}' is from another scene, or has other parameters or constants", path.string()));
  std::unique_ptr<Simulation> simulation = start_interruptible(file_);
  try {
    simulation->load(checkpoint.state);
  } catch (const UsageError& e) {
    throw UsageError(fmt::format("'{}' cannot be used: {}", path.string(), e.what()));
  }
  simulation_ = std::move(simulation);
  between_.reset();
}

}  // namespace taut::cli
