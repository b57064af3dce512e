#include "engine/layout/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

#include "engine/core/index.hpp"
#include "engine/layout/body_pieces.hpp"
#include "engine/layout/point_grid.hpp"

namespace taut {
namespace {

// lengths in spacings
constexpr int layers = 3;
constexpr int steps = 8;        // more steps turn rows inside into hexagonal grains
constexpr double beside = 0.6;  // least distance of a new layer to existing particles
/// Least distance of a hole to all particles.
double hole(int dim) { return 0.6 * std::sqrt(dim); }
constexpr double least_depth_of_hole = 0.35;

struct VoronoiCell {
  double volume = 0;
  Point middle{};  // centre of mass
};

/// Indices of candidates at least `apart` from each other, preferably near those already picked, for dense rows.
std::vector<int> picked(const PointGrid& candidates, const std::vector<int>& component, double apart) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::vector<double> distance(candidates.points().size(), infinite);
  std::vector<bool> done(distance.size(), true);
  for (const int i : component) done[as_index(i)] = false;
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> next;
  std::vector<int> all;
  for (const int first : component) {
    next.emplace(0, first);
    while (!next.empty()) {
      const int i = next.top().second;
      next.pop();
      if (done[as_index(i)]) continue;
      done[as_index(i)] = true;
      all.push_back(i);
      candidates.around(candidates[i], 2, [&](int j, double r) {
        if (done[as_index(j)]) return;
        if (r < apart) {
          done[as_index(j)] = true;
        } else if (r < distance[as_index(j)] && r < 2 * apart) {
          next.emplace(distance[as_index(j)] = r, j);
        }
      });
    }
  }
  return all;
}

class Relaxation {
 public:
  Relaxation(BodyPieces body, std::vector<Point> lattice, int dim)
      : body_(std::move(body)), x_(std::move(lattice)), dim_(dim), faces_(body_.face_points, dim) {}

  /// Returns false if the lattice fits all faces.
  bool run() {
    if (!arrange_at_faces()) return false;
    for (int step = 0; step < steps; ++step) move_to_middles(cells());
    drop_tips();
    return true;
  }
  const std::vector<Point>& places() const { return x_; }
  std::vector<VoronoiCell> cells() const {
    const PointGrid grid(x_, dim_);
    std::vector<VoronoiCell> cells(x_.size());
    for (const BodyPieces::Piece& piece : body_.pieces) {
      const int i = grid.nearest(piece.x, farthest).index;
      if (i < 0) continue;
      VoronoiCell& cell = cells[as_index(i)];
      cell.volume += piece.volume;
      for (std::size_t k = 0; k < as_index(dim_); ++k) cell.middle[k] += piece.volume * piece.x[k];
    }
    for (std::size_t i = 0; i < cells.size(); ++i)
      for (std::size_t k = 0; k < as_index(dim_); ++k)
        cells[i].middle[k] = cells[i].volume > 0 ? cells[i].middle[k] / cells[i].volume : x_[i][k];
    return cells;
  }

 private:
  static constexpr long farthest = 4;  // from a place in the body to a particle

  bool arrange_at_faces() {
    const PointGrid lattice(x_, dim_);
    const std::vector<VoronoiCell> cells_of_lattice = cells();
    const auto fits = [&](int i) {
      constexpr double alike = 0.01;
      const VoronoiCell& cell = cells_of_lattice[as_index(i)];
      return std::abs(cell.volume - 1) < alike && distance_between(cell.middle, lattice[i], dim_) < alike;
    };
    std::vector<Point> off_lattice;
    for (const Point& x : body_.face_points)
      if (const int i = lattice.nearest(x, farthest).index; i < 0 || !fits(i)) off_lattice.push_back(x);
    if (off_lattice.empty()) return false;
    const PointGrid cut_faces(std::move(off_lattice), dim_);
    std::erase_if(x_, [&](const Point& x) { return cut_faces.nearest(x, layers).index >= 0; });
    std::vector<Layered> layered;
    for (const BodyPieces::Piece& piece : body_.pieces)
      if (cut_faces.nearest(piece.x, layers).index >= 0)
        layered.push_back({piece, faces_.nearest(piece.x, layers)});
    for (int layer = 0; layer < layers; ++layer) add_layer(layer, layered);
    fill_holes(layered);
    return true;
  }

  struct Layered {
    BodyPieces::Piece piece;
    PointGrid::Found face;
  };

