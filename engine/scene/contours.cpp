#include "engine/scene/contours.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>

#include <clipper.hpp>

namespace taut {
namespace {

double distance_to_segment(const Point& x, const Point& a, const Point& b) {
  const double length = distance_between(a, b, 2);
  if (!(length > 0)) return distance_between(x, a, 2);
  const double along = ((x[0] - a[0]) * (b[0] - a[0]) + (x[1] - a[1]) * (b[1] - a[1])) / (length * length);
  const double share = std::clamp(along, 0.0, 1.0);
  return distance_between(x, {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), 0}, 2);
}

class March {
 public:
  March(const PlaceGrid& grid, const std::function<bool(long, long)>& inside,
        const std::function<Point(const Point&, const Point&)>& face)
      : columns_(grid.columns + 2), rows_(grid.rows + 2) {
    for (long j = 0; j < rows_; ++j)
      for (long i = 0; i < columns_; ++i)
        inside_.push_back(i > 0 && j > 0 && i < columns_ - 1 && j < rows_ - 1 && inside(i - 1, j - 1));
    for (long j = 0; j + 1 < rows_; ++j)
      for (long i = 0; i + 1 < columns_; ++i) visit(grid, face, i, j);
  }

  std::vector<Chain> chains() {
    std::vector<Chain> result;
    while (!next_.empty()) {
      Chain chain;
      for (auto found = next_.begin(); found != next_.end();) {
        chain.push_back(found->second.from);
        const long to = found->second.to;
        next_.erase(found);
        found = next_.find(to);
      }
      result.push_back(std::move(chain));
    }
    return result;
  }

 private:
  struct Way {
    Point from{};
    long to = 0;
  };

  /// On an anticlockwise path around a square, each exit from the solid begins a face that ends at the preceding
  /// entry.
  void visit(const PlaceGrid& grid, const std::function<Point(const Point&, const Point&)>& face, long i,
             long j) {
    constexpr std::array<std::array<long, 2>, 4> corners = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    const auto corner = [&](std::size_t k) {
      return std::array{i + corners[k % 4][0], j + corners[k % 4][1]};
    };
    const auto is_in = [&](std::size_t k) {
      return inside_[static_cast<std::size_t>(corner(k)[1] * columns_ + corner(k)[0])] != 0;
    };
    const std::array<long, 4> side = {2 * (j * columns_ + i), 2 * (j * columns_ + i + 1) + 1,
                                      2 * ((j + 1) * columns_ + i), 2 * (j * columns_ + i) + 1};
    for (std::size_t k = 0; k < 4; ++k) {
      if (!is_in(k) || is_in(k + 1)) continue;
      std::size_t end = k + 3;
      while (is_in(end) || !is_in(end + 1)) --end;
      const Point from = grid.at(corner(k)[0] - 1, corner(k)[1] - 1);
      const Point to = grid.at(corner(k + 1)[0] - 1, corner(k + 1)[1] - 1);
      next_[side[k]] = {face(from, to), side[end % 4]};
    }
  }

  long columns_, rows_;
  std::vector<char> inside_;
  std::map<long, Way> next_;
};

void mark(const Chain& chain, std::size_t first, std::size_t last, double tolerance,
          std::vector<char>& stays) {
  std::vector<std::array<std::size_t, 2>> open = {{first, last}};
  const std::size_t n = chain.size();
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    double greatest = tolerance;
    std::size_t farthest = 0;
    for (std::size_t k = from + 1; k < to; ++k) {
      const double beside = distance_to_segment(chain[k % n], chain[from % n], chain[to % n]);
      if (beside > greatest) greatest = beside, farthest = k;
    }
    if (farthest == 0) continue;
    stays[farthest % n] = 1;
    open.push_back({from, farthest});
    open.push_back({farthest, to});
  }
}

std::vector<char> points_that_stay(const Chain& chain, double tolerance) {
  std::vector<char> stays(chain.size());
  const auto farthest_from = [&](const Point& x) {
    std::size_t far = 0;
    for (std::size_t k = 0; k < chain.size(); ++k)
      if (distance_between(chain[k], x, 2) > distance_between(chain[far], x, 2)) far = k;
    return far;
  };
  const std::size_t one = farthest_from(chain.front()), other = farthest_from(chain[one]);
  const std::size_t first = std::min(one, other), last = std::max(one, other);
  stays[first] = stays[last] = 1;
  mark(chain, first, last, tolerance, stays);
  mark(chain, last, first + chain.size(), tolerance, stays);
  return stays;
}

std::vector<std::size_t> corners_of(const Chain& chain, const std::vector<char>& stays) {
  constexpr double sharp = 40 * std::numbers::pi / 180;
  std::vector<std::size_t> kept, corners;
  for (std::size_t k = 0; k < chain.size(); ++k)
    if (stays[k]) kept.push_back(k);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const Point &before = chain[kept[(k + kept.size() - 1) % kept.size()]], &at = chain[kept[k]],
                &after = chain[kept[(k + 1) % kept.size()]];
    const double ahead = (at[0] - before[0]) * (after[0] - at[0]) + (at[1] - before[1]) * (after[1] - at[1]);
    if (std::abs(std::atan2(turn(before, at, after), ahead)) > sharp) corners.push_back(kept[k]);
  }
  return corners;
}

