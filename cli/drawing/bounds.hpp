#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "cli/drawing/drawing.hpp"
#include "engine/frame_view.hpp"

namespace taut::cli {

/// Range and view of a sequence of frames, without non-finite values.
class SequenceBounds {
 public:
  /// The camera sets the plane of the view.
  explicit SequenceBounds(const std::optional<render::Camera>& camera = {});

  void add_values(std::span<const double> values);
  /// `x` has `dim` coordinates per particle, m; `diameter` is the largest one, m.
  void add_positions(std::span<const double> x, int dim, double diameter);
  void add(const FrameView& particles);

  /// Clips at most 1 % of the values above `round_off` at each end, and no end that widens the range by less than a
  /// quarter. Never empty; symmetric about `middle`, if given.
  render::Range range(std::optional<double> middle, double round_off = 0) const;
  /// With a margin of 5 % of the longer side.
  render::View view() const;
  /// Centred at the origin, the centre of the followed body, and half as large again.
  render::View view_about_origin() const;
  /// A view that contains everything from all directions.
  struct Orbit {
    render::View view;  // centred at the origin
    render::Vector middle;
  };
  Orbit orbit() const;
  /// Coordinate of the nearest particle towards the camera, m.
  double front() const;

 private:
  struct Interval {
    double low = 1e300, high = -1e300;
    void add(double value, double margin = 0);
  };
  Interval values_, x_, y_, z_;  // the last three along the camera's axes
  std::vector<double> sample_;   // every `stride_`-th value
  std::size_t stride_ = 1, seen_ = 0;
  std::optional<render::CameraAxes> axes_;
};

/// Sets the open members of `drawing`.
Drawing fitted(Drawing drawing, const SequenceBounds& shown);

}  // namespace taut::cli
