#pragma once

// Total-Lagrangian methods written down from the papers, by pairs and without any thought of speed:
//   tl   [Lee2016] Eq. 21 (corrected gradient), 29c (internal force), 34 (F), 8–12 (neo-Hookean, P by Σ_F,
//   Σ_J, H) icb  [TranDuc2023] §2.3: N, F, ε, σ⁰, the iteration towards R, the acceleration tl-small-strain
//   [Zhang2020] Eq. 3, 4, 7–9, with the sums of Eq. 7 and 9 normalised as energy asks for
// tl with St Venant–Kirchhoff's and the linear law, and the contacts of [TranDuc2023] Eq. 2.13 and, for
// tl-small-strain, [Zhang2020] Eq. 12. Time: x to mid-step, v, x to the end.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace taut::test::naive_reference {

enum class Method { tl, icb, small_strain, tl_st_venant_kirchhoff, tl_linear };

using Vector = std::array<double, 2>;
using Matrix = std::array<std::array<double, 2>, 2>;

struct Particle {
  Vector X{}, x{}, v{};
  double m = 0, V = 0;
  int body = 0;
  bool held = false;
  Matrix F{}, P{}, N{};  // N: the renormalisation, dimensionless
  double s = 1;          // Σ V W
};

inline double det(const Matrix& A) { return A[0][0] * A[1][1] - A[0][1] * A[1][0]; }
inline Matrix times(const Matrix& A, const Matrix& B) {
  Matrix C{};
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) C[a][b] = A[a][0] * B[0][b] + A[a][1] * B[1][b];
  return C;
}
inline Vector times(const Matrix& A, const Vector& v) {
  return {A[0][0] * v[0] + A[0][1] * v[1], A[1][0] * v[0] + A[1][1] * v[1]};
}

struct Run {
  Method method;
  double dp, h, cfl, rho0, K, G, contact_stiffness;
  std::vector<Particle> particles;
  double time = 0;
  long contacts = 0;  // pairs of two bodies that pressed on each other, over all steps

  // kernels of the methods: Wendland C2 (tl), sinc⁵ (icb), Gauss cut off at 3 h (small strain)
  double support() const { return (1 - 1e-9) * (small() ? 3 * h : 2 * h); }
  bool small() const { return method == Method::small_strain; }
  bool linear() const { return small() || method == Method::tl_linear; }
  double W(double r) const {
    if (r >= support()) return 0;
    if (small()) return std::exp(-r * r / (h * h)) / (std::numbers::pi * h * h) / (1 - std::exp(-9.0));
    const double q = r / h;
    if (method != Method::icb)
      return 7 / (4 * std::numbers::pi * h * h) * std::pow(1 - q / 2, 4) * (1 + 2 * q);
    return 0.710379463738679282 / (h * h) * std::pow(sinc(q), 5);
  }
  double dW(double r) const {
    if (r >= support()) return 0;
    if (small()) return -2 * r / (h * h) * W(r);
    const double q = r / h;
    if (method != Method::icb) return -35 / (4 * std::numbers::pi * h * h * h) * q * std::pow(1 - q / 2, 3);
    const double y = std::numbers::pi * q / 2;
    const double slope = (std::cos(y) / y - std::sin(y) / (y * y)) * std::numbers::pi / 2;
    return 0.710379463738679282 / (h * h * h) * 5 * std::pow(sinc(q), 4) * slope;
  }
  static double sinc(double q) {
    const double y = std::numbers::pi * q / 2;
    return y == 0 ? 1 : std::sin(y) / y;
  }

  /// ∇_i W_ij of the start; false beyond the support or in another body.
  bool gradient(const Particle& i, const Particle& j, Vector& g) const {
    if (&i == &j || i.body != j.body) return false;
    const Vector d{i.X[0] - j.X[0], i.X[1] - j.X[1]};
    const double r = std::hypot(d[0], d[1]);
    if (r >= support()) return false;
    g = {dW(r) * d[0] / r, dW(r) * d[1] / r};
    return true;
  }

  void start() {
    for (Particle& i : particles) {
      Matrix A{};
      i.s = i.V * W(0);
      for (const Particle& j : particles) {
        Vector g;
        if (!gradient(i, j, g)) continue;
        i.s += j.V * W(std::hypot(i.X[0] - j.X[0], i.X[1] - j.X[1]));
        for (int a = 0; a < 2; ++a)
          for (int b = 0; b < 2; ++b) A[a][b] += j.V * (j.X[a] - i.X[a]) * g[b];
      }
      const double D = det(A);
      i.N = {{{A[1][1] / D, -A[0][1] / D}, {-A[1][0] / D, A[0][0] / D}}};
      if (method == Method::small_strain) i.N = {{{1 / i.s, 0}, {0, 1 / i.s}}};
    }
  }

