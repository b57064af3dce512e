#include "engine/methods/finite_elements/solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Dense>
#include <fmt/core.h>

#include "engine/core/parallel.hpp"
#include "engine/error.hpp"
#include "engine/layout/surface_mesh.hpp"
#include "engine/methods/finite_elements/describe.hpp"
#include "engine/solver/particle_simulation.hpp"
#include "engine/terms/surface_contact.hpp"

namespace taut {
namespace {

constexpr int steps_per_rate = 10;  // between evaluations of the greatest frequency
/// Ratio of squared frequencies beyond which the run has diverged.
constexpr double greatest_rate_ratio = 1e4;

template <int n, int Dim>
struct OneElement {
  static constexpr int N = power_of(n, Dim), modes = volume_modes(n - 1, Dim);
  using Place = Eigen::Vector<double, Dim>;
  using Matrix = Eigen::Matrix<double, Dim, Dim>;

  std::array<Matrix, N> to_local;
  std::array<double, N> weight;
  std::array<std::array<double, modes>, N> mode;
  double rate = 0;  // greatest eigenvalue of the Laplacian with lumped volumes, 1/m²

  OneElement(const ElementMesh& mesh, int element) {
    using Line = LineElement<n>;
    const auto slope = [](int q, int a) {
      Place of_all;
      for (int sloped = 0; sloped < Dim; ++sloped) {
        of_all[sloped] = 1;
        for (int axis = 0; axis < Dim; ++axis)
          of_all[sloped] *=
              (axis == sloped ? Line::dN : Line::N)[index_along(axis, q, n)][index_along(axis, a, n)];
      }
      return of_all;
    };
    Eigen::Matrix<double, N, N> laplacian = Eigen::Matrix<double, N, N>::Zero();
    for (int q = 0; q < N; ++q) {
      Matrix G = Matrix::Zero();  // ∂X/∂ξ
      for (int a = 0; a < N; ++a)
        G += Eigen::Map<const Place>(mesh.x[mesh.node[N * element + a]].data()) * slope(q, a).transpose();
      to_local[q] = G.inverse();
      weight[q] = product_weight<n, Dim>(Line::gauss_weight, q) * std::abs(G.determinant());
      Eigen::Matrix<double, Dim, N> gradient;
      for (int a = 0; a < N; ++a) gradient.col(a) = to_local[q].transpose() * slope(q, a);
      laplacian += weight[q] * gradient.transpose() * gradient;
    }
    set_modes();
    set_rate(laplacian, &mesh.volume[N * element]);
  }

 private:
  /// Orthonormalises the first `modes` of 1, ξ, η, ζ under the weights.
  void set_modes() {
    for (int m = 0; m < modes; ++m) {
      for (int q = 0; q < N; ++q) mode[q][m] = m == 0 ? 1 : LineElement<n>::gauss[index_along(m - 1, q, n)];
      for (int k = 0; k <= m; ++k) {
        double product = 0;
        for (int q = 0; q < N; ++q) product += weight[q] * mode[q][m] * mode[q][k];
        for (int q = 0; q < N; ++q)
          if (k < m)
            mode[q][m] -= product * mode[q][k];
          else
            mode[q][m] /= std::sqrt(product);
      }
    }
  }

