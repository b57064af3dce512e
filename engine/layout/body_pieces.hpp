#pragma once

#include <vector>

#include "engine/scene/scene.hpp"

namespace taut {

/// Coordinates along a body's lattice, in spacings from the first shape's anchor.
struct LatticeFrame {
  const Body& body;
  int dim;
  double dp;  // m

  Point from(const Point& x) const;  // place, m
  Point to(const Point& place) const;
};

/// Small cubes that fill a body, and points on its faces, in a LatticeFrame.
struct BodyPieces {
  static int along_spacing(int dim) { return dim == 3 ? 4 : 8; }  // cubes per spacing

  struct Piece {
    Point x{};          // centre of mass
    double volume = 0;  // spacings^dim
  };
  std::vector<Piece> pieces;
  std::vector<Point> face_points;
};

/// `box`: bounds along the lattice axes, m. Details smaller than a cube are lost.
BodyPieces make_pieces(const LatticeFrame& frame, const Bounds& box);

}  // namespace taut
