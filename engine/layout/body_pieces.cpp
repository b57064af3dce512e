#include "engine/layout/body_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "engine/core/index.hpp"
#include "engine/error.hpp"

namespace taut {
namespace {

constexpr double greatest_cube_number = 2e9;

class Cubes {
 public:
  Cubes(const LatticeFrame& frame, const Bounds& box) : frame_(frame), dim_(as_index(frame.dim)) {
    const Point anchor = frame.body.shapes.front()->anchor();
    double cubes = 1;
    for (std::size_t k = 0; k < dim_; ++k) {
      low_[k] = std::floor((box.low[k] - anchor[k]) / frame.dp) - 1;
      const double high = std::ceil((box.high[k] - anchor[k]) / frame.dp) + 1;
      cubes *= (high - low_[k]) / side_;
      if (!(cubes <= greatest_cube_number))
        throw SceneError(
            "body." + frame.body.name + ".layout",
            fmt::format("layout = \"relaxed\" divides the box around body '{}' into more than {:g} cubes; "
                        "use a larger spacing, or make distant parts separate bodies",
                        frame.body.name, greatest_cube_number));
      number_[k] = std::lround((high - low_[k]) / side_);
      stride_[k] = k == 0 ? 1 : stride_[k - 1] * number_[k - 1];
    }
    filled_.resize(static_cast<std::size_t>(number_[0] * number_[1] * number_[2]));
    for_each([&](long cube, const Point& middle) {
      filled_[static_cast<std::size_t>(cube)] = holds(middle) ? 1 : 0;
    });
  }

  BodyPieces pieces() const {
    BodyPieces all;
    for_each([&](long cube, const Point& middle) {
      if (is_at_face(cube))
        add_samples(middle, all.pieces);
      else if (filled(cube))
        all.pieces.push_back({middle, std::pow(side_, dim_)});
      if (!filled(cube)) return;
      for (std::size_t k = 0; k < dim_; ++k)
        for (const long step : {-1L, 1L})
          if (!filled(cube + step * stride_[k])) all.face_points.push_back(face_point(middle, k, step));
    });
    return all;
  }

 private:
  bool holds(const Point& x) const {
    const Point place = frame_.from(x);
    const auto any_holds = [&](const std::vector<Shape>& shapes) {
      return std::ranges::any_of(shapes,
                                 [&](const Shape& shape) { return shape->holds(place, frame_.dim, 0); });
    };
    return any_holds(frame_.body.shapes) && !any_holds(frame_.body.without);
  }
  bool filled(long cube) const { return filled_[static_cast<std::size_t>(cube)] != 0; }
  template <class Visit>
  void for_each(const Visit& visit) const {
    long cube = 0;
    for (long k = 0; k < number_[2]; ++k)
      for (long j = 0; j < number_[1]; ++j)
        for (long i = 0; i < number_[0]; ++i, ++cube) {
          const std::array<long, 3> at{i, j, k};
          Point middle{};
          for (std::size_t a = 0; a < dim_; ++a)
            middle[a] = low_[a] + (static_cast<double>(at[a]) + 0.5) * side_;
          visit(cube, middle);
        }
  }
  bool is_at_face(long cube) const {
    for (std::size_t k = 0; k < dim_; ++k)
      for (const long other : {cube - stride_[k], cube + stride_[k]})
        if (other >= 0 && other < std::ssize(filled_) && filled(other) != filled(cube)) return true;
    return false;
  }
  void add_samples(const Point& middle, std::vector<BodyPieces::Piece>& pieces) const {
    const int along = dim_ == 3 ? 3 : 4, of_z = dim_ == 3 ? along : 1;
    BodyPieces::Piece piece;
    for (int c = 0; c < of_z; ++c)
      for (int b = 0; b < along; ++b)
        for (int a = 0; a < along; ++a) {
          const std::array<int, 3> n{a, b, c};
          Point x = middle;
          for (std::size_t k = 0; k < dim_; ++k) x[k] += ((n[k] + 0.5) / along - 0.5) * side_;
          if (!holds(x)) continue;
          piece.volume += 1;
          for (std::size_t k = 0; k < dim_; ++k) piece.x[k] += x[k];
        }
    if (piece.volume == 0) return;
    for (std::size_t k = 0; k < dim_; ++k) piece.x[k] /= piece.volume;
    piece.volume *= std::pow(side_ / along, dim_);
    pieces.push_back(piece);
  }
  Point face_point(const Point& middle, std::size_t axis, long step) const {
    constexpr int halvings = 12;
    double in = 0, out = 1;
    Point x = middle;
    for (int n = 0; n < halvings; ++n) {
      const double between = 0.5 * (in + out);
      x[axis] = middle[axis] + between * static_cast<double>(step) * side_;
      (holds(x) ? in : out) = between;
    }
    return x;
  }

  const LatticeFrame& frame_;
  std::size_t dim_;
  double side_ = 1.0 / BodyPieces::along_spacing(frame_.dim);
  Point low_{};
  std::array<long, 3> number_{1, 1, 1}, stride_{1, 1, 1};
  std::vector<unsigned char> filled_;
};

}  // namespace

Point LatticeFrame::from(const Point& x) const {
  Point place = body.shapes.front()->anchor();
  for (std::size_t k = 0; k < as_index(dim); ++k) place[k] += x[k] * dp;
  return body.shapes.front()->from_lattice(place);
}

Point LatticeFrame::to(const Point& place) const {
  const Point along = body.shapes.front()->to_lattice(place), anchor = body.shapes.front()->anchor();
  Point x{};
  for (std::size_t k = 0; k < as_index(dim); ++k) x[k] = (along[k] - anchor[k]) / dp;
  return x;
}

BodyPieces make_pieces(const LatticeFrame& frame, const Bounds& box) { return Cubes(frame, box).pieces(); }

}  // namespace taut
