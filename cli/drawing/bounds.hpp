#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "cli/drawing/drawing.hpp"
#include "engine/frame_view.hpp"

namespace taut::cli {

/// Range and view of several frames; ignores NaN and magnitudes from 1e100.
class SequenceBounds {
 public:
  explicit SequenceBounds(const std::optional<render::Camera>& camera = {});

  void add_values(std::span<const double> values);
  /// `x`: `dim` coordinates per particle, m; `diameter`: the largest, m.
  void add_positions(std::span<const double> x, int dim, double diameter);
  void add(const FrameView& particles);

  /// Leaves out outliers: at each end at most 1 % of the values beyond ±`round_off`. Never empty; symmetric about
  /// `middle`, if given.
  render::Range range(std::optional<double> middle, double round_off = 0) const;
  /// Includes a margin of 5 % of the longer side.
  render::View view() const;
  /// 1.5 times as large as needed.
  render::View view_about_origin() const;
  /// View that contains all particles from every direction.
  struct Orbit {
    render::View view;      // centred at the origin
    render::Vector middle;  // m
  };
  Orbit orbit() const;
  /// `Camera::front`: greatest coordinate of the particles towards the camera, m.
  double front() const;

 private:
  struct Interval {
    double low = 1e300, high = -1e300;
    void add(double value, double margin = 0);
  };
  Interval values_, x_, y_, z_;  // positions: along the camera's axes, if any
  std::vector<double> sample_;
  std::size_t stride_ = 1, seen_ = 0;
  std::optional<render::CameraAxes> axes_;
};

/// Completes the look.
Drawing fitted(Drawing drawing, const SequenceBounds& shown);

}  // namespace taut::cli