  void add_layer(int layer, const std::vector<Layered>& layered) {
    const double depth = layer + 0.5, thin = 0.75 / BodyPieces::along_spacing(dim_);
    const PointGrid others(x_, dim_);
    std::vector<Point> places;
    std::vector<BodyPieces::Piece> pieces;
    for (const Layered& one : layered) {
      const double d = one.face.distance;
      if (d >= layer && d < layer + 1) pieces.push_back(one.piece);
      if (std::abs(d - depth) > thin) continue;
      Point x = one.piece.x;
      for (std::size_t k = 0; k < as_index(dim_); ++k)
        x[k] += (depth / d - 1) * (x[k] - faces_[one.face.index][k]);
      if (others.nearest(x, 1).distance > beside) places.push_back(x);
    }
    const PointGrid candidates(std::move(places), dim_);
    const std::vector<int> component = components(candidates);
    std::vector<std::vector<int>> members;
    std::vector<double> volume;
    for (std::size_t i = 0; i < component.size(); ++i) {
      if (as_index(component[i]) == members.size()) members.emplace_back(), volume.push_back(0);
      members[as_index(component[i])].push_back(static_cast<int>(i));
    }
    for (const BodyPieces::Piece& piece : pieces)
      if (const int i = candidates.nearest(piece.x, 2).index; i >= 0)
        volume[as_index(component[as_index(i)])] += piece.volume;
    for (std::size_t c = 0; c < members.size(); ++c)
      for (const int i : even_row(candidates, members[c], std::round(volume[c]))) x_.push_back(candidates[i]);
  }
  /// At least `wanted` candidates, as far apart as possible; fewer if they would be closer than 0.7.
  static std::vector<int> even_row(const PointGrid& candidates, const std::vector<int>& members,
                                   double wanted) {
    double low = 0.7, high = 1.4;
    std::vector<int> best = picked(candidates, members, low);
    for (int halving = 0; halving < 10; ++halving) {
      const double apart = 0.5 * (low + high);
      std::vector<int> some = picked(candidates, members, apart);
      const bool enough = static_cast<double>(some.size()) >= wanted;
      (enough ? low : high) = apart;
      if (enough) best = std::move(some);
    }
    return best;
  }
  /// [candidate] number of its connected part.
  static std::vector<int> components(const PointGrid& candidates) {
    constexpr double linked = 0.5;
    std::vector<int> component(candidates.points().size(), -1), open;
    int number = 0;
    for (std::size_t first = 0; first < component.size(); ++first) {
      if (component[first] >= 0) continue;
      component[first] = number;
      open.push_back(static_cast<int>(first));
      while (!open.empty()) {
        const int i = open.back();
        open.pop_back();
        candidates.around(candidates[i], 1, [&](int j, double r) {
          if (r > linked || component[as_index(j)] >= 0) return;
          component[as_index(j)] = number;
          open.push_back(j);
        });
      }
      ++number;
    }
    return component;
  }
  void fill_holes(const std::vector<Layered>& layered) {
    const PointGrid grid(x_, dim_);
    std::vector<std::pair<double, const Point*>> places;
    for (const Layered& one : layered) {
      const double distance = grid.nearest(one.piece.x, farthest).distance;
      if (distance > hole(dim_) && one.face.distance > least_depth_of_hole)
        places.emplace_back(distance, &one.piece.x);
    }
    std::ranges::stable_sort(places, std::greater<>(), [](const auto& place) { return place.first; });
    std::vector<Point> added;
    for (const auto& [distance, x] : places)
      if (std::ranges::all_of(added,
                              [&](const Point& y) { return distance_between(y, *x, dim_) > hole(dim_); }))
        added.push_back(*x);
    x_.insert(x_.end(), added.begin(), added.end());
  }
  /// Methods need neighbours that span the space.
  void drop_tips() {
    constexpr int most = 3;
    constexpr double near = 1.5;
    for (int round = 0; round < most; ++round) {
      const PointGrid grid(x_, dim_);
      std::erase_if(x_, [&](const Point& x) {
        int neighbors = -1;  // without x
        grid.around(x, 2, [&](int, double r) { neighbors += r < near; });
        return neighbors < dim_;
      });
    }
  }
  /// Particles of lattice cells stay exactly on the lattice.
  void move_to_middles(const std::vector<VoronoiCell>& cells) {
    constexpr double least = 1e-6;
    for (std::size_t i = 0; i < x_.size(); ++i)
      if (distance_between(x_[i], cells[i].middle, dim_) > least) x_[i] = cells[i].middle;
  }

  BodyPieces body_;
  std::vector<Point> x_;
  int dim_;
  PointGrid faces_;
};

/// In m^dim.
double body_volume(const Body& body, int dim, double of_pieces) {
  const Shape& first = body.shapes.front();
  return body.shapes.size() == 1 && body.without.empty() && first->has_exact_measure() ? first->measure(dim)
                                                                                       : of_pieces;
}

}  // namespace

void relax(std::vector<InitialSite>& sites, const Body& body, const Bounds& box, int dim, double dp) {
  if (sites.empty()) return;
  const LatticeFrame frame{body, dim, dp};
  std::vector<Point> lattice;
  for (const InitialSite& site : sites) lattice.push_back(frame.to(site.x));
  Relaxation relaxation(make_pieces(frame, box), std::move(lattice), dim);
  if (!relaxation.run()) return;
  const std::vector<VoronoiCell> cells = relaxation.cells();
  double sum = 0;
  for (const VoronoiCell& cell : cells) sum += cell.volume;
  const double of_cells = sum * std::pow(dp, dim), unit = body_volume(body, dim, of_cells) / sum;
  sites.clear();
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells[i].volume > 0)
      sites.push_back({.x = frame.from(relaxation.places()[i]), .V0 = cells[i].volume * unit});
}

}  // namespace taut
