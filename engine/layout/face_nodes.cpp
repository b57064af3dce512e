#include "engine/layout/face_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "engine/core/index.hpp"

namespace taut {
namespace {

// in spacings
constexpr double least_reach = 2, greatest_reach = 4, reach_step = 0.25;
/// Limit of Σ weight²; at lattice faces the sum is at most 2.5.
constexpr double greatest_square = 3;

}  // namespace

NodeWeights::NodeWeights(const InitialParticles& initial, int body, double dp) : initial_(initial), dp_(dp) {
  for (int i = initial.first[as_index(body)]; i < initial.first[as_index(body) + 1]; ++i)
    cells_[cell_of(initial.x[as_index(i)])].push_back(i);
}

NodeWeights::Cell NodeWeights::cell_of(const Point& x) const {
  Cell cell{};
  for (std::size_t k = 0; k < as_index(initial_.dim); ++k)
    cell[k] = static_cast<long>(std::floor(x[k] / (greatest_reach * dp_)));
  return cell;
}

std::vector<int> NodeWeights::near(const Point& x) const {
  std::vector<int> found;
  const Cell middle = cell_of(x);
  const long depth = initial_.dim == 3 ? 1 : 0;
  for (long dz = -depth; dz <= depth; ++dz)
    for (long dy = -1; dy <= 1; ++dy)
      for (long dx = -1; dx <= 1; ++dx)
        if (const auto cell = cells_.find({middle[0] + dx, middle[1] + dy, middle[2] + dz});
            cell != cells_.end())
          std::ranges::copy_if(cell->second, std::back_inserter(found), [&](int i) {
            return distance_between(initial_.x[as_index(i)], x, initial_.dim) < greatest_reach * dp_;
          });
  std::ranges::sort(found);
  return found;
}

std::vector<PointWeight> NodeWeights::shares_of(const Point& x) const {
  const std::vector<int> around = linked_to_nearest(initial_.x, near(x), x, link_of_neighbors * dp_);
  std::vector<Point> places;
  for (const int i : around) places.push_back(initial_.x[as_index(i)]);
  std::vector<PointWeight> best;
  double least = 0;
  for (double reach = least_reach; reach <= greatest_reach; reach += reach_step) {
    std::vector<PointWeight> shares =
        material_point(places, 0, static_cast<int>(places.size()), x, reach * dp_, initial_.dim);
    double square = 0;
    for (const PointWeight& share : shares) square += share.weight * share.weight;
    if (shares.empty() || (!best.empty() && square >= least)) continue;
    best = std::move(shares);
    least = square;
    if (least <= greatest_square) break;
  }
  for (PointWeight& share : best) share.particle = around[as_index(share.particle)];
  return best;
}

}  // namespace taut
