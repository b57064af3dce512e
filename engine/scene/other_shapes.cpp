#include "engine/scene/other_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/scene/shape_members.hpp"

namespace taut {
namespace {

std::size_t at(int dim) { return static_cast<std::size_t>(dim); }

/// W of the radius 2 at r = 0 … 2, over W(0): the cubic spline.
double spline(double r) {
  if (r >= 2) return 0;
  return r < 1 ? 1 - 1.5 * r * r + 0.75 * r * r * r : 0.25 * (2 - r) * (2 - r) * (2 - r);
}

/// So that the faces of what it holds are found wherever they are: with a border of two squares.
PlaceGrid grid_over(const Bounds& box, double pitch) {
  PlaceGrid grid{.low = {box.low[0] - 2 * pitch, box.low[1] - 2 * pitch, 0}, .pitch = pitch};
  grid.columns = static_cast<long>(std::ceil((box.high[0] - box.low[0]) / pitch)) + 5;
  grid.rows = static_cast<long>(std::ceil((box.high[1] - box.low[1]) / pitch)) + 5;
  return grid;
}

std::vector<Chain> all_evenly_spaced(const std::vector<Chain>& chains, double dp) {
  std::vector<Chain> result;
  for (const Chain& chain : chains) result.push_back(evenly_spaced(chain, dp));
  return result;
}

}  // namespace

Bounds Ellipse::bounds() const {
  Bounds box{centre, centre};
  for (std::size_t k = 0; k < semi_axes.size(); ++k) box.low[k] -= semi_axes[k], box.high[k] += semi_axes[k];
  return box;
}

bool Ellipse::holds(const Point& x, int dim, double tolerance) const {
  double squared = 0, slope = 0;  // (r/r_face)², and its half gradient squared
  for (std::size_t k = 0; k < at(dim); ++k) {
    const double d = (x[k] - centre[k]) / semi_axes[k];
    squared += d * d;
    slope += d * d / (semi_axes[k] * semi_axes[k]);
  }
  // (√squared − 1) over the length of its gradient, √(slope/squared)
  return squared - std::sqrt(squared) <= tolerance * std::sqrt(slope);
}

double Ellipse::measure(int dim) const {
  double product = measure_of_ball(dim, 1);
  for (std::size_t k = 0; k < at(dim); ++k) product *= semi_axes[k];
  return product;
}

double Ellipse::thinnest(int dim) const {
  return 2 * *std::min_element(semi_axes.begin(), semi_axes.begin() + dim);
}

std::vector<Chain> Ellipse::outline(int dim, double dp) const {
  if (dim != 2) return {};
  const auto place = [&](double angle) {
    return Point{centre[0] + semi_axes[0] * std::cos(angle), centre[1] + semi_axes[1] * std::sin(angle), 0};
  };
  constexpr double whole = 2 * std::numbers::pi, fine = 16;
  const double greatest = std::max(semi_axes[0], semi_axes[1]);
  const long steps = std::max(64L, std::lround(fine * whole * greatest / dp));
  std::vector<double> way = {0};  // along the face, m
  for (long k = 0; k < steps; ++k) {
    const double step = whole / static_cast<double>(steps), angle = static_cast<double>(k) * step;
    way.push_back(way.back() + distance_between(place(angle), place(angle + step), 2));
  }
  const long n = std::max(3L, std::lround(way.back() / dp));
  Chain chain;
  std::size_t step = 0;
  for (long k = 0; k < n; ++k) {
    const double along = way.back() * static_cast<double>(k) / static_cast<double>(n);
    while (way[step + 1] <= along) ++step;
    const double part = (along - way[step]) / (way[step + 1] - way[step]);
    chain.push_back(place(whole * (static_cast<double>(step) + part) / static_cast<double>(steps)));
  }
  return {chain};
}

Bounds Implicit::bounds() const {
  Bounds box = within.bounds();
  for (std::size_t k = 0; k < by.size(); ++k) box.low[k] += by[k], box.high[k] += by[k];
  return box;
}

bool Implicit::holds(const Point& x, int dim, double tolerance) const {
  const auto is_in = [&](const Point& place, double beside) {
    Point y = place;
    for (std::size_t k = 0; k < at(dim); ++k) y[k] -= by[k];
    return within.holds(y, dim, beside) && inside && inside(y) != 0;
  };
  const bool in = is_in(x, tolerance);
  if (tolerance == 0 || in == (tolerance > 0)) return in;
  for (std::size_t k = 0; k < at(dim); ++k) {
    for (const double side : {-tolerance, tolerance}) {
      Point beside = x;
      beside[k] += side;
      if (is_in(beside, 0) == (tolerance > 0)) return tolerance > 0;
    }
  }
  return in;
}

std::vector<Chain> Implicit::outline(int dim, double dp) const {
  if (dim != 2) return {};
  const auto is_in = [&](const Point& x) { return holds(x, 2, 0); };
  return all_evenly_spaced(contours(grid_over(bounds(), 0.25 * dp), is_in), dp);
}

Point Turned::back(const Point& x) const {
  return rotated({rotation.axis, rotation.about, -rotation.angle}, x);
}

Bounds Turned::bounds() const {
  return bounds_of_placed(bounds_of(shape), [&](const Point& x) { return rotated(rotation, x); });
}

bool Turned::holds(const Point& x, int dim, double tolerance) const {
  return taut::holds(shape, back(x), dim, tolerance);
}

double Turned::measure(int dim) const { return measure_of(shape, dim); }
double Turned::thinnest(int dim) const { return thinnest_of(shape, dim); }
Point Turned::middle() const { return rotated(rotation, middle_of(shape)); }
Point Turned::anchor() const { return anchor_of(shape); }

void Turned::shift(std::size_t axis, double by) {
  taut::shift(shape, axis, by);
  rotation.about[axis] += by;
}

std::vector<InitialSite> Turned::sites(int dim, double dp) const {
  std::vector<InitialSite> sites = sites_of(shape, dim, dp);
  for (InitialSite& site : sites) site.x = rotated(rotation, site.x);
  return sites;
}

std::vector<Chain> Turned::outline(int dim, double dp) const {
  std::vector<Chain> chains = outline_of(shape, dim, dp);
  for (Chain& chain : chains)
    for (Point& x : chain) x = rotated(rotation, x);
  return chains;
}

FacePatches Turned::patches(double dp) const {
  FacePatches faces = patches_of(shape, dp);
  for (Point& x : faces.node) x = rotated(rotation, x);
  return faces;
}

Point Turned::from_lattice(const Point& x) const { return rotated(rotation, taut::from_lattice(shape, x)); }
Point Turned::to_lattice(const Point& x) const { return taut::to_lattice(shape, back(x)); }
Bounds Turned::lattice_bounds() const { return lattice_bounds_of(shape); }

Bounds Combined::bounds() const {
  Bounds box = bounds_of(shapes.front());
  if (how == Combination::difference) return box;
  for (const Shape& shape : shapes) {
    const Bounds other = bounds_of(shape);
    if (how == Combination::together) {
      box = joined(box, other);
      continue;
    }
    for (std::size_t k = 0; k < box.low.size(); ++k) {
      box.low[k] = std::max(box.low[k], other.low[k]);
      box.high[k] = std::max(box.low[k], std::min(box.high[k], other.high[k]));
    }
  }
  return box;
}

bool Combined::holds(const Point& x, int dim, double tolerance) const {
  const auto holds_it = [&](const Shape& shape) { return taut::holds(shape, x, dim, tolerance); };
  switch (how) {
    case Combination::together:
      return std::ranges::any_of(shapes, holds_it);
    case Combination::common:
      return std::ranges::all_of(shapes, holds_it);
    case Combination::difference:
      break;
  }
  return holds_it(shapes.front()) && std::none_of(shapes.begin() + 1, shapes.end(), [&](const Shape& shape) {
           return taut::holds(shape, x, dim, -tolerance);
         });
}

double Combined::measure(int dim) const {
  double measure = measure_of(shapes.front(), dim);
  if (how == Combination::difference) return measure;
  for (std::size_t k = 1; k < shapes.size(); ++k) {
    const double other = measure_of(shapes[k], dim);
    measure = how == Combination::together ? measure + other : std::min(measure, other);
  }
  return measure;
}

double Combined::thinnest(int dim) const { return thinnest_of(shapes.front(), dim); }
Point Combined::middle() const { return middle_of(shapes.front()); }
Point Combined::anchor() const { return anchor_of(shapes.front()); }

void Combined::shift(std::size_t axis, double by) {
  for (Shape& shape : shapes) taut::shift(shape, axis, by);
}

std::vector<Chain> Combined::outline(int dim, double dp) const {
  if (dim != 2) return {};
  constexpr double finely = 0.125;  // where faces of curves cross they are as good as their chords
  std::vector<std::vector<Chain>> solids;
  for (const Shape& shape : shapes) solids.push_back(outline_of(shape, dim, finely * dp));
  return all_evenly_spaced(combined(how, solids, dp), dp);
}

Point Combined::from_lattice(const Point& x) const { return taut::from_lattice(shapes.front(), x); }
Point Combined::to_lattice(const Point& x) const { return taut::to_lattice(shapes.front(), x); }

Bounds Combined::lattice_bounds() const {
  return how == Combination::together
             ? bounds_of_placed(bounds(), [&](const Point& x) { return to_lattice(x); })
             : lattice_bounds_of(shapes.front());
}

GivenParticles::GivenParticles(std::vector<Point> places, std::vector<double> volumes, int dim)
    : places_(std::move(places)), volumes_(std::move(volumes)) {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const double size = std::pow(volumes_[i], 1.0 / dim);
    Bounds cell{places_[i], places_[i]};
    for (std::size_t k = 0; k < at(dim); ++k) cell.low[k] -= 0.5 * size, cell.high[k] += 0.5 * size;
    box_ = i == 0 ? cell : joined(box_, cell);
    volume_ += volumes_[i];
    size_ = std::max(size_, size);
  }
  for (std::size_t i = 0; i < places_.size(); ++i)
    sorted_.emplace_back(cell_of(places_[i]), static_cast<int>(i));
  std::ranges::sort(sorted_);
}

