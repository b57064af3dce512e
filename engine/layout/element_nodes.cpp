#include "engine/layout/element_nodes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Dense>
#include <fmt/core.h>

#include "engine/core/index.hpp"
#include "engine/error.hpp"
#include "engine/layout/layers.hpp"
#include "engine/layout/overlap.hpp"
#include "engine/layout/reference_element.hpp"
#include "engine/layout/surface_mesh.hpp"

namespace taut {
namespace {

bool contains(const Expression& where, const Point& x) { return where && where(x) != 0; }

/// Local nodes of each cell.
std::vector<std::vector<int>> cells_of_element(const ElementMesh& mesh) {
  const int n = mesh.order + 1, cells = mesh.dim == 2 ? 1 : mesh.order;
  std::vector<std::vector<int>> all;
  for (int c = 0; c < cells; ++c)
    for (int b = 0; b < mesh.order; ++b)
      for (int a = 0; a < mesh.order; ++a) {
        std::vector<int>& cell = all.emplace_back();
        for (int k = 0; k < (mesh.dim == 2 ? 4 : 8); ++k)
          cell.push_back(a + k % 2 + (b + k / 2 % 2) * n + (c + k / 4) * n * n);
      }
  return all;
}

/// Calls f(element, cell, middle) for each cell.
template <class F>
void for_each_cell(const ElementMesh& mesh, const F& f) {
  const std::vector<std::vector<int>> cells = cells_of_element(mesh);
  for (int e = 0; e < mesh.size(); ++e)
    for (const std::vector<int>& cell : cells) {
      Point middle{};
      for (const int a : cell)
        for (std::size_t k = 0; k < 3; ++k)
          middle[k] += mesh.x[as_index(mesh.node[as_index(mesh.nodes_of_each() * e + a)])][k] /
                       static_cast<double>(cell.size());
      f(e, cell, middle);
    }
}

/// Calls f(element, cell, middle) for each cell whose middle is in the region.
template <class F>
void for_each_cell_in(const Expression& where, const ElementMesh& mesh, const F& f) {
  for_each_cell(mesh, [&](int e, const std::vector<int>& cell, const Point& middle) {
    if (contains(where, middle)) f(e, cell, middle);
  });
}

class BodyNodes {
 public:
  BodyNodes(const Scene& scene, int b, InitialParticles& out)
      : scene_(scene), body_(scene.bodies[as_index(b)]), index_(b), out_(out), first_(out.size()) {
    mesh_ = mesh_of_body(body_, scene.dim, scene.element_order, scene.spacing);
  }

  void add() {
    set_materials();
    check_regions();
    const std::vector<unsigned char> clamped = nodes_in(body_.clamped);
    std::vector<int> drive(mesh_.x.size(), -1);
    for (std::size_t k = 0; k < body_.drives.size(); ++k) {
      const std::vector<unsigned char> driven = nodes_in(body_.drives[k].where);
      for (std::size_t i = 0; i < drive.size(); ++i)
        if (driven[i] && !clamped[i]) drive[i] = static_cast<int>(k);
    }
    std::array<std::vector<unsigned char>, 3> guided;
    for (std::size_t k = 0; k < guided.size(); ++k) guided[k] = nodes_in(body_.guided[k]);
    for (std::size_t i = 0; i < mesh_.x.size(); ++i) {
      unsigned guide = 0;
      for (unsigned k = 0; k < guided.size(); ++k) guide |= guided[k][i] && !clamped[i] ? 1u << k : 0;
      Point v{};
      for (unsigned k = 0; k < as_index(scene_.dim); ++k)
        if (!clamped[i] && (guide >> k & 1) == 0 && body_.velocity[k]) v[k] = body_.velocity[k](mesh_.x[i]);
      out_.clamped.push_back(clamped[i]);
      out_.drive.push_back(drive[i]);
      out_.guided.push_back(static_cast<unsigned char>(guide));
      out_.v.push_back(v);
    }
    add_nodes();
    append_elements();
  }

 private:
  void set_materials() {
    for (const Point& middle : mesh_.middle) {
      const int part = last_that_holds(body_.parts, middle);
      mesh_.material.push_back(part < 0 ? body_.material : body_.parts[as_index(part)].material);
    }
    mesh_.body.assign(mesh_.middle.size(), index_);
  }

