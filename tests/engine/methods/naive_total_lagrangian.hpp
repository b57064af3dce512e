#pragma once

// Transcriptions of total-Lagrangian methods:
//   tl               [Lee2016] Eq. 21 (corrected gradient), 29c (internal force), 34 (F), 8–12 (neo-Hookean)
//   icb              [TranDuc2023] §2.3: N, F, ε, σ⁰, iteration for R, acceleration
//   tl-hg            [Ganzenmueller2015] for one material
//   tl-enog          [Wu2023]: Kirchhoff stress in two parts and the damping stress
//   tl-small-strain  [Zhang2020] Eq. 3, 4, 7–9; sums of Eq. 7 and 9 divided by Σ V W, so that the force has an energy
// Contact: [TranDuc2023] Eq. 2.13, for tl-small-strain [Zhang2020] Eq. 12. Time: x to mid-step, v, x to the end.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/LU>

#include "tests/engine/dense.hpp"
#include "tests/support/neighbor_sweep.hpp"

namespace taut::test::naive_reference {

enum class Method { tl, icb, small_strain, tl_st_venant_kirchhoff, tl_linear, hourglass, enog };
inline Method method_named(const std::string& name, const std::string& law) {
  if (name == "icb") return Method::icb;
  if (name == "tl-small-strain") return Method::small_strain;
  if (name == "tl-hg") return Method::hourglass;
  if (name == "tl-enog") return Method::enog;
  if (law == "st-venant-kirchhoff") return Method::tl_st_venant_kirchhoff;
  return law == "linear" ? Method::tl_linear : Method::tl;
}

template <int Dim>
using Vector = Eigen::Vector<double, Dim>;
template <int Dim>
using Matrix = Eigen::Matrix<double, Dim, Dim>;

template <int Dim>
struct Particle {
  using Place = Vector<Dim>;
  using Square = Matrix<Dim>;
  Place X = Place::Zero(), x = Place::Zero(), v = Place::Zero();
  double m = 0, V = 0;
  int body = 0;
  bool clamped = false;
  Square F = Square::Zero(), P = Square::Zero(), N = Square::Zero();  // N: renormalisation
  double s = 1;                                                       // Σ V W
  Square T = Square::Zero();                                          // Kirchhoff stress
};

template <int Dim>
struct Run {
  using Vector = naive_reference::Vector<Dim>;
  using Matrix = naive_reference::Matrix<Dim>;
  using Particle = naive_reference::Particle<Dim>;

  Method method;
  double dp, h, cfl, rho0, K, G, contact_stiffness;
  std::vector<Particle> particles;
  double time = 0;
  long contacts = 0;  // ordered pairs, summed over steps
  std::vector<std::vector<std::size_t>> near = {}, touching = {};
  double alpha = 0, shear_factor = 0, damping = 0;

  double support() const { return (1 - 1e-9) * (small() ? 3 * h : 2 * h); }
  bool small() const { return method == Method::small_strain; }
  bool linear() const { return small() || method == Method::tl_linear; }
  double W(double r) const {
    if (r >= support()) return 0;
    if (small()) return gauss() * std::exp(-r * r / (h * h));
    const double q = r / h;
    if (method != Method::icb) return wendland() * std::pow(1 - q / 2, 4) * (1 + 2 * q);
    return sinc_norm() * std::pow(sinc(q), 5);
  }
  double dW(double r) const {
    if (r >= support()) return 0;
    if (small()) return -2 * r / (h * h) * W(r);
    const double q = r / h;
    if (method != Method::icb) return -5 * wendland() / h * q * std::pow(1 - q / 2, 3);
    const double y = std::numbers::pi * q / 2;
    const double slope = (std::cos(y) / y - std::sin(y) / (y * y)) * std::numbers::pi / 2;
    return sinc_norm() / h * 5 * std::pow(sinc(q), 4) * slope;
  }
  /// 1 / integral of the Gaussian up to 3 h.
  double gauss() const {
    constexpr double pi = std::numbers::pi;
    if (Dim == 2) return 1 / (pi * h * h) / (1 - std::exp(-9.0));
    return 1 / (std::pow(pi, 1.5) * h * h * h) / (std::erf(3) - 6 / std::sqrt(pi) * std::exp(-9.0));
  }
  double wendland() const {
    return Dim == 2 ? 7 / (4 * std::numbers::pi * h * h) : 21 / (16 * std::numbers::pi * h * h * h);
  }
  double sinc_norm() const {
    if (Dim == 2) return 0.710379463738679282 / (h * h);
    static const double integral = [] {
      constexpr int n = 2000;
      double sum = 0;
      for (int k = 1; k < n; ++k) {
        const double q = 2.0 * k / n;
        sum += (k % 2 == 1 ? 4 : 2) * q * q * std::pow(sinc(q), 5);
      }
      return 4 * std::numbers::pi * sum * 2.0 / n / 3;
    }();
    return 1 / (integral * h * h * h);
  }
  static double sinc(double q) {
    const double y = std::numbers::pi * q / 2;
    return y == 0 ? 1 : std::sin(y) / y;
  }

