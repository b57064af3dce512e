#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/bonds.hpp"
#include "engine/layout.hpp"

namespace taut::test {

/// oenog written down as its formulas stand, particle by particle in the order of creation, from the bonds'
/// one-sided weights and gradients; one body. Shares with the solver what make_bonds gives and nothing else.
class NaiveOenog {
 public:
  using Places = std::vector<std::array<double, 2>>;

  NaiveOenog(const Scene& scene, double h_over_dp)
      : scene_(scene),
        layout_(make_layout(scene)),
        bonds_(make_bonds(scene, layout_, h_over_dp * scene.spacing)) {
    for (int i = 0; i < layout_.size(); ++i) {
      x.push_back({layout_.x[i][0], layout_.x[i][1]});
      v.push_back({layout_.v[i][0], layout_.v[i][1]});
    }
  }

  int size() const { return layout_.size(); }
  bool held(int i) const { return layout_.held[i]; }

  /// E = Σ V [G Σ w φ(λ) + U(det F)], G of a bond between two materials being their harmonic mean
  double energy(const Places& at) const {
    double E = 0;
    for (int i = 0; i < size(); ++i) {
      if (held(i)) continue;
      for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1]; ++b)
        E += bonds_.volume[i] * modulus(i, b) * bonds_.weight[b] * phi(stretch(at, i, b));
      E += bonds_.volume[i] * U(i, determinant(at, i));
    }
    return E;
  }

  /// −∂E/∂x, bond by bond from the side whose energy it is
  Places force(const Places& at) const {
    Places f(at.size());
    for (int i = 0; i < size(); ++i) {
      if (held(i)) continue;
      const double V = bonds_.volume[i];
      const auto F = gradient(at, i);
      const double dU = dU_dJ(i, determinant(at, i));
      for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1]; ++b) {
        const auto d = way(at, i, b);
        const double r = std::hypot(d[0], d[1]), r0 = std::hypot(bonds_.X[b][0], bonds_.X[b][1]);
        const double pull = V * modulus(i, b) * bonds_.weight[b] * dphi(r / r0) / r0;
        const Point& g = bonds_.gradient[b];
        const double volume_x = V * dU * (F[3] * g[0] - F[2] * g[1]);
        const double volume_y = V * dU * (-F[1] * g[0] + F[0] * g[1]);
        const double on_i[2] = {pull * d[0] / r + volume_x, pull * d[1] / r + volume_y};
        for (int k = 0; k < 2; ++k) {
          f[i][k] += on_i[k];
          f[bonds_.j[b]][k] -= on_i[k];  // on a held particle: not used
        }
      }
    }
    return f;
  }

  void step(double cfl) {
    double c = 0, fastest = 0;
    for (int i = 0; i < size(); ++i) {
      c = std::max(c, std::sqrt((K(i) + 4.0 / 3 * G(i)) / material(i).density));
      fastest = std::max(fastest, std::hypot(v[i][0], v[i][1]));
    }
    const double t = most_t_, stiffness = (14 + 18 * t * t + 40 * t * t * t) / 72;
    const double dt = cfl * scene_.spacing / (c + fastest) * std::min(1.0, std::sqrt(1.5 / stiffness));
    for (int i = 0; i < size(); ++i)
      for (int k = 0; k < 2; ++k) x[i][k] += dt / 2 * v[i][k];
    const Places f = force(x);
    most_t_ = 0;
    for (int i = 0; i < size(); ++i)
      for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1]; ++b)
        most_t_ = std::max(most_t_, std::pow(stretch(x, i, b), -2));
    for (int i = 0; i < size(); ++i) {
      if (held(i)) continue;
      const double m = material(i).density * layout_.V0[i];
      for (int k = 0; k < 2; ++k) {
        v[i][k] += dt * f[i][k] / m;
        x[i][k] += dt / 2 * v[i][k];
      }
    }
  }

  Places x, v;  // m, m/s

 private:
  const Material& material(int i) const { return scene_.materials[layout_.material[i]]; }
  double K(int i) const { return material(i).bulk_modulus(); }
  double G(int i) const { return material(i).shear_modulus(); }
  double modulus(int i, int b) const {
    const int j = bonds_.j[b];
    return held(j) ? G(i) : 1 / (0.5 / G(i) + 0.5 / G(j));
  }

  static double phi(double l) { return (7 * l * l + 3 / (l * l) + 2 / (l * l * l * l) - 12) / 72; }
  static double dphi(double l) { return (14 * l - 6 * std::pow(l, -3) - 8 * std::pow(l, -5)) / 72; }
  double U(int i, double J) const {
    const double k = K(i) - 5 * G(i) / 3, k3 = 56 * G(i) / 9, e = J - 1;
    const double barrier = std::log(J) - 3 * J + 3 * J * J / 2 - J * J * J / 3 + 11.0 / 6;
    return k / 2 * e * e + k3 / 6 * e * e * e - (J < 1 ? (k + k3) * barrier : 0);
  }
  double dU_dJ(int i, double J) const {
    const double k = K(i) - 5 * G(i) / 3, k3 = 56 * G(i) / 9, e = J - 1;
    return k * e + k3 / 2 * e * e - (J < 1 ? (k + k3) * std::pow(1 - J, 3) / J : 0);
  }

  /// x_j − x_i, or to the place at the clamp's face, which stands still
  std::array<double, 2> way(const Places& at, int i, int b) const {
    const int j = bonds_.j[b];
    if (!held(j)) return {at[j][0] - at[i][0], at[j][1] - at[i][1]};
    return {layout_.x[i][0] + bonds_.X[b][0] - at[i][0], layout_.x[i][1] + bonds_.X[b][1] - at[i][1]};
  }
  double stretch(const Places& at, int i, int b) const {
    const auto d = way(at, i, b);
    return std::hypot(d[0], d[1]) / std::hypot(bonds_.X[b][0], bonds_.X[b][1]);
  }
  std::array<double, 4> gradient(const Places& at, int i) const {
    std::array<double, 4> F{};
    for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1]; ++b) {
      const auto d = way(at, i, b);
      for (int a = 0; a < 2; ++a)
        for (int k = 0; k < 2; ++k) F[2 * a + k] += d[a] * bonds_.gradient[b][k];
    }
    return F;
  }
  double determinant(const Places& at, int i) const {
    const auto F = gradient(at, i);
    return F[0] * F[3] - F[1] * F[2];
  }

  const Scene& scene_;
  Layout layout_;
  Bonds bonds_;
  double most_t_ = 1;  // greatest 1/λ² in the last step
};

}  // namespace taut::test