  /// [TranDuc2023] §2.3: R ← E(v, α) R with v = Σ r_j × a_j / Σ r_j·a_j, in the plane.
  static Matrix rotation(const Matrix& A) {
    double angle = std::atan2(A[1][0], A[0][0]);
    for (int k = 0; k < 60; ++k) {
      const double c = std::cos(angle), s = std::sin(angle);
      const Vector r1{c, s}, r2{-s, c};
      const double cross = r1[0] * A[1][0] - r1[1] * A[0][0] + r2[0] * A[1][1] - r2[1] * A[0][1];
      const double inner = r1[0] * A[0][0] + r1[1] * A[1][0] + r2[0] * A[0][1] + r2[1] * A[1][1];
      angle += cross / inner;
    }
    return {{{std::cos(angle), -std::sin(angle)}, {std::sin(angle), std::cos(angle)}}};
  }

  Matrix stress(const Matrix& F) const {
    if (method == Method::tl) {
      const double J = det(F);
      const double FF = F[0][0] * F[0][0] + F[0][1] * F[0][1] + F[1][0] * F[1][0] + F[1][1] * F[1][1] + 1;
      const double zeta = G / 2, Sigma_J = -2.0 / 3 * zeta * std::pow(J, -5.0 / 3) * FF + K * (J - 1);
      const Matrix H{{{F[1][1], -F[1][0]}, {-F[0][1], F[0][0]}}};
      Matrix P;
      for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b) P[a][b] = 2 * zeta * std::pow(J, -2.0 / 3) * F[a][b] + Sigma_J * H[a][b];
      return P;
    }
    Matrix e{};
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b)
        e[a][b] = linear() ? 0.5 * (F[a][b] + F[b][a]) - (a == b ? 1 : 0)
                           : 0.5 * (F[0][a] * F[0][b] + F[1][a] * F[1][b] - (a == b ? 1 : 0));
    const double tr = e[0][0] + e[1][1];
    Matrix sigma{};
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b)
        sigma[a][b] = 2 * G * (e[a][b] - (a == b ? tr / 3 : 0)) + (a == b ? K * tr : 0);
    return linear() ? sigma : times(method == Method::icb ? rotation(F) : F, sigma);
  }

  void deform() {
    for (Particle& i : particles) {
      i.F = small() ? Matrix{{{1, 0}, {0, 1}}} : Matrix{};
      for (const Particle& j : particles) {
        Vector g;
        if (!gradient(i, j, g)) continue;
        const Vector Ng = times(i.N, g);
        for (int a = 0; a < 2; ++a) {
          const double difference = j.x[a] - i.x[a] - (small() ? j.X[a] - i.X[a] : 0);
          for (int b = 0; b < 2; ++b) i.F[a][b] += j.V * difference * Ng[b];
        }
      }
      i.P = stress(i.F);
    }
  }

  Vector force(const Particle& i) {
    Vector f{};
    for (const Particle& j : particles) {
      if (Vector g; gradient(i, j, g)) {
        const Vector from_i = times(i.P, times(i.N, g)), from_j = times(j.P, times(j.N, g));
        for (int a = 0; a < 2; ++a) f[a] += i.V * j.V * (from_i[a] + from_j[a]);
      }
      const Vector d{i.x[0] - j.x[0], i.x[1] - j.x[1]};
      const double r = std::hypot(d[0], d[1]);
      if (i.body == j.body || r >= dp) continue;
      ++contacts;
      const double modulus = contact_stiffness * K / 2, l = dp / r;
      const double push =
          small() ? modulus * dp * dp / 2 * (std::pow(l, 6) - std::pow(l, 4)) / r : modulus * (dp - r);
      for (int a = 0; a < 2; ++a) f[a] += push * d[a] / r;
    }
    return f;
  }

  void step() {
    double fastest = 0;
    for (const Particle& i : particles) fastest = std::max(fastest, std::hypot(i.v[0], i.v[1]));
    const double dt = cfl * h / (std::sqrt((K + 4 * G / 3) / rho0) + fastest);
    for (Particle& i : particles)
      for (int a = 0; a < 2; ++a) i.x[a] += dt / 2 * i.v[a];
    deform();
    std::vector<Vector> f;
    for (const Particle& i : particles) f.push_back(force(i));
    for (std::size_t n = 0; n < particles.size(); ++n) {
      Particle& i = particles[n];
      for (int a = 0; a < 2; ++a) {
        if (!i.held) i.v[a] += dt * f[n][a] / i.m;
        i.x[a] += dt / 2 * i.v[a];
      }
    }
    time += dt;
  }
};

}  // namespace taut::test::naive_reference