  void set_rate(Eigen::Matrix<double, N, N>& laplacian, const double* volume) {
    constexpr int rounds = 40;
    Eigen::Vector<double, N> x;
    for (int a = 0; a < N; ++a) {
      x[a] = std::sin(1 + 2.3 * a);
      for (int b = 0; b < N; ++b) laplacian(a, b) /= std::sqrt(volume[a] * volume[b]);
    }
    for (int round = 0; round < rounds; ++round) {
      x = laplacian * x;
      rate = x.norm();
      x /= rate;
    }
  }
};

/// In m^Dim.
template <int n, int Dim>
double weight_of(const std::vector<Vec<Pack, 1>>& points, int element, int q) {
  using Point = ElementPoint<Dim, volume_modes(n - 1, Dim)>;
  const auto* const all = reinterpret_cast<const Point*>(points.data());
  return all[element / lanes * power_of(n, Dim) + q].weight[element % lanes];
}

}  // namespace

template <int Dim>
FiniteElements<Dim>::FiniteElements(Common<Dim>& common, const SolverInput& input, const Kernels& kernels)
    : kernels_(kernels),
      common_(common),
      p_(common.particles),
      mesh_(common.initial.mesh),
      materials_(input.law, input.materials),
      X_(p_.x),
      u_(p_.x.size()) {
  with_order(mesh_.order, [&](auto n) { set_up<n>(input); });
  for (int i = 0; i < p_.size(); i += lanes) {
    Pack of_four{};
    for (int lane = 0; lane < std::min(lanes, p_.size() - i); ++lane)
      of_four[lane] = p_.mobile[i + lane] / p_.m[i + lane];
    mobility_.push_back({of_four});
  }
  set_contact_rate(input);
  common.run.pairs = static_cast<long>(mesh_.node.size());
  common.go_to_start();
  common.contact.search(p_);
  common.show_contacts_to_probes();
  f_ = {.size = p_.size(),
        .groups = static_cast<int>(rates_.size()),
        .x = p_.x.data(),
        .v = p_.v.data(),
        .X = X_.data(),
        .u = u_.data(),
        .node = node_.data(),
        .material = material_.data(),
        .points = points_.data(),
        .rate = rates_.data(),
        .force = force_.data(),
        .begin = begin_.data(),
        .slot = slot_.data(),
        .mobility = mobility_.data(),
        .laws = materials_.in_use()};
  kernels_.drift(f_, 0, common_.threads_now());
  update_rate();
}

/// Copies of the last element fill the last group of four.
template <int Dim>
template <int n>
void FiniteElements<Dim>::set_up(const SolverInput& input) {
  using Element = OneElement<n, Dim>;
  using Point = ElementPoint<Dim, volume_modes(n - 1, Dim)>;
  constexpr int N = Element::N, per_point = sizeof(Point) / sizeof(Pack);
  const int groups = (mesh_.size() + lanes - 1) / lanes;
  node_.resize(static_cast<std::size_t>(groups) * N * lanes);
  points_.resize(static_cast<std::size_t>(groups) * N * per_point);
  force_.resize(static_cast<std::size_t>(groups) * N * lanes * Dim);
  rates_.resize(groups);
  material_.resize(static_cast<std::size_t>(groups) * lanes);
  parallel_for(groups, input.threads, [&](int group) {
    Point* const points = reinterpret_cast<Point*>(points_.data()) + static_cast<std::ptrdiff_t>(group) * N;
    for (int lane = 0; lane < lanes; ++lane) {
      const int e = std::min(lanes * group + lane, mesh_.size() - 1);
      const Element element(mesh_, e);
      material_[lanes * group + lane] = mesh_.material[e];
      rates_[group][0][lane] = element.rate / input.materials[mesh_.material[e]].rho0;
      for (int a = 0; a < N; ++a) node_[(group * N + a) * lanes + lane] = mesh_.node[N * e + a];
      for (int q = 0; q < N; ++q) {
        points[q].weight[lane] = element.weight[q];
        for (int m = 0; m < Element::modes; ++m) points[q].mode[m][lane] = element.mode[q][m];
        for (int k = 0; k < Dim; ++k)
          for (int l = 0; l < Dim; ++l) points[q].to_local(k, l)[lane] = element.to_local[q](k, l);
      }
    }
  });
  begin_.assign(p_.x.size() + 1, 0);
  for (const int node : mesh_.node) ++begin_[node + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  slot_.resize(mesh_.node.size());
  std::vector<int> next(begin_.begin(), begin_.end() - 1);
  for (int k = 0; k < static_cast<int>(mesh_.node.size()); ++k) {
    const int e = k / N, a = k % N;
    slot_[next[mesh_.node[k]]++] = (e / lanes * N + a) * Dim * lanes + e % lanes;
  }
}

/// Greatest squared frequency of two equal face nodes joined by a contact spring, 1/s².
template <int Dim>
void FiniteElements<Dim>::set_contact_rate(const SolverInput& input) {
  const Constants& c = common_.constants;
  std::vector<double> area(p_.x.size());  // m^(Dim − 1)
  for (const MeshFacet& facet : boundary_of(mesh_)) {
    const auto at = [&](int k) { return mesh_.x[facet.node[k]]; };
    const double own = Dim == 2 ? distance_between(at(0), at(1), 2)
                                : distance_between(vector_area({at(0), at(1), at(2), at(3)}), {}, 3);
    constexpr int corners = Dim == 2 ? 2 : 4;
    for (int k = 0; k < corners; ++k) area[facet.node[k]] += own / corners;
  }
  for (int i = 0; i < p_.size(); ++i) {
    const Elasticity& e = input.materials[p_.material[i]];
    const double M = e.K + 4.0 / 3 * e.G;
    contact_rate_ =
        std::max(contact_rate_, 2 * surface_stiffness(M, M, c.contact_stiffness, c.dp) * area[i] / p_.m[i]);
  }
}

template <int Dim>
double FiniteElements<Dim>::step_size() const {
  const double rate = rate_ + (common_.contact.acting() ? contact_rate_ : 0);
  return common_.fixed_or_stable_step(2 * common_.constants.cfl / std::sqrt(rate));
}

template <int Dim>
void FiniteElements<Dim>::update_rate() {
  rate_ = kernels_.rate(f_, common_.threads_now());
  if (first_rate_ == 0) first_rate_ = rate_;
  if (!(rate_ <= greatest_rate_ratio * first_rate_)) throw_crushed();
}

/// Throws NumericalError with the first node of the most crushed element, or of the first with J = NaN.
template <int Dim>
void FiniteElements<Dim>::throw_crushed() const {
  const int N = mesh_.nodes_of_each();
  std::vector<int> groups(f_.groups);
  std::iota(groups.begin(), groups.end(), 0);
  int worst = 0;
  double least = std::numeric_limits<double>::infinity();
  with_strains(groups, [&](int element, const auto& F_at) {
    for (int q = 0; q < N; ++q)
      if (const double J = determinant(F_at(q)); !(J >= least) && !std::isnan(least))
        worst = element, least = J;
  });
  const int node = p_.id[mesh_.node[N * worst]];
  throw NumericalError(common_.run.steps, common_.run.time, node, "deformation",
                       fmt::format("an element at particle {} is crushed or turned inside out: "
                                   "it vibrates more than {:g} times as fast as at the start, "
                                   "or its deformation is not a number",
                                   node, std::sqrt(greatest_rate_ratio)));
}

template <int Dim>
void FiniteElements<Dim>::step(double dt) {
  if (common_.contact.prepare(p_, common_.vmax * dt)) common_.show_contacts_to_probes();
  kernels_.drift(f_, 0.5 * dt, common_.threads_now());
  common_.contact.evaluate(p_, dt, common_.threads_now());
  if (common_.run.steps % steps_per_rate == 0) update_rate();
  kernels_.elements(f_, common_.threads_now());
  const Kick<Dim> kick = common_.kick(dt, common_.run.time + dt);
  common_.set_greatest_speed(kernels_.nodes(f_, kick, common_.threads_now()));
  common_.stop_approach(0.5 * dt, [&](int i, const V& change) { p_.x[i] += (0.5 * dt) * change; });
  common_.finish_step(dt);
}

/// Calls take(element, F_at) for the elements of `groups`; F_at(q) is the current F̄ at Gauss point q.
template <int Dim>
template <class Take>
void FiniteElements<Dim>::with_strains(const std::vector<int>& groups, const Take& take) const {
  std::vector<V> u(u_.size());
  for (int i = 0; i < p_.size(); ++i) u[i] = p_.x[i] - X_[i];
  FiniteElementFields<Dim> now = f_;
  now.u = u.data();
  const int N = mesh_.nodes_of_each(), count = static_cast<int>(groups.size());
  std::vector<Mat<Pack, Dim>> F(static_cast<std::size_t>(count) * N);
  kernels_.strains(now, groups.data(), count, F.data(), common_.threads_now());
  for (int k = 0; k < count; ++k)
    for (int lane = 0; lane < std::min(lanes, mesh_.size() - lanes * groups[k]); ++lane)
      take(lanes * groups[k] + lane, [&, k, lane](int q) { return lane_of(F[k * N + q], lane); });
}

template <int Dim>
void FiniteElements<Dim>::show(Snapshot& out, std::span<const int> groups) const {
  with_order(mesh_.order, [&]<int n>(std::integral_constant<int, n>) {
    constexpr int N = power_of(n, Dim), tensor = Sym<double, Dim>::size;
    // volume-weighted means over the elements of a node: σ, σ_zz, J; sums: energy, volume
    constexpr int zz = tensor, of_J = tensor + 1, of_energy = tensor + 2, of_volume = tensor + 3;
    std::vector<std::array<double, tensor + 4>> nodal(p_.x.size());
    const std::vector<int> of_elements = element_groups(groups);
    with_strains(of_elements, [&](int e, const auto& F_at) {
      std::array<std::array<double, tensor + 2>, N> at_points;
      double energy = 0, volume = 0;
      materials_.visit(mesh_.material[e], [&](const auto& law) {
        for (int q = 0; q < N; ++q) {
          const Mat<double, Dim> F = F_at(q);
          const double J = determinant(F), weight = weight_of<n, Dim>(points_, e, q);
          const auto [sigma, sigma_zz] = law.cauchy(F, J);
          std::copy_n(sigma.c, tensor, at_points[q].begin());
          at_points[q][zz] = sigma_zz, at_points[q][of_J] = J;
          energy += weight * law.energy(F, J), volume += weight;
        }
      });
      for (int a = 0; a < N; ++a) {
        auto& sum = nodal[mesh_.node[N * e + a]];
        for (int q = 0; q < N; ++q) {
          double shape = volume;
          for (int axis = 0; axis < Dim; ++axis)
            shape *= LineElement<n>::at_nodes[index_along(axis, a, n)][index_along(axis, q, n)];
          for (int k = 0; k <= of_J; ++k) sum[k] += shape * at_points[q][k];
        }
        sum[of_energy] += energy * mesh_.volume[N * e + a] / volume;
        sum[of_volume] += volume;
      }
    });
    out.strain_energy.resize(out.size());
    for (const int group : groups)
      for (int i = lanes * group; i < std::min(lanes * (group + 1), p_.size()); ++i) {
        auto mean = nodal[i];
        for (int k = 0; k <= of_J; ++k) mean[k] /= mean[of_volume];
        Sym<double, Dim> s;
        std::copy_n(mean.begin(), tensor, s.c);
        const double p = -(trace(s) + mean[zz]) / 3;
        for (int k = 0; k < Dim; ++k) s(k, k) += p;
        const double rho0 = p_.m[i] / common_.initial.V0[p_.id[i]];
        common_.store(out, i, rho0 / mean[of_J], p, s, mean[zz] + p);
        out.strain_energy[p_.id[i]] = mean[of_energy];
      }
  });
}

template <int Dim>
std::vector<int> FiniteElements<Dim>::element_groups(std::span<const int> of_nodes) const {
  const int N = mesh_.nodes_of_each();
  std::vector<int> all;
  for (const int group : of_nodes)
    for (int i = lanes * group; i < std::min(lanes * (group + 1), p_.size()); ++i)
      for (int k = begin_[i]; k < begin_[i + 1]; ++k) all.push_back(slot_[k] / (N * Dim * lanes));
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

template <int Dim>
bool FiniteElements<Dim>::show_motion(Snapshot& out) const {
  common_.begin_motion(out);
  out.strain_energy.assign(out.size(), 0);
  for (int i = 0; i < p_.size(); ++i) common_.store_motion(out, i);
  std::vector<int> groups(f_.groups);
  std::iota(groups.begin(), groups.end(), 0);
  with_order(mesh_.order, [&]<int n>(std::integral_constant<int, n>) {
    constexpr int N = power_of(n, Dim);
    with_strains(groups, [&](int e, const auto& F_at) {
      double energy = 0, volume = 0;
      materials_.visit(mesh_.material[e], [&](const auto& law) {
        for (int q = 0; q < N; ++q) {
          const Mat<double, Dim> F = F_at(q);
          const double weight = weight_of<n, Dim>(points_, e, q);
          energy += weight * law.energy(F, determinant(F)), volume += weight;
        }
      });
      for (int a = 0; a < N; ++a)
        out.strain_energy[p_.id[mesh_.node[N * e + a]]] += energy * mesh_.volume[N * e + a] / volume;
    });
  });
  return true;
}

std::unique_ptr<Simulation> finite_elements::make(const SolverInput& input) {
  const auto made = [&]<int Dim>() {
    const auto& kernels = kernels_for<Family::finite_elements, FiniteElementKernels<Dim>, true>(input);
    return simulation_by<FiniteElements<Dim>, Dim>(input, input.constants.dp, kernels);
  };
  return input.scene.dim == 3 ? made.template operator()<3>() : made.template operator()<2>();
}

}  // namespace taut
