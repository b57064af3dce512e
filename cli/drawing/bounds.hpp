#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "cli/drawing/drawing.hpp"
#include "engine/frame_view.hpp"

namespace taut::cli {

/// The range of values and the view that hold every frame of a sequence. What is not finite does not count.
class SequenceBounds {
 public:
  /// A camera, in 3D, decides which way the view lies.
  explicit SequenceBounds(const std::optional<render::Camera>& camera = {});

  void add_values(std::span<const double> values);
  /// Positions, `dim` coordinates each; particles of diameter `diameter` (m) at most.
  void add_positions(std::span<const double> x, int dim, double diameter);
  /// Both.
  void add(const FrameView& particles);

  /// At most a hundredth of the values lies below it, and a hundredth above: of those that are not 0 or as little as
  /// `round_off`, as they are where nothing has happened yet. An end that is not far beyond takes all. Never empty; as
  /// far to both sides of `middle`, where there is one.
  render::Range range(std::optional<double> middle, double round_off = 0) const;
  /// With a margin of 5 % of the longer side.
  render::View view() const;
  /// The same about the origin, where the followed body's centre of mass is, and half as large again: what it
  /// meets is seen too.
  render::View view_about_origin() const;
  /// A view about the middle of what is shown that holds it from wherever the camera goes about it, and that
  /// middle.
  struct Orbit {
    render::View view;  // about the origin
    render::Vector middle;
  };
  Orbit orbit() const;
  /// Height of the nearest particle along the camera's direction, m.
  double front() const;

 private:
  struct Interval {
    double low = 1e300, high = -1e300;
    void add(double value, double margin = 0);
  };
  Interval values_, x_, y_, z_;  // the last three in the plane of the picture, and towards the camera
  std::vector<double> sample_;   // each `stride_`-th of the values
  std::size_t stride_ = 1, seen_ = 0;
  std::optional<render::CameraAxes> axes_;  // of the camera
};

/// The drawing with nothing left open: the colour map as it suits the field, range and view over `shown`.
Drawing fitted(Drawing drawing, const SequenceBounds& shown);

}  // namespace taut::cli
