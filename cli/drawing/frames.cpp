#include "cli/drawing/frames.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "cli/text/format.hpp"
#include "render/image/png.hpp"

namespace taut::cli {
namespace {

/// The result refers to the arguments.
FrameView view_of(const Snapshot& snapshot, std::span<const double> value) {
  FrameView view;
  view.dim = snapshot.dim;
  view.time = snapshot.time;
  view.x = snapshot.x;
  view.diameter = snapshot.diameter;
  view.value = value;
  return view;
}

FrameView with_texts(FrameView view, const Drawing& drawing, const Captions& captions) {
  const ColorMeaning colors = meaning(drawing);
  view.field = colors.name;
  view.unit = colors.unit;
  view.title = drawing.title ? *drawing.title : captions.title;
  view.method = captions.method;
  return view;
}

/// Limits memory.
int pictures_at_once(const Drawing& drawing, int threads) {
  constexpr double bytes_of_pixel = 70;  // in 3D, with four samples
  const render::Size size = sized(drawing).look.size.value_or(render::Size{});
  const double bytes = bytes_of_pixel * size.width * size.height;
  return std::clamp(static_cast<int>(Frames::memory_of_pictures / bytes), 1, std::max(threads, 1));
}

}  // namespace

std::string frame_name(int number) { return numbered("frame", number, "png"); }

bool is_frame(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  return name.starts_with("frame_") &&
         (name.ends_with(".png") || name.find(".png.part") != std::string::npos);
}

Drawing fitted(const Drawing& drawing, const Snapshot& snapshot) {
  const std::vector<double> value = color_values(drawing, snapshot);
  const Staging staging(drawing, origins_of(snapshot));
  SequenceBounds shown(drawing.look.camera);
  staging.extend(shown, staging(view_of(snapshot, value)));
  return fitted(drawing, shown);
}

render::Image draw_picture(const Drawing& drawing, const Captions& captions, const Snapshot& snapshot) {
  const std::vector<double> value = color_values(drawing, snapshot);
  const Staging staging(drawing, origins_of(snapshot));
  const StagedParticles drawn = staging.completed(staging(view_of(snapshot, value)));
  render::Renderer renderer(sized(drawing).look, captions.until);
  return renderer.draw(with_texts(drawn.view(), drawing, captions));
}

Frames::Frames(const Drawing& drawing, Origins origins, std::filesystem::path folder, Captions captions,
               int threads, Seconds& seconds)
    : drawing_(drawing),
      staging_(drawing, std::move(origins)),
      folder_(std::move(folder)),
      captions_(std::move(captions)),
      seconds_(seconds),
      renderers_(static_cast<std::size_t>(pictures_at_once(drawing_, threads))),
      // with one renderer, the caller draws
      work_(renderers_.size() > 1 ? static_cast<int>(renderers_.size()) : 0) {
  const render::Look& look = drawing_.look;
  if ((look.range || !look.categories.empty()) && look.view) begin_drawing(SequenceBounds());
}

void Frames::begin_drawing(const SequenceBounds& shown) {
  drawing_ = sized(fitted(drawing_, shown));
  if (drawing_.orbit) {
    const auto [view, middle] = shown.orbit();
    drawing_.look.view = view;
    orbited_ = middle;
  }
  renderers_.front().emplace(drawing_.look, captions_.until);
}

void Frames::add(const Snapshot& snapshot) {
  std::vector<double> value;
  {
    const Timed timed(seconds_.render);
    value = color_values(drawing_, snapshot);
  }
  add(view_of(snapshot, value));
}

void Frames::add(const FrameView& particles) {
  StagedParticles staged;
  {
    const Timed timed(seconds_.render);
    staged = staging_(particles);
  }
  if (renderers_.front())
    draw(std::move(staged));
  else
    keep(std::move(staged));
}

void Frames::keep(StagedParticles particles) {
  const Timed timed(seconds_.render);
  dim_ = particles.dim;
  diameter_ = std::move(particles.diameter);
  kept_.push_back({particles.time, particles.origin, std::move(particles.x), std::move(particles.value)});
}

StagedParticles Frames::staged(const Kept& frame) const {
  return {.dim = dim_,
          .time = frame.time,
          .x = frame.x,
          .diameter = diameter_,
          .value = frame.value,
          .origin = frame.origin};
}

SequenceBounds Frames::bounds_of_kept() const {
  SequenceBounds bounds(drawing_.look.camera);
  for (const Kept& frame : kept_) staging_.extend(bounds, staged(frame));
  return bounds;
}

bool Frames::draw_kept(const std::function<bool(int)>& go_on) {
  if (kept_.empty()) return true;
  begin_drawing(bounds_of_kept());
  bool going = true;
  for (std::size_t k = 0; k < kept_.size() && (going = go_on(drawn_)); ++k)
    draw(staged(kept_[k]),
         orbited_ ? std::optional(on_orbit(static_cast<double>(k) / static_cast<double>(kept_.size())))
                  : std::nullopt);
  finish();
  return going;
}

void Frames::finish() {
  const auto settle = [this] {
    seconds_.render += drawing_time_.exchange(0);
    seconds_.write += writing_time_.exchange(0);
  };
  try {
    work_.finish();
  } catch (...) {
    settle();
    throw;
  }
  settle();
}

std::set<std::string> Frames::cut_texts() const {
  std::set<std::string> all;
  for (const auto& renderer : renderers_)
    if (renderer && written_ > 0) all.merge(renderer->cut_texts());
  return all;
}

std::string remark_on_texts(const std::set<std::string>& cut) {
  if (cut.empty()) return "";
  return fmt::format(
      "taut: the picture has no room for {}; use a larger --size, or fewer texts with --text\n",
      join({cut.begin(), cut.end()}, "; "));
}

/// `share` of a full turn.
Frames::Standpoint Frames::on_orbit(double share) const {
  render::Camera camera = orbited(*drawing_.look.camera, 360 * share, 0);
  const auto [right, up, back] = axes_of(camera);
  const double x = render::dot(right, *orbited_), y = render::dot(up, *orbited_);
  const render::View view = *drawing_.look.view;
  camera.front = render::dot(back, *orbited_) + view.x_max;
  return {camera, {view.x_min + x, view.x_max + x, view.y_min + y, view.y_max + y}};
}

void Frames::draw(StagedParticles particles, std::optional<Standpoint> from) {
  work_.add([this, number = drawn_++, from, particles = std::move(particles)](int worker) {
    return [this, number, picture = draw_picture(worker, particles, from)] { write(picture, number); };
  });
}

std::vector<std::uint8_t> Frames::draw_picture(int worker, const StagedParticles& particles,
                                               const std::optional<Standpoint>& from) {
  const Stopwatch watch;
  std::optional<render::Renderer>& renderer = renderers_[static_cast<std::size_t>(worker)];
  if (!renderer) renderer.emplace(drawing_.look, captions_.until);
  if (from) renderer->look_from(from->camera, from->view);
  const StagedParticles drawn = staging_.completed(particles);
  const render::Image& image = renderer->draw(with_texts(drawn.view(), drawing_, captions_));
  drawing_time_ += watch.seconds();
  const Stopwatch encoding;
  std::vector<std::uint8_t> picture = render::encode_png(image);
  writing_time_ += encoding.seconds();
  return picture;
}

void Frames::write(const std::vector<std::uint8_t>& picture, int number) {
  const Stopwatch watch;
  const int of_file = file_numbers_.empty() ? number : file_numbers_.at(static_cast<std::size_t>(number));
  render::write_png(picture, folder_ / frame_name(of_file));
  writing_time_ += watch.seconds();
  ++written_;
}

}  // namespace taut::cli