  std::vector<unsigned char> nodes_in(const Expression& where) const {
    std::vector<unsigned char> in(mesh_.x.size());
    if (!where) return in;
    if (body_.on_boundary) {
      for (std::size_t i = 0; i < in.size(); ++i) in[i] = contains(where, mesh_.x[i]);
      return in;
    }
    for_each_cell_in(where, mesh_, [&](int e, const std::vector<int>& cell, const Point&) {
      for (const int a : cell) in[as_index(mesh_.node[as_index(mesh_.nodes_of_each() * e + a)])] = 1;
    });
    return in;
  }

  void refuse_empty(const Expression& where, const std::string& key, const std::string& what) const {
    if (where && std::ranges::count(nodes_in(where), 1) == 0)
      throw SceneError(
          fmt::format("body.{}.{}", body_.name, key),
          fmt::format(
              "{}: no element cell of body '{}' is in this region, "
              "because the expression is 0 in the middle of each cell, or with on_boundary at each node",
              what, body_.name));
  }
  void check_regions() const {
    for (std::size_t k = 0; k < body_.parts.size(); ++k)
      if (std::ranges::none_of(mesh_.middle,
                               [&](const Point& x) { return contains(body_.parts[k].where, x); }))
        throw SceneError(fmt::format("body.{}.parts", body_.name),
                         fmt::format("parts[{}]: no element of body '{}' is in this region, "
                                     "because the expression is 0 in the middle of each element",
                                     k, body_.name));
    const auto check = [&](const auto& regions, const std::string& key) {
      for (std::size_t k = 0; k < regions.size(); ++k)
        refuse_empty(regions[k].where, key, fmt::format("{}[{}]", key, k));
    };
    check(body_.drives, "driven");
    check(body_.loads, "loaded");
    const bool by_component =
        std::ranges::any_of(body_.guided, [](const Expression& e) { return e != nullptr; });
    for (std::size_t k = 0; k < body_.guided.size(); ++k)
      refuse_empty(body_.guided[k], "held", fmt::format("held[{}]", k));
    if (!by_component) refuse_empty(body_.clamped, "held", "held");
    for (const Drive& drive : body_.drives)
      for (const Point& middle : mesh_.middle)
        if (contains(drive.where, middle) && contains(body_.clamped, middle))
          throw SceneError(
              fmt::format("body.{}.driven", body_.name),
              fmt::format(
                  "elements of body '{}' are both held and driven; 'held' and the 'where' of 'driven' must not overlap",
                  body_.name));
  }

  /// A node has the material with the greatest share of its mass.
  void add_nodes() {
    const std::size_t nodes = mesh_.x.size(), each = as_index(mesh_.nodes_of_each());
    std::vector<std::vector<double>> mass(nodes, std::vector<double>(scene_.materials.size()));
    for (std::size_t k = 0; k < mesh_.node.size(); ++k) {
      const std::size_t material = as_index(mesh_.material[k / each]);
      mass[as_index(mesh_.node[k])][material] += scene_.materials[material].density * mesh_.volume[k];
    }
    for (std::size_t i = 0; i < nodes; ++i) {
      const auto most = std::ranges::max_element(mass[i]);
      const auto material = static_cast<std::size_t>(most - mass[i].begin());
      double sum = 0;
      for (const double m : mass[i]) sum += m;
      out_.material.push_back(static_cast<int>(material));
      out_.V0.push_back(sum / scene_.materials[material].density);
      out_.inside.push_back(out_.V0.back() / std::pow(scene_.spacing, scene_.dim));
      out_.body.push_back(index_);
      out_.turned.push_back(out_.size());
      out_.x.push_back(mesh_.x[i]);
    }
    out_.first.push_back(out_.size());
  }

  void append_elements() {
    const auto append = [](auto& all, const auto& own) { all.insert(all.end(), own.begin(), own.end()); };
    for (int& node : mesh_.node) node += first_;
    ElementMesh& all = out_.mesh;
    append(all.x, mesh_.x), append(all.node, mesh_.node), append(all.middle, mesh_.middle);
    append(all.volume, mesh_.volume), append(all.body, mesh_.body), append(all.material, mesh_.material);
  }

