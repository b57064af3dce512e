#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cli/drawing/look.hpp"
#include "cli/system/stopwatch.hpp"
#include "engine/frame_view.hpp"
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

/// Draws the frames of a run: each at once when the range and the view are known beforehand; otherwise what a
/// frame shows is kept in memory, and all are drawn at the end over the range and view of the whole sequence.
class Frames {
 public:
  /// Draws nothing, but fails where no picture can be drawn at all.
  /// The time it takes is added to `seconds`.
  Frames(const DrawingPlan& plan, std::filesystem::path folder, Captions captions, Seconds& seconds);
  ~Frames();

  void add(const Snapshot& snapshot);
  /// Particles with the values of the plan's field; the texts are added here.
  void add(const FrameView& particles);
  /// Draws what was kept; asks `go_on` before each frame. False if it was told to stop.
  bool draw_kept(const std::function<bool(int drawn)>& go_on);

  int kept() const { return static_cast<int>(kept_.size()); }
  int written() const { return written_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(dim_, diameter_, kept_, written_);
  }

 private:
  /// What one frame shows, in single precision: a picture has no more.
  struct Kept {
    double time;  // s
    std::vector<float> x, value;

    template <class Archive>
    void serialize(Archive& archive) {
      archive(time, x, value);
    }
  };
  void keep(const FrameView& particles);
  void choose_range_and_view();
  void draw(FrameView particles);

  DrawingPlan plan_;
  std::filesystem::path folder_;
  Captions captions_;
  Seconds& seconds_;
  int dim_ = 2;
  std::vector<double> diameter_;  // m
  std::vector<Kept> kept_;
  std::unique_ptr<render::Renderer> renderer_;  // made when the range and the view are known
  int written_ = 0;
};

}  // namespace taut::cli
