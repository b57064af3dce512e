#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/drawing/bounds.hpp"
#include "cli/drawing/drawing.hpp"
#include "cli/drawing/staging.hpp"
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
class Frames {
 public:
  /// Draws nothing, but fails where no picture can be drawn at all.
  /// `origins` are those of the particles that will be added. The time that it takes is added to `drawing_time` and `writing_time`, s.
  Frames(const Drawing& drawing, Origins origins, std::filesystem::path folder, Captions captions,
         double& drawing_time, double& writing_time);

  void add(const Snapshot& snapshot);
  /// All particles with the values of the drawing's field; the texts are added here.
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
  void keep(const StagedParticles& particles);
  StagedParticles staged(const Kept& frame) const;
  SequenceBounds bounds_of_kept() const;
  void begin_drawing(const SequenceBounds& shown);
  void draw(const StagedParticles& particles);
  void look_from_orbit(double share);

  Drawing drawing_;
  Staging staging_;
  std::filesystem::path folder_;
  Captions captions_;
  double &drawing_time_, &writing_time_;  // s
  int dim_ = 2;
  std::vector<double> diameter_;  // m
  std::vector<Kept> kept_;
  std::optional<render::Vector> orbited_;     // the middle of a camera's way about it, m
  std::optional<render::Renderer> renderer_;  // made when the range and the view are known
  int written_ = 0;
};

}  // namespace taut::cli