  /// False beyond the support, for another body or for i itself.
  bool gradient(const Particle& i, const Particle& j, Vector& g) const {
    if (&i == &j || i.body != j.body) return false;
    const Vector d = i.X - j.X;
    const double r = d.norm();
    if (r >= support()) return false;
    g = dW(r) / r * d;
    return true;
  }

  template <class Position>
  std::vector<std::vector<std::size_t>> within(double reach, const Position& position) const {
    std::vector<Vector> places;
    for (const Particle& i : particles) places.push_back(i.*position);
    return neighbors_within(reach, places);
  }
  const std::vector<std::size_t>& of(const std::vector<std::vector<std::size_t>>& lists,
                                     const Particle& i) const {
    return lists[static_cast<std::size_t>(&i - particles.data())];
  }

  void start() {
    near = within(support(), &Particle::X);
    for (Particle& i : particles) {
      Matrix A = Matrix::Zero();
      i.s = i.V * W(0);
      for (const std::size_t n : of(near, i)) {
        const Particle& j = particles[n];
        Vector g;
        if (!gradient(i, j, g)) continue;
        i.s += j.V * W((i.X - j.X).norm());
        A += j.V * (j.X - i.X) * g.transpose();
      }
      i.N = A.inverse();
      if (method == Method::small_strain) i.N = Matrix::Identity() / i.s;
    }
  }

  /// In 2D the iteration of [TranDuc2023] §2.3, which adds Σ r_j × a_j / Σ r_j·a_j to the angle of R. In 3D the polar
  /// rotation.
  static Matrix rotation(const Matrix& A) {
    if constexpr (Dim == 3) {
      return rotation_by_singular_values(A);
    } else {
      double angle = std::atan2(A(1, 0), A(0, 0));
      for (int k = 0; k < 60; ++k) {
        const double c = std::cos(angle), s = std::sin(angle);
        const Vector r1{c, s}, r2{-s, c};
        const double cross = r1[0] * A(1, 0) - r1[1] * A(0, 0) + r2[0] * A(1, 1) - r2[1] * A(0, 1);
        angle += cross / (r1.dot(A.col(0)) + r2.dot(A.col(1)));
      }
      Matrix R;
      R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
      return R;
    }
  }

  Matrix stress(const Matrix& F) const {
    const Matrix one = Matrix::Identity();
    if (method == Method::tl || method == Method::hourglass || method == Method::enog) {
      const double J = F.determinant(), FF = F.squaredNorm() + (3 - Dim);
      const double zeta = G / 2, Sigma_J = -2.0 / 3 * zeta * std::pow(J, -5.0 / 3) * FF + K * (J - 1);
      const Matrix H = J * F.inverse().transpose();
      return 2 * zeta * std::pow(J, -2.0 / 3) * F + Sigma_J * H;
    }
    const Matrix e = linear() ? Matrix(0.5 * (F + F.transpose()) - one) : 0.5 * (F.transpose() * F - one);
    const Matrix sigma = 2 * G * (e - e.trace() / 3 * one) + K * e.trace() * one;
    return linear() ? sigma : (method == Method::icb ? rotation(F) : F) * sigma;
  }

