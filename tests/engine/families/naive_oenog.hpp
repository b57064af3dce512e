#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/families/bonded/bonds.hpp"
#include "engine/scene/initial_particles.hpp"

namespace taut::test {

/// A number and its slopes in the four components of F, by the rules of differentiation.
struct Dual {
  double value = 0;
  std::array<double, 4> slope{};

  Dual() = default;
  Dual(double v) : value(v) {}  // NOLINT: a constant
  static Dual variable(double v, int k) {
    Dual d(v);
    d.slope[k] = 1;
    return d;
  }
  Dual combined(double v, double of_this, const Dual& b, double of_b) const {
    Dual r(v);
    for (int k = 0; k < 4; ++k) r.slope[k] = of_this * slope[k] + of_b * b.slope[k];
    return r;
  }
  Dual operator+(const Dual& b) const { return combined(value + b.value, 1, b, 1); }
  Dual operator-(const Dual& b) const { return combined(value - b.value, 1, b, -1); }
  Dual operator*(const Dual& b) const { return combined(value * b.value, b.value, b, value); }
  Dual operator/(const Dual& b) const {
    return combined(value / b.value, 1 / b.value, b, -value / (b.value * b.value));
  }
  Dual to(double power) const {
    return combined(std::pow(value, power), power * std::pow(value, power - 1), {}, 0);
  }
};
inline Dual operator*(double a, const Dual& b) { return Dual(a) * b; }
inline Dual operator/(double a, const Dual& b) { return Dual(a) / b; }

/// oenog written down as its formulas stand, particle by particle in the order of creation, from the bonds'
/// one-sided weights and gradients; one body. Shares with the solver what make_bonds gives and nothing else.
class NaiveOenog {
 public:
  using Places = std::vector<std::array<double, 2>>;

  NaiveOenog(const Scene& scene, double h_over_dp)
      : NaiveOenog(scene, make_initial_particles(scene), h_over_dp) {}
  NaiveOenog(const Scene& scene, const InitialParticles& initial, double h_over_dp)
      : scene_(scene), initial_(initial), bonds_(make_bonds(scene, initial_, h_over_dp * scene.spacing)) {
    for (int i = 0; i < initial_.size(); ++i) {
      x.push_back({initial_.x[i][0], initial_.x[i][1]});
      v.push_back({initial_.v[i][0], initial_.v[i][1]});
    }
  }

  int size() const { return initial_.size(); }
  bool held(int i) const { return initial_.held[i]; }

