#include "engine/solver/face_loads.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>

#include <Eigen/Eigenvalues>

namespace taut {
namespace {

constexpr int Dim = 2;  // of the scenes of this version; the code below is for 3 too
using Place = Eigen::Vector<double, Dim>;

constexpr double layer_reach = 2.1;  // dp, of what tells the direction of a layer
constexpr double aside = 0.75;       // dp, along the face, of a particle that stands below another one

constexpr double least_scaled =
    0.5;  // of its area, n · S of a column that can share a force; ends of bars have 0.95 to 1.5

Place place(const Point& p) { return Eigen::Map<const Place>(p.data()); }

Point point(const Place& v) {
  Point p{};
  for (int k = 0; k < Dim; ++k) p[k] = v[k];
  return p;
}

/// The direction in which the layer is thin, away from the rest of the body; 0 where there is none.
Place outwards(int i, const InitialParticles& initial, std::span<const int> near,
               const std::vector<int>& layer, double spacing) {
  constexpr double thin = 0.1;  // mean square across the layer over that along it
  Eigen::Matrix<double, Dim, Dim> spread = Eigen::Matrix<double, Dim, Dim>::Zero();
  Place away = Place::Zero();
  for (const int j : near) {
    const Place d = (place(initial.x[j]) - place(initial.x[i])) / spacing;
    if (d.norm() > layer_reach) continue;
    if (std::ranges::binary_search(layer, j))
      spread += d * d.transpose();
    else
      away -= d;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Dim, Dim>> axes(spread);
  const Place n = axes.eigenvectors().col(0);
  const double side = n.dot(away);
  if (!(axes.eigenvalues()[0] < thin * axes.eigenvalues()[1]) || side == 0) return Place::Zero();
  return side > 0 ? n : Place(-n);
}

/// How much longer the face is than the layer below it, from the chords to those beside i in the layer.
double stretch(const FaceLayer& layer, std::size_t k, const InitialParticles& initial,
               std::span<const int> near, double spacing) {
  double inside = 0, outside = 0;
  for (const int j : near) {
    const auto found = std::ranges::lower_bound(layer.id, j);
    if (found == layer.id.end() || *found != j) continue;
    const Place d = place(initial.x[j]) - place(initial.x[layer.id[k]]);
    if (d.norm() > layer_reach * spacing) continue;
    const Place& n = place(layer.normal[static_cast<std::size_t>(found - layer.id.begin())]);
    inside += d.norm();
    outside += (d + 0.5 * spacing * (n - place(layer.normal[k]))).norm();
  }
  return std::pow(inside > 0 ? outside / inside : 1, Dim - 1);
}

/// The particles below one of the layer, down to the middle between its face and the opposite one.
struct Column {
  bool thin = false;  // particles that feel its face may feel the opposite one
  double middle = std::numeric_limits<double>::infinity();  // m, below the particle of the layer, if thin
  double area = 0;                                          // Σ n · S, m^(dim − 1)
  int at_middle = 0;                                        // number of its particles there
};

/// The particle farthest below i, by `near`, and how far, m.
std::pair<int, double> deepest(int i, const Place& n, const InitialParticles& initial,
                               const NeighborLists& near, double spacing) {
  std::pair<int, double> known{i, 0};
  for (const int j : near[i]) {
    const Place d = place(initial.x[i]) - place(initial.x[j]);
    if ((d - d.dot(n) * n).norm() > aside * spacing) continue;
    if (d.dot(n) > known.second + 1e-6 * spacing) known = {j, d.dot(n)};
  }
  return known;
}

/// Faces are felt as far as `near` goes, so that two of them meet where they are less than twice that apart.
Column column(int i, const Place& n, const InitialParticles& initial, const NeighborLists& near,
              double spacing) {
  double depth = 0, enough = std::numeric_limits<double>::infinity();
  while (depth < enough) {
    const auto [j, step] = deepest(i, n, initial, near, spacing);
    if (step == 0) return {.thin = true, .middle = 0.5 * depth};
    if (depth == 0) enough = 2 * step - 0.5 * spacing;
    depth += step;
    i = j;
  }
  return {};
}

struct Below {
  double distance = std::numeric_limits<double>::infinity();  // m
  std::size_t k = 0;                                          // in the layer
  double depth = 0;                                           // m, along the normal
};

/// Of each free particle below the layer the nearest of the layer that stands above it.
std::map<int, Below> below(const FaceLayer& layer, const InitialParticles& initial, const NeighborLists& near,
                           double spacing) {
  std::map<int, Below> all;
  for (std::size_t k = 0; k < layer.id.size(); ++k) {
    const int i = layer.id[k];
    const Place n = place(layer.normal[k]);
    all[i] = {0, k, 0};
    for (const int j : near[i]) {
      const Place d = place(initial.x[i]) - place(initial.x[j]);
      if (initial.held[j] || (d - d.dot(n) * n).norm() > aside * spacing) continue;
      if (Below& known = all[j]; d.norm() < known.distance) known = {d.norm(), k, d.dot(n)};
    }
  }
  return all;
}

/// The nearest beside i in the direction `along`, of unit length; −1 if there is none.
int beside(int i, const Place& along, const InitialParticles& initial, std::span<const int> near,
           double spacing) {
  int found = -1;
  double least = 2 * spacing;
  for (const int j : near) {
    const Place d = place(initial.x[j]) - place(initial.x[i]);
    const double distance = d.dot(along);
    if (distance < 0.5 * spacing || distance > least || (d - distance * along).norm() > aside * spacing)
      continue;
    found = j, least = distance;
  }
  return found;
}

/// By how much more than its area each particle of the layer stands for: at a corner of the body the end correction of
/// the midpoint rule, without which the moment of a traction that is linear along the face is short by 1/n².
std::vector<double> end_weights(const FaceLayer& layer, const InitialParticles& initial,
                                const NeighborLists& near, double spacing) {
  std::vector<double> weights(layer.id.size(), 1);
  const auto position = [&](int i) {
    const auto found = std::ranges::lower_bound(layer.id, i);
    return found != layer.id.end() && *found == i ? static_cast<int>(found - layer.id.begin()) : -1;
  };
  for (std::size_t k = 0; k < layer.id.size(); ++k)
    for (const double side : {1, -1}) {
      const Place along(side * -layer.normal[k][1], side * layer.normal[k][0]);
      const int i = layer.id[k];
      if (beside(i, along, initial, near[i], spacing) >= 0) continue;
      const int second = beside(i, -along, initial, near[i], spacing),
                third = second < 0 ? -1 : beside(second, -along, initial, near[second], spacing);
      if (third < 0 || position(second) < 0 || position(third) < 0) continue;
      constexpr double share = 1.0 / 24;
      weights[k] += 1.25 * share, weights[position(second)] -= 1.5 * share,
          weights[position(third)] += 0.25 * share;
    }
  return weights;
}

}  // namespace

FaceLayer face_layer(const Load& load, const InitialParticles& initial, const NeighborLists& near,
                     std::vector<int> id, double spacing) {
  FaceLayer layer{.id = std::move(id), .normal = {}, .traction = {}, .area = {}};
  std::ranges::sort(layer.id);
  for (const int i : layer.id) {
    const Place n = outwards(i, initial, near[i], layer.id, spacing);
    if (n.isZero()) return {};
    layer.normal.push_back(point(n));
  }
  for (std::size_t k = 0; k < layer.id.size(); ++k) {
    const int i = layer.id[k];
    Point at = initial.x[i], t{};
    for (int a = 0; a < Dim; ++a) at[a] += 0.5 * spacing * layer.normal[k][a];
    for (int a = 0; a < Dim; ++a)
      if (load.value[a]) t[a] = load.value[a](at);
    layer.traction.push_back(t);
    layer.area.push_back(initial.V0[i] / spacing * stretch(layer, k, initial, near[i], spacing));
  }
  return layer;
}

std::vector<FaceShare> face_shares(FaceRule rule, const FaceLayer& layer, const InitialParticles& initial,
                                   const NeighborLists& near, const std::vector<Point>& surface,
                                   double spacing) {
  std::vector<Column> columns;
  for (std::size_t k = 0; k < layer.id.size(); ++k)
    columns.push_back(column(layer.id[k], place(layer.normal[k]), initial, near, spacing));
  const std::map<int, Below> belows = below(layer, initial, near, spacing);
  std::vector<double> whole_area = layer.area;
  if (rule == FaceRule::by_column) {
    const std::vector<double> weights = end_weights(layer, initial, near, spacing);
    for (std::size_t k = 0; k < weights.size(); ++k) whole_area[k] *= weights[k];
  }
  const auto own_area = [&](int j, const Below& b) {
    const double from_middle = b.depth - columns[b.k].middle;
    const double part = from_middle < -0.25 * spacing ? 1 : from_middle < 0.25 * spacing ? 0.5 : 0;
    return part * place(layer.normal[b.k]).dot(place(surface[j]));
  };
  const auto is_middle = [&](const Below& b) {
    return std::abs(b.depth - columns[b.k].middle) < 0.75 * spacing;
  };
  for (const auto& [j, b] : belows) {
    columns[b.k].area += own_area(j, b);
    columns[b.k].at_middle += is_middle(b);
  }
  std::vector<FaceShare> shares;
  for (const auto& [j, b] : belows) {
    const Column& c = columns[b.k];
    const double whole = whole_area[b.k];
    double area = own_area(j, b);
    if (!c.thin && rule == FaceRule::by_column)
      area = c.area > least_scaled * whole ? area * (whole / c.area) : j == layer.id[b.k] ? whole : 0;
    else if (c.thin && (c.at_middle > 0 ? is_middle(b) : j == layer.id[b.k]))
      area += (whole - c.area) / std::max(1, c.at_middle);
    if (area != 0) shares.emplace_back(j, point(area * place(layer.traction[b.k])));
  }
  return shares;
}

}  // namespace taut