Bounds GivenParticles::bounds() const {
  Bounds box = box_;
  for (std::size_t k = 0; k < by_.size(); ++k) box.low[k] += by_[k], box.high[k] += by_[k];
  return box;
}

std::array<long, 3> GivenParticles::cell_of(const Point& x) const {
  constexpr double reach = 2;  // of the spline, in sizes
  std::array<long, 3> cell{};
  for (std::size_t k = 0; k < cell.size(); ++k)
    cell[k] = static_cast<long>(std::floor(x[k] / (reach * size_)));
  return cell;
}

/// Calls visit(particle) for those near x, given from where the particles were before they were moved.
template <class Visit>
void GivenParticles::around(const Point& x, const Visit& visit) const {
  const std::array<long, 3> middle = cell_of(x);
  for (long i = -1; i <= 1; ++i) {
    for (long j = -1; j <= 1; ++j) {
      const std::array<long, 3> first{middle[0] + i, middle[1] + j, middle[2] - 1};
      const std::array<long, 3> last{first[0], first[1], middle[2] + 1};
      auto found = std::ranges::lower_bound(sorted_, std::pair(first, 0));
      for (; found != sorted_.end() && found->first <= last; ++found)
        visit(static_cast<std::size_t>(found->second));
    }
  }
}

bool GivenParticles::holds(const Point& x, int dim, double tolerance) const {
  const Point y{x[0] - by_[0], x[1] - by_[1], x[2] - by_[2]};
  bool held = false;
  around(y, [&](std::size_t i) {
    const double half = 0.5 * std::pow(volumes_[i], 1.0 / dim);
    bool in = true;
    for (std::size_t k = 0; k < at(dim); ++k) in = in && std::abs(y[k] - places_[i][k]) <= half + tolerance;
    held = held || in;
  });
  return held;
}