  const Scene& scene_;
  const Body& body_;
  int index_;
  InitialParticles& out_;
  int first_;
  ElementMesh mesh_;
};

/// Shape functions at a point, by Newton's method. Empty outside the element.
template <int n, int Dim>
std::vector<PointWeight> shapes_at(const ElementMesh& mesh, int element, const Point& at) {
  using Line = LineElement<n>;
  using Place = Eigen::Vector<double, Dim>;
  constexpr int N = power_of(n, Dim), rounds = 20;
  constexpr double edge = 1e-6;
  const int* const node = &mesh.node[as_index(N * element)];
  Place xi = Place::Zero();
  std::array<double, N> shape{};
  for (int round = 0; round < rounds; ++round) {
    Place off = Eigen::Map<const Place>(at.data());
    Eigen::Matrix<double, Dim, Dim> G = Eigen::Matrix<double, Dim, Dim>::Zero();
    std::array<std::array<double, n>, Dim> value, slope;
    for (int axis = 0; axis < Dim; ++axis)
      for (std::size_t k = 0; k < n; ++k) {
        value[as_index(axis)][k] = Line::value(Line::node, k, xi[axis]);
        slope[as_index(axis)][k] = Line::slope(Line::node, k, xi[axis]);
      }
    for (int a = 0; a < N; ++a) {
      const Place X = Eigen::Map<const Place>(mesh.x[as_index(node[a])].data());
      const auto product = [&](int sloped) {
        double of_all = 1;
        for (int axis = 0; axis < Dim; ++axis)
          of_all *= (axis == sloped ? slope : value)[as_index(axis)][as_index(index_along(axis, a, n))];
        return of_all;
      };
      shape[as_index(a)] = product(-1);
      off -= shape[as_index(a)] * X;
      for (int axis = 0; axis < Dim; ++axis) G.col(axis) += product(axis) * X;
    }
    const Place step = G.partialPivLu().solve(off);
    if (step.norm() < 1e-12) break;
    xi += step;
  }
  if (!(xi.cwiseAbs().maxCoeff() < 1 + edge)) return {};
  std::vector<PointWeight> weights;
  for (int a = 0; a < N; ++a)
    if (std::abs(shape[as_index(a)]) > 1e-9) weights.push_back({node[a], shape[as_index(a)]});
  return weights;
}

std::vector<double> loaded_volumes(const Load& load, const Body& body, const InitialParticles& initial,
                                   int index) {
  const ElementMesh& mesh = initial.mesh;
  const int each = mesh.nodes_of_each();
  // [element][local node] loaded share of the node's cells
  std::vector<double> share(mesh.node.size()), weight(initial.x.size());
  std::vector<double> cells(as_index(each));
  for (const std::vector<int>& cell : cells_of_element(mesh))
    for (const int a : cell) ++cells[as_index(a)];
  for_each_cell_in(load.where, mesh, [&](int e, const std::vector<int>& cell, const Point&) {
    if (mesh.body[as_index(e)] != index) return;
    for (const int a : cell) share[as_index(each * e + a)] += 1 / cells[as_index(a)];
  });
  for (std::size_t k = 0; k < mesh.node.size(); ++k) {
    const auto node = as_index(mesh.node[k]);
    const bool counts = initial.body[node] == index && contains(load.where, initial.x[node]);
    weight[node] += mesh.volume[k] * (body.on_boundary ? double(counts) : share[k]);
  }
  return weight;
}

/// Boundary facet of a loaded cell.
struct LoadedFacet {
  MeshFacet facet;
  Point cell{};          // middle, m
  int layers = 1;        // of the region, counted from the facet inwards in steps of the spacing
  bool through = false;  // the region extends to the opposite face
  double share = 1;      // loaded part of the area

