#include "cli/drawing/frames.hpp"

#include <algorithm>

#include "cli/system/stopwatch.hpp"
#include "cli/text/format.hpp"
#include "render/image/png.hpp"

namespace taut::cli {
namespace {

/// Refers to both.
FrameView view_of(const Snapshot& snapshot, std::span<const double> value) {
  FrameView view;
  view.dim = snapshot.dim;
  view.time = snapshot.time;
  view.x = snapshot.x;
  view.diameter = snapshot.diameter;
  view.value = value;
  return view;
}

/// With what stands beside the particles; refers to it.
FrameView with_texts(FrameView view, const Field& field, const Captions& captions) {
  view.field = field.name;
  view.unit = field.unit;
  view.title = captions.title;
  view.method = captions.method;
  return view;
}

}  // namespace

std::string frame_name(int number) { return numbered("frame", number, "png"); }

bool is_frame(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  return name.starts_with("frame_") &&
         (name.ends_with(".png") || name.find(".png.part") != std::string::npos);
}

Drawing fitted(const Drawing& drawing, const Snapshot& snapshot) {
  const std::vector<double> value = evaluate(*drawing.field, snapshot);
  const Staging staging(drawing, origins_of(snapshot));
  SequenceBounds shown(drawing.look.camera);
  staging.extend(shown, staging(view_of(snapshot, value)));
  return fitted(drawing, shown);
}

render::Image draw_picture(const Drawing& drawing, const Captions& captions, const Snapshot& snapshot) {
  const std::vector<double> value = evaluate(*drawing.field, snapshot);
  const Staging staging(drawing, origins_of(snapshot));
  const StagedParticles drawn = staging.dressed(staging(view_of(snapshot, value)));
  render::Renderer renderer(drawing.look, captions.until);
  return renderer.draw(with_texts(drawn.view(), *drawing.field, captions));
}

Frames::Frames(const Drawing& drawing, Origins origins, std::filesystem::path folder, Captions captions,
               double& drawing_time, double& writing_time)
    : drawing_(drawing),
      staging_(drawing, std::move(origins)),
      folder_(std::move(folder)),
      captions_(std::move(captions)),
      drawing_time_(drawing_time),
      writing_time_(writing_time) {
  if (drawing_.look.range && drawing_.look.view) begin_drawing(SequenceBounds());
}

void Frames::begin_drawing(const SequenceBounds& shown) {
  drawing_ = fitted(drawing_, shown);
  if (drawing_.orbit) {
    const auto [view, middle] = shown.orbit();
    drawing_.look.view = view;
    orbited_ = middle;
  }
  renderer_.emplace(drawing_.look, captions_.until);
}

void Frames::add(const Snapshot& snapshot) {
  std::vector<double> value;
  {
    const Timed timed(drawing_time_);
    value = evaluate(*drawing_.field, snapshot);
  }
  add(view_of(snapshot, value));
}

void Frames::add(const FrameView& particles) {
  StagedParticles staged;
  {
    const Timed timed(drawing_time_);
    staged = staging_(particles);
  }
  if (renderer_)
    draw(staged);
  else
    keep(staged);
}

void Frames::keep(const StagedParticles& particles) {
  const Timed timed(drawing_time_);
  dim_ = particles.dim;
  diameter_ = particles.diameter;
  kept_.push_back({particles.time,
                   {particles.x.begin(), particles.x.end()},
                   {particles.value.begin(), particles.value.end()}});
}

StagedParticles Frames::staged(const Kept& frame) const {
  return {
      dim_, frame.time, {frame.x.begin(), frame.x.end()}, diameter_, {frame.value.begin(), frame.value.end()},
      {}};
}

SequenceBounds Frames::bounds_of_kept() const {
  SequenceBounds bounds(drawing_.look.camera);
  for (const Kept& frame : kept_) staging_.extend(bounds, staged(frame));
  return bounds;
}

bool Frames::draw_kept(const std::function<bool(int)>& go_on) {
  if (kept_.empty()) return true;
  begin_drawing(bounds_of_kept());
  for (const Kept& frame : kept_) {
    if (!go_on(written_)) return false;
    if (orbited_) look_from_orbit(written_ / static_cast<double>(kept_.size()));
    draw(staged(frame));
  }
  return true;
}

/// `share` of a whole turn.
void Frames::look_from_orbit(double share) {
  render::Camera camera = orbited(*drawing_.look.camera, 360 * share, 0);
  const auto [right, up, back] = axes_of(camera);
  const double x = render::dot(right, *orbited_), y = render::dot(up, *orbited_);
  render::View view = *drawing_.look.view;  // about the origin
  camera.front = render::dot(back, *orbited_) + view.x_max;
  renderer_->look_from(camera, {view.x_min + x, view.x_max + x, view.y_min + y, view.y_max + y});
}

void Frames::draw(const StagedParticles& particles) {
  const render::Image* image = nullptr;
  {
    const Timed timed(drawing_time_);
    const StagedParticles drawn = staging_.dressed(particles);
    image = &renderer_->draw(with_texts(drawn.view(), *drawing_.field, captions_));
  }
  const Timed timed(writing_time_);
  render::write_png(*image, folder_ / frame_name(written_));
  ++written_;
}

}  // namespace taut::cli