void add_evenly(const Chain& chain, std::size_t from, std::size_t to, double dp, std::size_t least,
                Chain& result) {
  const std::size_t n = chain.size();
  std::vector<double> way = {0};
  for (std::size_t k = from; k < to; ++k)
    way.push_back(way.back() + distance_between(chain[k % n], chain[(k + 1) % n], 2));
  const std::size_t pieces =
      std::max(least, static_cast<std::size_t>(std::max(1L, std::lround(way.back() / dp))));
  std::size_t k = 0;
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    const double at = way.back() * static_cast<double>(piece) / static_cast<double>(pieces);
    while (k + 2 < way.size() && way[k + 1] <= at) ++k;
    const double length = way[k + 1] - way[k], share = length > 0 ? (at - way[k]) / length : 0;
    const Point &a = chain[(from + k) % n], &b = chain[(from + k + 1) % n];
    result.push_back({a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), 0});
  }
}

PlaceGrid grid_over(const Bounds& box, double pitch) {
  PlaceGrid grid{.low = {box.low[0] - 2 * pitch, box.low[1] - 2 * pitch, 0}, .pitch = pitch};
  grid.columns = static_cast<long>(std::ceil((box.high[0] - box.low[0]) / pitch)) + 5;
  grid.rows = static_cast<long>(std::ceil((box.high[1] - box.low[1]) / pitch)) + 5;
  return grid;
}

}  // namespace

double turn(const Point& o, const Point& a, const Point& b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

std::vector<Chain> contours(const PlaceGrid& grid, const std::function<bool(long, long)>& inside,
                            const std::function<Point(const Point&, const Point&)>& face) {
  return March(grid, inside, face).chains();
}

std::vector<Chain> contours(const PlaceGrid& grid, const std::function<bool(const Point&)>& inside) {
  const auto middle = [](const Point& a, const Point& b) {
    return Point{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0};
  };
  const auto face = [&](Point in, Point out) {
    constexpr int halvings = 30;
    for (int k = 0; k < halvings; ++k) {
      const Point between = middle(in, out);
      (inside(between) ? in : out) = between;
    }
    return middle(in, out);
  };
  return contours(
      grid, [&](long i, long j) { return inside(grid.at(i, j)); }, face);
}

Chain simplified(const Chain& chain, double tolerance) {
  const std::vector<char> stays = points_that_stay(chain, tolerance);
  Chain result;
  for (std::size_t k = 0; k < chain.size(); ++k)
    if (stays[k]) result.push_back(chain[k]);
  return result;
}

Chain evenly_spaced(const Chain& chain, double dp) {
  const std::vector<std::size_t> corners = corners_of(chain, points_that_stay(chain, 0.1 * dp));
  Chain result;
  const std::size_t n = chain.size(), least = corners.size() < 3 ? 4 - corners.size() : 1;
  if (corners.empty()) add_evenly(chain, 0, n, dp, 3, result);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const bool last = k + 1 == corners.size();
    add_evenly(chain, corners[k], last ? corners[0] + n : corners[k + 1], dp, least, result);
  }
  return result;
}

std::vector<Chain> evenly_spaced(const std::vector<Chain>& chains, double dp) {
  std::vector<Chain> result;
  for (const Chain& chain : chains) result.push_back(evenly_spaced(chain, dp));
  return result;
}

std::vector<Chain> evenly_spaced_contours(const Bounds& box, const std::function<bool(const Point&)>& inside,
                                          double dp) {
  return evenly_spaced(contours(grid_over(box, 0.25 * dp), inside), dp);
}

std::vector<Chain> combined(Combination how, const std::vector<std::vector<Chain>>& solids, double dp) {
  using namespace ClipperLib;
  const double unit = std::ldexp(dp, -16);
  const auto paths_of = [&](const std::vector<Chain>& chains) {
    Paths paths;
    for (const Chain& chain : chains) {
      paths.emplace_back();
      for (const Point& x : chain)
        paths.back().emplace_back(std::llround(x[0] / unit), std::llround(x[1] / unit));
    }
    return paths;
  };
  const auto with = [](ClipType type, const Paths& a, const Paths& b) {
    Clipper clipper;
    clipper.AddPaths(a, ptSubject, true);
    clipper.AddPaths(b, ptClip, true);
    Paths result;
    clipper.Execute(type, result, pftNonZero, pftNonZero);
    return result;
  };
  const ClipType type = how == Combination::together ? ctUnion
                        : how == Combination::common ? ctIntersection
                                                     : ctDifference;
  Paths paths;
  for (std::size_t k = 0; k < solids.size(); ++k)
    paths = k == 0 ? paths_of(solids[k]) : with(type, paths, paths_of(solids[k]));
  // slivers between chords of coincident curved faces
  constexpr double thin = 0.1;  // of dp
  std::erase_if(paths, [&](const Path& path) {
    double around = 0;
    for (std::size_t k = 0; k < path.size(); ++k) {
      const IntPoint &x = path[k], &next = path[(k + 1) % path.size()];
      around += std::hypot(static_cast<double>(next.X - x.X), static_cast<double>(next.Y - x.Y));
    }
    return std::abs(Area(path)) < 0.5 * around * thin * dp / unit;
  });
  std::vector<Chain> chains;
  for (const Path& path : paths) {
    Chain chain;
    for (const IntPoint& x : path)
      chain.push_back({static_cast<double>(x.X) * unit, static_cast<double>(x.Y) * unit, 0});
    chains.push_back(std::move(chain));
  }
  return chains;
}

}  // namespace taut