  void deform() {
    for (Particle& i : particles) {
      i.F.setZero();
      if (small()) i.F.setIdentity();
      for (const std::size_t n : of(near, i)) {
        const Particle& j = particles[n];
        Vector g;
        if (!gradient(i, j, g)) continue;
        const Vector Ng = i.N * g;
        for (int a = 0; a < Dim; ++a) {
          const double difference = j.x[a] - i.x[a] - (small() ? j.X[a] - i.X[a] : 0);
          for (int b = 0; b < Dim; ++b) i.F(a, b) += j.V * difference * Ng[b];
        }
      }
      i.P = stress(i.F);
      if (method == Method::enog) i.T = kirchhoff_on_particle(i);
    }
  }

  /// Volumetric stress, isotropic part −c G J^(−2/3) tr b/3 of the deviator (c: shear_factor), damping χ/2 db/dt.
  Matrix kirchhoff_on_particle(const Particle& i) const {
    Matrix rate = Matrix::Zero();
    for (const std::size_t n : of(near, i)) {
      const Particle& j = particles[n];
      if (Vector g; gradient(i, j, g)) rate += j.V * (j.v - i.v) * (i.N * g).transpose();
    }
    const double J = i.F.determinant(), trace_b = (i.F * i.F.transpose()).trace() + (3 - Dim);
    const double chi = damping * rho0 * std::sqrt(K / rho0) * h / 2;
    const Matrix db = rate * i.F.transpose() + i.F * rate.transpose();
    return (K * J * (J - 1) - shear_factor * G * std::pow(J, -2.0 / 3) * trace_b / 3) * Matrix::Identity() +
           chi / 2 * db;
  }

  Vector enog_force(const Particle& i, const Particle& j, const Vector& g) const {
    const double slope = dW((i.X - j.X).norm()) / (i.X - j.X).norm();
    const double shear =
        shear_factor * G * (std::pow(i.F.determinant(), -2.0 / 3) + std::pow(j.F.determinant(), -2.0 / 3));
    return i.V * j.V *
           ((i.T * i.F.inverse().transpose() + j.T * j.F.inverse().transpose()) * g +
            shear * slope * (i.x - j.x));
  }

  Vector hourglass(const Particle& i, const Particle& j) const {
    const Vector X = i.X - j.X, x = i.x - j.x, e = x.normalized();
    const double E = 9 * K * G / (3 * K + G);
    const double excess = (i.F * X - x).dot(e) + (j.F * X - x).dot(e);
    return 0.5 * alpha * E * i.V * j.V * W(X.norm()) / X.squaredNorm() * excess * e;
  }

  Vector force(const Particle& i) {
    Vector f = Vector::Zero();
    for (const std::size_t n : of(near, i)) {
      const Particle& j = particles[n];
      Vector g;
      if (!gradient(i, j, g)) continue;
      f += method == Method::enog ? enog_force(i, j, g)
                                  : Vector(i.V * j.V * (i.P * (i.N * g) + j.P * (j.N * g)));
      if (method == Method::hourglass) f += hourglass(i, j);
    }
    for (const std::size_t n : of(touching, i)) {
      const Particle& j = particles[n];
      const Vector d = i.x - j.x;
      const double r = d.norm();
      if (i.body == j.body || r >= dp) continue;
      ++contacts;
      const double modulus = contact_stiffness * K / 2, l = dp / r;
      const double push = small() ? modulus * std::pow(dp, Dim) / 2 * (std::pow(l, 6) - std::pow(l, 4)) / r
                                  : modulus * std::pow(dp, Dim - 2) * (dp - r);
      f += push / r * d;
    }
    return f;
  }

  void step() {
    double fastest = 0;
    for (const Particle& i : particles) fastest = std::max(fastest, i.v.norm());
    const double dt = cfl * h / (std::sqrt((K + 4 * G / 3) / rho0) + fastest);
    for (Particle& i : particles) i.x += dt / 2 * i.v;
    deform();
    touching = within(dp, &Particle::x);
    std::vector<Vector> f;
    for (const Particle& i : particles) f.push_back(force(i));
    for (std::size_t n = 0; n < particles.size(); ++n) {
      Particle& i = particles[n];
      if (!i.clamped) i.v += dt / i.m * f[n];
      i.x += dt / 2 * i.v;
    }
    time += dt;
  }
};

}  // namespace taut::test::naive_reference