  /// E = Σ [V W(F) + V0 G Σ w (φ(λ) − φ(λ°))], G of a bond between two materials being their harmonic mean;
  /// λ° within ½ and 2
  double energy(const Places& at) const {
    double E = 0;
    for (int i = 0; i < size(); ++i) {
      if (held(i)) continue;
      const auto F = gradient(at, i);
      for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1]; ++b)
        E += strength(i, b) * (phi(stretch(at, i, b)) - phi(std::sqrt(affine(b, duals(F)).value)));
      E += bonds_.volume[i] * W(i, duals(F)).value;
    }
    return E;
  }

  /// −∂E/∂x, bond by bond from the side whose energy it is
  Places force(const Places& at) const {
    Places f(at.size());
    for (int i = 0; i < size(); ++i) {
      if (held(i)) continue;
      const auto F = duals(gradient(at, i));
      Dual left = bonds_.volume[i] * W(i, F);
      for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1]; ++b) {
        const Dual s = affine(b, F);
        left = left - strength(i, b) / 24 * (2.0 * s * s - 3.0 * s + 1 / s);
      }
      for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1]; ++b) {
        const auto d = way(at, i, b);
        const double r = std::hypot(d[0], d[1]), r0 = std::hypot(bonds_.X[b][0], bonds_.X[b][1]);
        const double pull = strength(i, b) * dphi(r / r0) / r0;
        const Point& g = bonds_.gradient[b];
        const auto& T = left.slope;
        const double on_i[2] = {pull * d[0] / r + T[0] * g[0] + T[1] * g[1],
                                pull * d[1] / r + T[2] * g[0] + T[3] * g[1]};
        for (int k = 0; k < 2; ++k) {
          f[i][k] += on_i[k];
          f[bonds_.j[b]][k] -= on_i[k];  // on a held particle: not used
        }
      }
    }
    return f;
  }

  /// Of the dashpots, V0 G w τ q̇/r0² (x_j − x_i) for each bond from either side, q = ½ (r²/r0² − 1)
  Places drag(double damping) const {
    double shear_speed = 0;
    for (int i = 0; i < size(); ++i)
      shear_speed = std::max(shear_speed, std::sqrt(G(i) / material(i).density));
    const double tau = damping * scene_.spacing / shear_speed;
    Places f(x.size());
    for (int i = 0; i < size(); ++i) {
      for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1] && !held(i); ++b) {
        const int j = bonds_.j[b];
        const auto d = way(x, i, b);
        const double r0 = std::hypot(bonds_.X[b][0], bonds_.X[b][1]);
        const double vx = (held(j) ? 0 : v[j][0]) - v[i][0], vy = (held(j) ? 0 : v[j][1]) - v[i][1];
        const double rate = (d[0] * vx + d[1] * vy) / (r0 * r0);
        const double k = strength(i, b) / (r0 * r0);
        for (int a = 0; a < 2; ++a) {
          f[i][a] += k * tau * rate * d[a];
          f[j][a] -= k * tau * rate * d[a];
        }
      }
    }
    return f;
  }

  void step(double cfl, double damping) {
    double c = 0, fastest = 0;
    for (int i = 0; i < size(); ++i) {
      c = std::max(c, std::sqrt((K(i) + 4.0 / 3 * G(i)) / material(i).density));
      fastest = std::max(fastest, std::hypot(v[i][0], v[i][1]));
    }
    const double dt = cfl * scene_.spacing / (c + fastest) * std::min(1.0, std::sqrt(1.5 / stiffest_));
    for (int i = 0; i < size(); ++i)
      for (int k = 0; k < 2; ++k) x[i][k] += dt / 2 * v[i][k];
    const Places f = force(x), dashpots = drag(damping);
    stiffest_ = 0;
    for (int i = 0; i < size(); ++i)
      for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1]; ++b) {
        const double l = stretch(x, i, b);
        stiffest_ = std::max(stiffest_, (24 * l * l - 6 + 6 * std::pow(l, -4)) / 24);  // φ″
      }
    for (int i = 0; i < size(); ++i) {
      if (held(i)) continue;
      const double m = material(i).density * initial_.V0[i];
      for (int k = 0; k < 2; ++k) {
        v[i][k] += dt * (f[i][k] + dashpots[i][k]) / m;
        x[i][k] += dt / 2 * v[i][k];
      }
    }
  }

  Places x, v;  // m, m/s

 private:
  const Material& material(int i) const { return scene_.materials[initial_.material[i]]; }
  double K(int i) const { return material(i).bulk_modulus(); }
  double G(int i) const { return material(i).shear_modulus(); }
  double modulus(int i, int b) const {
    const int j = bonds_.j[b];
    return held(j) ? G(i) : 1 / (0.5 / G(i) + 0.5 / G(j));
  }

  static double phi(double l) { return (2 * std::pow(l, 4) - 3 * l * l + std::pow(l, -2)) / 24; }
  static double dphi(double l) { return (8 * std::pow(l, 3) - 6 * l - 2 * std::pow(l, -3)) / 24; }

  double strength(int i, int b) const {  // J
    return initial_.V0[i] * modulus(i, b) * bonds_.weight[b];
  }
  using Duals = std::array<Dual, 4>;
  static Duals duals(const std::array<double, 4>& components) {
    Duals F;
    for (int k = 0; k < 4; ++k) F[k] = Dual::variable(components[k], k);
    return F;
  }
  /// s° of a bond, with its slopes in F
  Dual affine(int b, const Duals& F) const {
    const Point& X = bonds_.X[b];
    const Dual x = F[0] * X[0] + F[1] * X[1], y = F[2] * X[0] + F[3] * X[1];
    return (x * x + y * y) / Dual(X[0] * X[0] + X[1] * X[1]);
  }
  /// The neo-Hookean energy with its slopes in F; J ≥ ½
  Dual W(int i, const Duals& F) const {
    const Dual J = F[0] * F[3] - F[1] * F[2];
    const Dual C = F[0] * F[0] + F[1] * F[1] + F[2] * F[2] + F[3] * F[3];
    return G(i) / 2 * (J.to(-2.0 / 3) * (C + 1) - 3) + K(i) / 2 * (J - 1) * (J - 1);
  }

  /// x_j − x_i, or to the place at the clamp's face, which stands still
  std::array<double, 2> way(const Places& at, int i, int b) const {
    const int j = bonds_.j[b];
    if (!held(j)) return {at[j][0] - at[i][0], at[j][1] - at[i][1]};
    return {initial_.x[i][0] + bonds_.X[b][0] - at[i][0], initial_.x[i][1] + bonds_.X[b][1] - at[i][1]};
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
  const Scene& scene_;
  InitialParticles initial_;
  Bonds bonds_;
  double stiffest_ = 1;  // greatest φ″ in the last step
};

}  // namespace taut::test
