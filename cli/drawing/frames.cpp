#include "cli/drawing/frames.hpp"

#include <algorithm>

#include "cli/drawing/bounds.hpp"
#include "cli/drawing/picture.hpp"
#include "cli/text/format.hpp"
#include "render/image/image.hpp"

namespace taut::cli {

std::string frame_name(int number) { return numbered("frame", number, "png"); }

bool is_frame(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  return name.starts_with("frame_") &&
         (name.ends_with(".png") || name.find(".png.part") != std::string::npos);
}

Frames::Frames(const DrawingPlan& plan, std::filesystem::path folder, Captions captions, Seconds& seconds)
    : plan_(plan), folder_(std::move(folder)), captions_(std::move(captions)), seconds_(seconds) {
  if (plan_.range && plan_.view) renderer_ = make_renderer(plan_, captions_.until);
}

Frames::~Frames() = default;

void Frames::add(const Snapshot& snapshot) {
  std::vector<double> value;
  {
    const Timed timed(seconds_.render);
    value = evaluate(*plan_.field, snapshot);
  }
  FrameView view;
  view.dim = snapshot.dim;
  view.time = snapshot.time;
  view.x = snapshot.x;
  view.diameter = snapshot.diameter;
  view.value = value;
  add(view);
}

void Frames::add(const FrameView& particles) {
  if (renderer_)
    draw(particles);
  else
    keep(particles);
}

void Frames::keep(const FrameView& particles) {
  const Timed timed(seconds_.render);
  dim_ = particles.dim;
  diameter_.assign(particles.diameter.begin(), particles.diameter.end());
  kept_.push_back({particles.time,
                   {particles.x.begin(), particles.x.end()},
                   {particles.value.begin(), particles.value.end()}});
}

void Frames::choose_range_and_view() {
  const double diameter = diameter_.empty() ? 0 : std::ranges::max(diameter_);
  SequenceBounds bounds;
  for (const Kept& frame : kept_) {
    bounds.add_values(frame.value);
    bounds.add_positions(frame.x, dim_, diameter);
  }
  if (!plan_.range) plan_.range = bounds.range(plan_.field->is_signed);
  if (!plan_.view) plan_.view = bounds.view();
}

bool Frames::draw_kept(const std::function<bool(int)>& go_on) {
  if (kept_.empty()) return true;
  choose_range_and_view();
  renderer_ = make_renderer(plan_, captions_.until);
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

void Frames::draw(FrameView view) {
  view.field = plan_.field->name;
  view.unit = plan_.field->unit;
  view.title = captions_.title;
  view.method = captions_.method;
  const render::Image* image = nullptr;
  {
    const Timed timed(seconds_.render);
    image = &renderer_->draw(view);
  }
  const Timed timed(seconds_.write);
  render::write_png(*image, folder_ / frame_name(written_));
  ++written_;
}

}  // namespace taut::cli
