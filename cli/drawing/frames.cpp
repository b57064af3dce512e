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
  SequenceBounds shown;
  shown.add(view_of(snapshot, evaluate(*drawing.field, snapshot)));
  return fitted(drawing, shown);
}

render::Image draw_picture(const Drawing& drawing, const Captions& captions, const Snapshot& snapshot) {
  const std::vector<double> value = evaluate(*drawing.field, snapshot);
  render::Renderer renderer(drawing.look, captions.until);
  return renderer.draw(with_texts(view_of(snapshot, value), *drawing.field, captions));
}

Frames::Frames(const Drawing& drawing, std::filesystem::path folder, Captions captions, double& drawing_time,
               double& writing_time)
    : drawing_(drawing),
      folder_(std::move(folder)),
      captions_(std::move(captions)),
      drawing_time_(drawing_time),
      writing_time_(writing_time) {
  if (drawing_.look.range && drawing_.look.view) begin_drawing({});
}

void Frames::begin_drawing(const SequenceBounds& shown) {
  drawing_ = fitted(drawing_, shown);
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
  if (renderer_)
    draw(particles);
  else
    keep(particles);
}

void Frames::keep(const FrameView& particles) {
  const Timed timed(drawing_time_);
  dim_ = particles.dim;
  diameter_.assign(particles.diameter.begin(), particles.diameter.end());
  kept_.push_back({particles.time,
                   {particles.x.begin(), particles.x.end()},
                   {particles.value.begin(), particles.value.end()}});
}

SequenceBounds Frames::bounds_of_kept() const {
  const double diameter = diameter_.empty() ? 0 : std::ranges::max(diameter_);
  SequenceBounds bounds;
  for (const Kept& frame : kept_) {
    bounds.add_values(frame.value);
    bounds.add_positions(frame.x, dim_, diameter);
  }
  return bounds;
}

bool Frames::draw_kept(const std::function<bool(int)>& go_on) {
  if (kept_.empty()) return true;
  begin_drawing(bounds_of_kept());
  for (const Kept& frame : kept_) {
    if (!go_on(written_)) return false;
    const std::vector<double> x(frame.x.begin(), frame.x.end());
    const std::vector<double> value(frame.value.begin(), frame.value.end());
    FrameView view;
    view.dim = dim_;
    view.time = frame.time;
    view.x = x;
    view.diameter = diameter_;
    view.value = value;
    draw(view);
  }
  return true;
}

void Frames::draw(const FrameView& particles) {
  const render::Image* image = nullptr;
  {
    const Timed timed(drawing_time_);
    image = &renderer_->draw(with_texts(particles, *drawing_.field, captions_));
  }
  const Timed timed(writing_time_);
  render::write_png(*image, folder_ / frame_name(written_));
  ++written_;
}

}  // namespace taut::cli