  /// 0: a layer; 1: a part of the body one layer thick; 2: a deeper region; 3: a thicker part of the body
  int rank() const { return 2 * static_cast<int>(layers > 1) + static_cast<int>(through); }
  double layers_per_face() const { return through ? std::max(1.0, 0.5 * layers) : layers; }
};

std::size_t corners_of_facet(const ElementMesh& mesh) { return mesh.dim == 2 ? 2 : 4; }

/// Share of a node in the area of its facet, such that a uniform traction on an element face is consistent.
double share_of_node(const ElementMesh& mesh, const MeshFacet& facet, int node) {
  const auto first = mesh.node.begin() + mesh.nodes_of_each() * facet.element;
  auto local = std::find(first, first + mesh.nodes_of_each(), node) - first;
  double share = 1;
  for (int axis = 0; axis < mesh.dim; ++axis, local /= mesh.order + 1)
    if (axis != facet.side / 2) share *= mesh.order == 1 ? 1.0 / 2 : local % 3 == 1 ? 2.0 / 3 : 1.0 / 3;
  return share;
}

void count_layers(LoadedFacet& loaded, const Load& load, const Body& body, const ElementMesh& mesh,
                  double spacing) {
  Point middle{}, next = loaded.cell;
  const std::size_t corners = corners_of_facet(mesh);
  for (std::size_t c = 0; c < corners; ++c)
    for (std::size_t k = 0; k < 3; ++k)
      middle[k] += mesh.x[as_index(loaded.facet.node[c])][k] / static_cast<double>(corners);
  // steps past the end of the region despite round-off
  const double times = 1.01 * spacing / distance_between(loaded.cell, middle, 3);
  for (;; ++loaded.layers) {
    for (std::size_t k = 0; k < 3; ++k) next[k] += times * (loaded.cell[k] - middle[k]);
    loaded.through = !holds(body, next, mesh.dim, 0);
    if (loaded.through || !contains(load.where, next)) return;
  }
}

std::vector<LoadedFacet> loaded_facets(const Load& load, const Body& body, const ElementMesh& mesh, int index,
                                       double spacing) {
  struct Cell {
    std::vector<int> nodes;
    Point middle;
  };
  std::vector<std::vector<Cell>> cells(as_index(mesh.size()));  // [element] loaded cells
  for_each_cell_in(load.where, mesh, [&](int e, std::vector<int> nodes, const Point& middle) {
    if (mesh.body[as_index(e)] != index) return;
    for (int& a : nodes) a = mesh.node[as_index(mesh.nodes_of_each() * e + a)];
    cells[as_index(e)].push_back({nodes, middle});
  });
  std::vector<LoadedFacet> facets;
  for (const MeshFacet& facet : boundary_of(mesh))
    for (const Cell& cell : cells[as_index(facet.element)]) {
      const auto has = [&](int node) { return std::ranges::count(cell.nodes, node) > 0; };
      if (!std::ranges::all_of(facet.node, has)) continue;
      count_layers(facets.emplace_back(LoadedFacet{.facet = facet, .cell = cell.middle}), load, body, mesh,
                   spacing);
    }
  return facets;
}

/// Keeps the facets of the face, or of two opposite faces, with the most facets of the lowest rank. MeshFacet::side
/// distinguishes faces that meet at an edge, also on round bodies.
void choose_face(std::vector<LoadedFacet>& facets, const Load& load, const Body& body) {
  if (facets.empty()) return;
  const int rank = std::ranges::min(facets, {}, &LoadedFacet::rank).rank();
  std::array<int, 6> on_side{};
  std::array<int, 3> across{};  // [axis]
  for (const LoadedFacet& f : facets)
    if (f.rank() == rank) ++on_side[as_index(f.facet.side)], ++across[as_index(f.facet.side / 2)];
  const int most = std::ranges::max(across);
  const auto axis = std::ranges::find(across, most) - across.begin();
  const auto is_chosen = [&](const LoadedFacet& f) {
    return f.facet.side / 2 == axis && on_side[as_index(f.facet.side)] > 0;
  };
  const auto is_of_other_face = [&](const LoadedFacet& f) {
    return f.rank() == 0 && !is_chosen(f) && std::ranges::none_of(facets, [&](const LoadedFacet& other) {
             return is_chosen(other) && other.cell == f.cell;
           });
  };
  const bool ties = std::ranges::count(across, most) > 1;
  if (rank == 0 && (ties || std::ranges::any_of(facets, is_of_other_face))) refuse_edge(body);
  std::erase_if(facets, [&](const LoadedFacet& f) { return !is_chosen(f); });
  double layers = 0;
  for (LoadedFacet& f : facets) {
    layers += f.layers_per_face() / static_cast<double>(facets.size());
    if (rank == 1 && f.rank() == 1) f.share = 0.5;
  }
  refuse_deep_traction(load, body, layers);
  if (rank == 3 && ties) refuse_edge(body);
}

}  // namespace

InitialParticles make_element_nodes(const Scene& scene) {
  if (scene.jitter.share > 0)
    throw SceneError("jitter",
                     "a finite-element mesh has no jitter; remove it or use a method with particles");
  InitialParticles layout;
  layout.dim = layout.mesh.dim = scene.dim;
  layout.mesh.order = scene.element_order;
  layout.first.push_back(0);
  for (int b = 0; b < static_cast<int>(scene.bodies.size()); ++b) BodyNodes(scene, b, layout).add();
  if (has_displacements(scene))
    for (int i = 0; i < layout.size(); ++i)
      layout.start.push_back(
          displaced(scene.bodies[as_index(layout.body[as_index(i)])], layout.x[as_index(i)]));
  if (std::ranges::count(layout.guided, 0) == layout.size()) layout.guided.clear();
  refuse_overlap(layout, scene);
  return layout;
}

std::vector<double> load_weights(const Load& load, const Scene& scene, const InitialParticles& initial,
                                 int index) {
  const ElementMesh& mesh = initial.mesh;
  const Body& body = scene.bodies[as_index(index)];
  if (load.kind != Load::Kind::traction) return loaded_volumes(load, body, initial, index);
  std::vector<LoadedFacet> facets = loaded_facets(load, body, mesh, index, scene.spacing);
  choose_face(facets, load, body);
  std::vector<double> weight(initial.x.size());
  for (const LoadedFacet& loaded : facets) {
    const std::array<int, 4>& node = loaded.facet.node;
    const auto at = [&](std::size_t k) { return mesh.x[as_index(node[k])]; };
    const std::size_t corners = corners_of_facet(mesh);
    const double area = mesh.dim == 2 ? distance_between(at(0), at(1), 2)
                                      : distance_between(vector_area({at(0), at(1), at(2), at(3)}), {}, 3);
    for (std::size_t k = 0; k < corners; ++k)
      weight[as_index(node[k])] += loaded.share * area * share_of_node(mesh, loaded.facet, node[k]);
  }
  return weight;
}

std::vector<double> shares_in_region(const Expression& where, const InitialParticles& initial,
                                     const std::vector<unsigned char>& held) {
  const ElementMesh& mesh = initial.mesh;
  std::vector<double> inside(initial.x.size()), all(initial.x.size());
  for_each_cell(mesh, [&](int e, const std::vector<int>& cell, const Point& middle) {
    const auto node = [&](int a) { return as_index(mesh.node[as_index(mesh.nodes_of_each() * e + a)]); };
    if (!std::ranges::all_of(cell, [&](int a) { return held[node(a)] != 0; })) return;
    for (const int a : cell) ++all[node(a)], inside[node(a)] += contains(where, middle);
  });
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i] > 0)
      inside[i] /= all[i];
    else
      inside[i] = held[i] != 0 && contains(where, initial.x[i]);
  return inside;
}

std::vector<PointWeight> point_in_element(const InitialParticles& initial, int body, const Point& at) {
  const ElementMesh& mesh = initial.mesh;
  const auto each = as_index(mesh.nodes_of_each());
  for (int e = 0; e < mesh.size(); ++e) {
    if (mesh.body[as_index(e)] != body) continue;
    double radius = 0;
    for (std::size_t k = 0; k < each; ++k)
      radius = std::max(radius, distance_between(mesh.x[as_index(mesh.node[as_index(e) * each + k])],
                                                 mesh.middle[as_index(e)], mesh.dim));
    if (distance_between(at, mesh.middle[as_index(e)], mesh.dim) > 1.01 * radius) continue;
    std::vector<PointWeight> found = with_order(mesh.order, [&](auto n) {
      return mesh.dim == 2 ? shapes_at<n, 2>(mesh, e, at) : shapes_at<n, 3>(mesh, e, at);
    });
    if (!found.empty()) return found;
  }
  return {};
}

}  // namespace taut