std::vector<InitialSite> GivenParticles::sites(int, double) const {
  std::vector<InitialSite> sites;
  for (std::size_t i = 0; i < places_.size(); ++i)
    sites.push_back(
        {.x = {places_[i][0] + by_[0], places_[i][1] + by_[1], places_[i][2] + by_[2]}, .V0 = volumes_[i]});
  return sites;
}

std::vector<Chain> GivenParticles::outline(int dim, double dp) const {
  if (dim != 2) return {};
  const double half = 0.5 * 0.7 * std::numbers::pi * size_ * size_;  // of ∫ W dA, W(0) = 1 and h = size_
  const auto is_in = [&](const Point& x) {
    const Point y{x[0] - by_[0], x[1] - by_[1], 0};
    double sum = 0;
    around(y,
           [&](std::size_t i) { sum += volumes_[i] * spline(distance_between(y, places_[i], 2) / size_); });
    return sum > half;
  };
  return all_evenly_spaced(contours(grid_over(bounds(), 0.25 * dp), is_in), dp);
}

namespace {

std::optional<double> exact_measure(const Shape& shape, int dim) {
  const AnyShape* const other = std::get_if<AnyShape>(&shape);
  if (other == nullptr) return measure_of(shape, dim);
  if (const Turned* const turned = other->as<Turned>()) return exact_measure(turned->shape, dim);
  if (other->as<Implicit>() != nullptr || other->as<Combined>() != nullptr) return std::nullopt;
  return measure_of(shape, dim);
}

}  // namespace

std::optional<double> exact_measure(const Body& body, int dim) {
  if (body.shapes.size() != 1 || !body.without.empty()) return std::nullopt;
  return exact_measure(body.shapes[0], dim);
}

}  // namespace taut
