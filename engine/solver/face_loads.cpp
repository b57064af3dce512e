#include "engine/solver/face_loads.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "engine/layout/layers.hpp"
#include "engine/neighbors/neighbors_of_one.hpp"

namespace taut {
namespace {

template <int Dim>
using Place = Eigen::Vector<double, Dim>;

constexpr double layer_reach = 2.1;  // dp, range of the particles that determine the normal of a layer
constexpr double close_reach = 2.2;  // dp, range of the search along the face
constexpr double aside = 0.75;       // dp, greatest lateral offset

/// Least ratio of Σ n · S to face area at which the particles of a column share a force.
constexpr double least_scaled = 0.5;

template <int Dim>
Place<Dim> place(const Point& p) {
  return Eigen::Map<const Place<Dim>>(p.data());
}

template <int Dim>
Point point(const Place<Dim>& v) {
  Point p{};
  for (int k = 0; k < Dim; ++k) p[k] = v[k];
  return p;
}

template <int Dim>
Place<Dim> way(const InitialParticles& initial, int i, int j) {
  return place<Dim>(initial.x[j]) - place<Dim>(initial.x[i]);
}

int position(const std::vector<int>& layer, int i) {
  const auto found = std::ranges::lower_bound(layer, i);
  return found != layer.end() && *found == i ? static_cast<int>(found - layer.begin()) : -1;
}

/// Outward unit normal of the layer at particle i; 0 if the layer is not thin or has no outer side.
template <int Dim>
Place<Dim> outwards(int i, const InitialParticles& initial, std::span<const int> near,
                    const std::vector<int>& layer, double spacing) {
  constexpr double thin = 0.1;  // variance across the layer over variance along it
  Eigen::Matrix<double, Dim, Dim> spread = Eigen::Matrix<double, Dim, Dim>::Zero();
  Place<Dim> away = Place<Dim>::Zero();
  for (const int j : near) {
    const Place<Dim> d = way<Dim>(initial, i, j) / spacing;
    if (d.norm() > layer_reach) continue;
    if (position(layer, j) >= 0)
      spread += d * d.transpose();
    else
      away -= d;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Dim, Dim>> axes(spread);
  const Place<Dim> n = axes.eigenvectors().col(0);
  const double side = n.dot(away);
  if (!(axes.eigenvalues()[0] < thin * axes.eigenvalues()[1]) || side == 0) return Place<Dim>::Zero();
  return side > 0 ? n : Place<Dim>(-n);
}

/// Ratio of face area to layer area.
template <int Dim>
double stretch(const FaceLayer& layer, std::size_t k, const InitialParticles& initial,
               std::span<const int> near, double spacing, double thickness) {
  double inside = 0, outside = 0;
  for (const int j : near) {
    const int other = position(layer.id, j);
    if (other < 0) continue;
    const Place<Dim> d = way<Dim>(initial, layer.id[k], j);
    if (d.norm() > layer_reach * spacing) continue;
    const Place<Dim> turn = place<Dim>(layer.normal[other]) - place<Dim>(layer.normal[k]);
    inside += d.norm();
    outside += (d + 0.5 * thickness * turn).norm();
  }
  return std::pow(inside > 0 ? outside / inside : 1, Dim - 1);
}

/// Column of particles below a layer particle.
struct Column {
  bool thin = false;                                        // the opposite face may be in reach
  double middle = std::numeric_limits<double>::infinity();  // depth, m; infinite unless thin
  double area = 0;                                          // Σ n · S, m^(dim − 1)
  int at_middle = 0;
};

template <int Dim>
std::pair<int, double> deepest(int i, const Place<Dim>& n, const InitialParticles& initial,
                               const NeighborsOfOne<Dim>& near, double spacing) {
  std::pair<int, double> known{i, 0};
  for (const int j : near(i)) {
    const Place<Dim> d = way<Dim>(initial, j, i);
    if ((d - d.dot(n) * n).norm() > aside * spacing) continue;
    if (d.dot(n) > known.second + 1e-6 * spacing) known = {j, d.dot(n)};
  }
  return known;
}

/// Thin if the column is shorter than about twice the range of `near`.
template <int Dim>
Column column(int i, const Place<Dim>& n, const InitialParticles& initial, const NeighborsOfOne<Dim>& near,
              double spacing) {
  double depth = 0, enough = std::numeric_limits<double>::infinity();
  while (depth < enough) {
    const auto [j, step] = deepest<Dim>(i, n, initial, near, spacing);
    if (step == 0) return {.thin = true, .middle = 0.5 * depth};
    if (depth == 0) enough = 2 * step - 0.5 * spacing;
    depth += step;
    i = j;
  }
  return {};
}

struct Below {
  double distance = std::numeric_limits<double>::infinity();  // m
  std::size_t k = 0;
  double depth = 0;  // along the normal, m
};

/// Nearest layer particle above each free particle, by id.
template <int Dim>
std::map<int, Below> below(const FaceLayer& layer, const InitialParticles& initial,
                           const NeighborsOfOne<Dim>& near, double spacing) {
  std::map<int, Below> all;
  for (std::size_t k = 0; k < layer.id.size(); ++k) {
    const int i = layer.id[k];
    const Place<Dim> n = place<Dim>(layer.normal[k]);
    all[i] = {0, k, 0};
    for (const int j : near(i)) {
      const Place<Dim> d = way<Dim>(initial, j, i);
      if (initial.clamped[j] || (d - d.dot(n) * n).norm() > aside * spacing) continue;
      if (Below& known = all[j]; d.norm() < known.distance) known = {d.norm(), k, d.dot(n)};
    }
  }
  return all;
}

template <int Dim>
int beside(int i, const Place<Dim>& along, const InitialParticles& initial, const NeighborsOfOne<Dim>& near,
           double spacing) {
  int found = -1;
  double least = 2 * spacing;
  for (const int j : near(i)) {
    const Place<Dim> d = way<Dim>(initial, i, j);
    const double distance = d.dot(along);
    if (distance < 0.5 * spacing || distance > least || (d - distance * along).norm() > aside * spacing)
      continue;
    found = j, least = distance;
  }
  return found;
}

/// Unit vectors along the face.
template <int Dim>
std::vector<Place<Dim>> directions(const FaceLayer& layer, std::size_t k, const InitialParticles& initial,
                                   const NeighborsOfOne<Dim>& near) {
  const Place<Dim> n = place<Dim>(layer.normal[k]);
  if constexpr (Dim == 2) {
    return {Place<2>(-n[1], n[0]), Place<2>(n[1], -n[0])};
  } else {
    Place<3> nearest = Place<3>::Zero();
    for (const int j : near(layer.id[k])) {
      Place<3> d = way<3>(initial, layer.id[k], j);
      d -= d.dot(n) * n;
      if (position(layer.id, j) >= 0 && (nearest.isZero() || d.norm() < nearest.norm())) nearest = d;
    }
    const Place<3> one = nearest.normalized(), other = n.cross(one);
    return {one, other, -one, -other};
  }
}

/// End correction of the midpoint rule at corners and edges (THEORY.md).
template <int Dim>
std::vector<double> end_weights(const FaceLayer& layer, const InitialParticles& initial,
                                const NeighborsOfOne<Dim>& near, double spacing) {
  std::vector<double> weights(layer.id.size(), 1);
  for (std::size_t k = 0; k < layer.id.size(); ++k)
    for (const Place<Dim>& along : directions<Dim>(layer, k, initial, near)) {
      if (beside<Dim>(layer.id[k], along, initial, near, spacing) >= 0) continue;
      const int second = beside<Dim>(layer.id[k], -along, initial, near, spacing),
                third = second < 0 ? -1 : beside<Dim>(second, -along, initial, near, spacing);
      const int at_second = position(layer.id, second), at_third = position(layer.id, third);
      if (at_second < 0 || at_third < 0) continue;
      constexpr double share = 1.0 / 24;
      weights[k] += 1.25 * share, weights[at_second] -= 1.5 * share, weights[at_third] += 0.25 * share;
    }
  return weights;
}

/// Whether some normals are almost perpendicular to the first one.
template <int Dim>
bool are_of_two_faces(const std::vector<Point>& normals) {
  constexpr double across = 0.3;
  const auto first = std::ranges::find_if(normals, [](const Point& n) { return n != Point{}; });
  return std::ranges::any_of(normals, [&](const Point& n) {
    return n != Point{} && std::abs(place<Dim>(n).dot(place<Dim>(*first))) < across;
  });
}

template <int Dim>
FaceLayer layer_of(const Load& load, const InitialParticles& initial, std::vector<int> id, double spacing,
                   double thickness) {
  const NeighborsOfOne<Dim> near(initial, close_reach * spacing);
  FaceLayer layer{.id = std::move(id), .normal = {}, .traction = {}, .area = {}};
  std::ranges::sort(layer.id);
  for (const int i : layer.id)
    layer.normal.push_back(point<Dim>(outwards<Dim>(i, initial, near(i), layer.id, spacing)));
  if (std::ranges::find(layer.normal, Point{}) != layer.normal.end())
    return {
        .id = {}, .normal = {}, .traction = {}, .area = {}, .has_edge = are_of_two_faces<Dim>(layer.normal)};
  for (std::size_t k = 0; k < layer.id.size(); ++k) {
    const int i = layer.id[k];
    Point at = initial.x[i], t{};
    for (int a = 0; a < Dim; ++a) at[a] += 0.5 * thickness * layer.normal[k][a];
    for (int a = 0; a < Dim; ++a)
      if (load.value[a]) t[a] = load.value[a](at);
    layer.traction.push_back(t);
    layer.area.push_back(initial.V0[i] / thickness *
                         stretch<Dim>(layer, k, initial, near(i), spacing, thickness));
  }
  return layer;
}

template <int Dim>
std::vector<FaceShare> shares_of(FaceRule rule, const FaceLayer& layer, const InitialParticles& initial,
                                 double reach, const std::vector<Point>& surface, double spacing) {
  const NeighborsOfOne<Dim> near(initial, 2 * reach);
  std::vector<Column> columns;
  for (std::size_t k = 0; k < layer.id.size(); ++k)
    columns.push_back(column<Dim>(layer.id[k], place<Dim>(layer.normal[k]), initial, near, spacing));
  const std::map<int, Below> belows = below<Dim>(layer, initial, near, spacing);
  std::vector<double> whole_area = layer.area;
  if (rule == FaceRule::by_column) {
    const NeighborsOfOne<Dim> close(initial, close_reach * spacing);
    const std::vector<double> weights = end_weights<Dim>(layer, initial, close, spacing);
    for (std::size_t k = 0; k < weights.size(); ++k) whole_area[k] *= weights[k];
  }
  const auto own_area = [&](int j, const Below& b) {
    const double from_middle = b.depth - columns[b.k].middle;
    const double part = from_middle < -0.25 * spacing ? 1 : from_middle < 0.25 * spacing ? 0.5 : 0;
    return part * place<Dim>(layer.normal[b.k]).dot(place<Dim>(surface[j]));
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
    if (area != 0) shares.emplace_back(j, point<Dim>(area * place<Dim>(layer.traction[b.k])));
  }
  return shares;
}

}  // namespace

FaceLayer face_layer(const Load& load, const Body& body, const InitialParticles& initial, std::vector<int> id,
                     double spacing) {
  const double thickness = layer_thickness(body, initial, id, spacing);
  return initial.dim == 3 ? layer_of<3>(load, initial, std::move(id), spacing, thickness)
                          : layer_of<2>(load, initial, std::move(id), spacing, thickness);
}

std::vector<FaceShare> face_shares(FaceRule rule, const FaceLayer& layer, const InitialParticles& initial,
                                   double reach, const std::vector<Point>& surface, double spacing) {
  return initial.dim == 3 ? shares_of<3>(rule, layer, initial, reach, surface, spacing)
                          : shares_of<2>(rule, layer, initial, reach, surface, spacing);
}

}  // namespace taut
