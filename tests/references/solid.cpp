#include "tests/references/solid.hpp"

#include <algorithm>
#include <limits>
#include <string>

namespace references {
namespace {

/// Inverse and determinant.
template <int d>
std::pair<std::array<Vector<d>, d>, double> inverse(const std::array<Vector<d>, d>& matrix) {
  const Strain<d, double> parts(matrix, 0);
  std::array<Vector<d>, d> result;
  for (int i = 0; i < d; ++i)
    for (int j = 0; j < d; ++j) result[i][j] = parts.cofactor[j][i] / parts.jacobian;
  return {result, parts.jacobian};
}

/// Product of the weights of a point of an element.
template <int d>
double weight(const Rule& rule, int point) {
  double product = 1;
  for (int a = 0; a < d; ++a, point /= n) product *= rule.weights[point % n];
  return product;
}

}  // namespace

template <int d>
Solid<d>::Solid(Mesh<d> mesh, const Material& material, const Field& velocity, const Field& fixed)
    : mesh_(std::move(mesh)), material_(material) {
  const std::size_t count = mesh_.nodes.size();
  displacements_.resize(count);
  forces_.resize(count);
  masses_.resize(count);
  prepare();
  for (std::size_t node = 0; node < count; ++node) {
    velocities_.push_back(velocity(mesh_.nodes[node]));
    const Vector<d> mark = fixed(mesh_.nodes[node]);
    Vector<d> inverse_mass;
    for (int a = 0; a < d; ++a) inverse_mass[a] = mark[a] != 0 ? 0 : 1 / masses_[node];
    inverse_masses_.push_back(inverse_mass);
  }
  update_forces();
}

template <int d>
void Solid<d>::prepare() {
  const Matrix at_nodes = derivative(lobatto_.points);
  double fastest = 0;
  batches_.resize((mesh_.elements.size() + lanes - 1) / lanes);
  for (std::size_t e = 0; e < batches_.size() * lanes; ++e) {
    const bool real = e < mesh_.elements.size();
    const auto& element = mesh_.elements[real ? e : 0];
    Batch& batch = batches_[e / lanes];
    const int lane = static_cast<int>(e % lanes);
    using Scalars = std::array<double, points>;
    std::array<Scalars, d> x;
    std::array<std::array<Scalars, d>, d> dx, dx_nodes;  // ∂X_i/∂ξ_a: [i][a]
    for (int i = 0; i < d; ++i) {
      for (int p = 0; p < points; ++p) x[i][p] = mesh_.nodes[element[p]][i];
      for (int a = 0; a < d; ++a) multiply<d>(at_nodes, a, x[i].data(), dx_nodes[i][a].data());
      multiply_all<d>(to_gauss_, x[i].data());
      for (int a = 0; a < d; ++a) multiply<d>(derivative_, a, x[i].data(), dx[i][a].data());
    }
    for (int p = 0; p < points; ++p) {
      batch.nodes[p][lane] = element[p];
      std::array<Vector<d>, d> jacobian, jacobian_node;
      for (int i = 0; i < d; ++i)
        for (int a = 0; a < d; ++a) {
          jacobian[i][a] = dx[i][a][p];
          jacobian_node[i][a] = dx_nodes[i][a][p];
        }
      const auto [inverted, volume] = inverse<d>(jacobian);
      for (int a = 0; a < d; ++a)
        for (int b = 0; b < d; ++b) batch.inverse[a][b][p][lane] = inverted[a][b];
      batch.volume[p][lane] = real ? volume * weight<d>(gauss_, p) : 0;
      const auto [inverted_node, volume_node] = inverse<d>(jacobian_node);
      if (real) masses_[element[p]] += material_.density * volume_node * weight<d>(lobatto_, p);
      double squares = 0;
      for (const auto& row : inverted_node)
        for (const double value : row) squares += value * value;
      fastest = std::max(fastest, std::sqrt(squares));
    }
  }
  transit_time_ = (lobatto_.points[1] - lobatto_.points[0]) / (fastest * material_.wave_speed());
}

template <int d>
void Solid<d>::add_forces(const Batch& batch) {
  std::array<Values, d> u;
  std::array<std::array<Values, d>, d> du;  // ∂u_i/∂ξ_a: [i][a]
  for (int i = 0; i < d; ++i) {
    for (int p = 0; p < points; ++p)
      for (int lane = 0; lane < lanes; ++lane) u[i][p][lane] = displacements_[batch.nodes[p][lane]][i];
    multiply_all<d>(to_gauss_, u[i].data());
    for (int a = 0; a < d; ++a) multiply<d>(derivative_, a, u[i].data(), du[i][a].data());
  }
  Lanes energy{};
  for (int p = 0; p < points; ++p) {
    std::array<std::array<Lanes, d>, d> f;
    for (int i = 0; i < d; ++i)
      for (int b = 0; b < d; ++b) {
        f[i][b] = Lanes{} + (i == b ? 1. : 0.);
        for (int a = 0; a < d; ++a) f[i][b] += du[i][a][p] * batch.inverse[a][b][p];
      }
    energy += batch.volume[p] * stress<d, Lanes>(material_, f);
    for (int i = 0; i < d; ++i)
      for (int a = 0; a < d; ++a) {
        Lanes sum = f[i][0] * batch.inverse[a][0][p];
        for (int b = 1; b < d; ++b) sum += f[i][b] * batch.inverse[a][b][p];
        du[i][a][p] = -batch.volume[p] * sum;
      }
  }
  for (int lane = 0; lane < lanes; ++lane) strain_energy_ += energy[lane];
  for (int i = 0; i < d; ++i) {
    multiply<d>(divergence_, 0, du[i][0].data(), u[i].data());
    for (int a = 1; a < d; ++a) {
      multiply<d>(divergence_, a, du[i][a].data(), du[i][a].data());
      for (int p = 0; p < points; ++p) u[i][p] += du[i][a][p];
    }
    multiply_all<d>(from_gauss_, u[i].data());
    for (int p = 0; p < points; ++p)
      for (int lane = 0; lane < lanes; ++lane) forces_[batch.nodes[p][lane]][i] += u[i][p][lane];
  }
}

template <int d>
void Solid<d>::update_forces() {
  std::ranges::fill(forces_, Vector<d>{});
  strain_energy_ = 0;
  for (const Batch& batch : batches_) add_forces(batch);
}

template <int d>
void Solid<d>::step(double dt) {
  const std::size_t count = mesh_.nodes.size();
  const auto accelerate = [&] {
    for (std::size_t node = 0; node < count; ++node)
      for (int a = 0; a < d; ++a)
        velocities_[node][a] += dt / 2 * inverse_masses_[node][a] * forces_[node][a];
  };
  accelerate();
  for (const int node : contact_) {
    const double room = -mesh_.nodes[node][0] - displacements_[node][0];
    velocities_[node][0] = std::min(velocities_[node][0], room / dt);
  }
  for (std::size_t node = 0; node < count; ++node)
    for (int a = 0; a < d; ++a) displacements_[node][a] += dt * velocities_[node][a];
  update_forces();
  accelerate();
}

template <int d>
void Solid<d>::advance(double time, double courant) {
  const int steps = static_cast<int>(std::ceil((time - time_) / (courant * transit_time_) - 1e-9));
  const double dt = steps > 0 ? (time - time_) / steps : 0;
  for (int k = 0; k < steps; ++k) step(dt);
  time_ = time;
  if (!std::isfinite(strain_energy_))
    throw std::runtime_error("an element has folded by " + std::to_string(time) + " s");
}

template <int d>
int Solid<d>::node_at(const Vector<d>& x) const {
  for (std::size_t node = 0; node < mesh_.nodes.size(); ++node) {
    double distance = 0;
    for (int a = 0; a < d; ++a) distance = std::max(distance, std::abs(mesh_.nodes[node][a] - x[a]));
    if (distance < 1e-9) return static_cast<int>(node);
  }
  throw std::invalid_argument(
      "the mesh has no node at the point of a table column; change the mesh or the point");
}

template <int d>
Vector<d> Solid<d>::position(int node) const {
  Vector<d> x = mesh_.nodes[node];
  for (int a = 0; a < d; ++a) x[a] += displacements_[node][a];
  return x;
}

template <int d>
Vector<d> Solid<d>::mean_velocity() const {
  Vector<d> sum{};
  double mass = 0;
  for (std::size_t node = 0; node < masses_.size(); ++node) {
    mass += masses_[node];
    for (int a = 0; a < d; ++a) sum[a] += masses_[node] * velocities_[node][a];
  }
  for (double& value : sum) value /= mass;
  return sum;
}

template <int d>
double Solid<d>::energy() const {
  double sum = strain_energy_;
  for (std::size_t node = 0; node < masses_.size(); ++node)
    for (const double speed : velocities_[node]) sum += masses_[node] / 2 * speed * speed;
  return sum;
}

template class Solid<2>;
template class Solid<3>;

}  // namespace references
