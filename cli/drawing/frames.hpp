#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/drawing/bounds.hpp"
#include "cli/drawing/drawing.hpp"
#include "cli/drawing/staging.hpp"
#include "cli/system/ordered_work.hpp"
#include "cli/system/stopwatch.hpp"
#include "engine/frame_view.hpp"
#include "engine/snapshot.hpp"
#include "render/renderer.hpp"

namespace taut::cli {

/// "frame_00012.png"
std::string frame_name(int number);
/// Whether a file has a name that only `frame_name` gives, whole or in the making.
bool is_frame(const std::filesystem::path& path);

/// What stands beside the picture of every frame.
struct Captions {
  std::string title, method;
  double until = 0;  // s, the last time: gives the unit of all times
};

/// The drawing with what it leaves open as it suits this moment alone.
Drawing fitted(const Drawing& drawing, const Snapshot& snapshot);
/// One picture, as a frame with these captions would be; nothing may be open.
render::Image draw_picture(const Drawing& drawing, const Captions& captions, const Snapshot& snapshot);

/// Draws the frames of a run: each at once when the range and the view are known beforehand; otherwise what a
/// frame shows is kept in memory, and all are drawn at the end over the range and view of the whole sequence.
///
/// With several threads frames are drawn and written beside the caller, which waits only while as many of
/// them are under way as OrderedWork has room for. Files are the same, and a frame is there only when all
/// before it are. Each thread has a picture of its own; there are no more than `memory_of_pictures` has room
/// for.
class Frames {
 public:
  static constexpr double memory_of_pictures = 1e9;  // bytes, with all that belongs to a picture

  /// Draws nothing, but fails where no picture can be drawn at all.
  /// `origins` are those of the particles that will be added. The time that it takes is added to `seconds`,
  /// by all threads together, whenever `finish` is called.
  Frames(const Drawing& drawing, Origins origins, std::filesystem::path folder, Captions captions,
         int threads, Seconds& seconds);

  void add(const Snapshot& snapshot);
  /// All particles with the values of the drawing's field; the texts are added here.
  void add(const FrameView& particles);
  /// Draws what was kept; asks `go_on` before each frame. False if it was told to stop.
  bool draw_kept(const std::function<bool(int drawn)>& go_on);
  /// Waits for the frames that are under way. It throws what went wrong with them, as all that adds frames
  /// does.
  void finish();

  int kept() const { return static_cast<int>(kept_.size()); }
  /// Grows while frames are under way.
  int written() const { return written_; }

  /// After `finish`.
  template <class Archive>
  void serialize(Archive& archive) {
    int written = written_;
    archive(dim_, diameter_, kept_, written);
    archive.check("a stored frame", [&] {
      const std::size_t n = staging_.size(), d = static_cast<std::size_t>(staging_.dim());
      const auto fits = [&](const Kept& frame) {
        const auto is_finite = [](double x) { return std::isfinite(x); };
        return frame.x.size() == d * n && frame.value.size() == n &&
               std::ranges::all_of(frame.x, is_finite) && std::ranges::all_of(frame.origin, is_finite);
      };
      return kept_.empty() || (std::cmp_equal(dim_, d) && diameter_.size() == n && !renderers_.front() &&
                               std::ranges::all_of(kept_, fits));
    });
    written_ = drawn_ = written;
  }

 private:
  /// What one frame shows. Single precision would not tell particles apart that are far from the origin.
  struct Kept {
    double time;   // s
    Point origin;  // m
    std::vector<double> x, value;

    template <class Archive>
    void serialize(Archive& archive) {
      archive(time, origin, x, value);
    }
  };
  /// Where a camera stands that goes about a scene.
  struct Standpoint {
    render::Camera camera;
    render::View view;
  };
  void keep(StagedParticles particles);
  StagedParticles staged(const Kept& frame) const;
  SequenceBounds bounds_of_kept() const;
  void begin_drawing(const SequenceBounds& shown);
  void draw(StagedParticles particles, std::optional<Standpoint> from = {});
  std::vector<std::uint8_t> draw_picture(int worker, const StagedParticles& particles,
                                         const std::optional<Standpoint>& from);
  void write(const std::vector<std::uint8_t>& picture, int number);
  Standpoint on_orbit(double share) const;

  Drawing drawing_;
  Staging staging_;
  std::filesystem::path folder_;
  Captions captions_;
  Seconds& seconds_;
  int dim_ = 2;
  std::vector<double> diameter_;  // m
  std::vector<Kept> kept_;
  std::optional<render::Vector> orbited_;  // the middle of a camera's way about it, m
  int drawn_ = 0;                          // or being drawn
  std::atomic<int> written_ = 0;
  std::atomic<double> drawing_time_ = 0, writing_time_ = 0;  // s, not added to `seconds_` yet
  /// Of each thread, from when the range and the view are known and it has something to draw.
  std::vector<std::optional<render::Renderer>> renderers_;
  OrderedWork work_;  // the last member: its threads use all others
};

}  // namespace taut::cli
