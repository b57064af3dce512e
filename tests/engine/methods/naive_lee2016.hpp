#pragma once

// Transcription of [Lee2016]: Eq. 8–12 (stress), 29c (force), 33a–c (F, H, J), 35–38, A.1–A.5 (dissipation), 43
// (time), 45–51 (projections); contact of [TranDuc2023] Eq. 2.13. p is the momentum per initial volume.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "tests/engine/dense.hpp"
#include "tests/support/neighbor_sweep.hpp"

namespace taut::test::naive_lee {

template <int Dim>
using Vec = Eigen::Matrix<double, Dim, 1>;
template <int Dim>
using Mat = Eigen::Matrix<double, Dim, Dim>;

/// [A ⨯ B]_iI = ε_ijk ε_IJK A_jJ B_kK
inline Mat<3> tensor_cross(const Mat<3>& A, const Mat<3>& B) {
  const auto epsilon = [](int i, int j, int k) { return (i - j) * (j - k) * (k - i) / 2; };
  Mat<3> C = Mat<3>::Zero();
  for (int n = 0; n < 729; ++n) {
    const int i = n % 3, j = n / 3 % 3, k = n / 9 % 3, I = n / 27 % 3, J = n / 81 % 3, K = n / 243;
    C(i, I) += epsilon(i, j, k) * epsilon(I, J, K) * A(j, J) * B(k, K);
  }
  return C;
}

template <int Dim>
struct Particle {
  using Vector = Vec<Dim>;
  using Matrix = Mat<Dim>;
  Vector X = Vector::Zero(), x = X, p = X;
  Matrix F = Matrix::Identity(), H = F;
  double J = 1, V = 0;
  int body = 0;
  bool clamped = false;
  Matrix L = Matrix::Zero();      // gradient correction
  Vector alpha = Vector::Zero();  // Laplacian correction, with beta
  double beta = 0;
};

template <int Dim>
struct Run {
  using Vector = Vec<Dim>;
  using Matrix = Mat<Dim>;
  using Field = Vec<Dim + 1>;  // p and J
  using Particle = naive_lee::Particle<Dim>;

  struct Rates {
    Vector x, p;
    Matrix F, H;
    double J;
  };

  bool jst, with_J, with_H;
  double dp, h, cfl, rho0, K, G, contact_stiffness;
  double eps_p2, eps_p4, eps_J2, eps_J4;
  bool projection, adjoint;
  bool one_sided, J_in_deviator;
  std::vector<Particle> particles;
  double dt = 0;  // used if cfl is 0
  double time = 0;
  long contacts = 0, corners = 0;

  std::vector<std::vector<std::size_t>> lists = {};  // neighbours within 2h

  double wave_speed() const { return std::sqrt((K + 4 * G / 3) / rho0); }

  bool near(const Particle& a, const Particle& b) const {
    return &a != &b && a.body == b.body && (a.X - b.X).norm() < 2 * h;
  }
  double alpha_h() const {
    return Dim == 2 ? 7 / (4 * std::numbers::pi * h * h) : 21 / (16 * std::numbers::pi * h * h * h);
  }
  double dW(double r) const {
    const double q = r / h;
    return alpha_h() / h * -5 * q * std::pow(1 - q / 2, 3);
  }
  double ddW(double r) const {
    const double q = r / h;
    return alpha_h() / (h * h) * (-5 * std::pow(1 - q / 2, 3) + 7.5 * q * std::pow(1 - q / 2, 2));
  }
  Vector gradient(const Particle& a, const Particle& b) const {
    const Vector d = a.X - b.X;
    return a.L * (dW(d.norm()) / d.norm() * d);
  }
  double plain_laplacian(const Particle& a, const Particle& b) const {
    const double r = (a.X - b.X).norm();
    return ddW(r) + (Dim - 1) * dW(r) / r;
  }
  double laplacian(const Particle& a, const Particle& b) const {  // Eq. A.2
    const Vector r = a.X - b.X;
    return plain_laplacian(a, b) + a.alpha.dot(r) + a.beta * r.squaredNorm();
  }

  void start() {
    std::vector<Vector> X;
    for (const Particle& a : particles) X.push_back(a.X);
    lists = neighbors_within(2 * h, X);
    for (std::size_t k = 0; k < particles.size(); ++k) {
      Particle& a = particles[k];
      Matrix M = Matrix::Zero();
      Mat<Dim + 1> A = Mat<Dim + 1>::Zero();
      Field right = Field::Zero();
      right[Dim] = 2 * Dim;
      for (const std::size_t l : lists[k]) {
        const Particle& b = particles[l];
        if (!near(a, b)) continue;
        const Vector r = a.X - b.X;
        M += b.V * dW(r.norm()) / r.norm() * r * (b.X - a.X).transpose();
        Field basis;
        basis << r / dp, r.squaredNorm() / (dp * dp);
        A += b.V * basis * basis.transpose();
        right -= b.V * plain_laplacian(a, b) * dp * dp * basis;
      }
      a.L = M.inverse();
      Eigen::VectorXd terms = solution_if_any(A, right, 1e-10);
      if (terms.size() == 0) {
        terms = Field::Zero();
        terms.head<Dim>() = A.template topLeftCorner<Dim, Dim>().llt().solve(right.template head<Dim>());
        ++corners;
      }
      a.alpha = terms.head<Dim>() / (dp * dp * dp);
      a.beta = terms[Dim] / (dp * dp * dp * dp);
    }
  }

  Matrix cofactor(const Particle& a) const {
    return with_H ? a.H : Matrix(a.F.determinant() * a.F.inverse().transpose());
  }
  Matrix stress(const Particle& a) const {
    const double det = a.F.determinant(), J = with_J ? a.J : det, zeta = G / 2;
    const double j = J_in_deviator ? J : det;  // the paper has J
    const Matrix H = cofactor(a);
    const double FF = a.F.squaredNorm() + (3 - Dim);
    const double Sigma_J = -2.0 / 3 * zeta * std::pow(j, -5.0 / 3) * FF + K * (J - 1);
    return 2 * zeta * std::pow(j, -2.0 / 3) * a.F + Sigma_J * H;
  }

  /// ε₂ c h_min L[U] − ε₄ c h_min³ L′[L[U]], U = (p, J); L′ is L or its adjoint.
  std::vector<Field> dissipation() const {
    const auto L = [&](const std::vector<Field>& U) {
      std::vector<Field> out(U.size(), Field::Zero());
      for (std::size_t a = 0; a < U.size(); ++a)
        for (const std::size_t b : lists[a])
          if (near(particles[a], particles[b]))
            out[a] += particles[b].V * (U[b] - U[a]) * laplacian(particles[a], particles[b]);
      return out;
    };
    std::vector<Field> U;
    for (const Particle& a : particles) U.push_back((Field() << a.p, a.J).finished());
    const std::vector<Field> once = L(U), twice = adjoint ? adjoint_of_L(once) : L(once);
    std::vector<Field> D;
    Field e2 = Field::Constant(eps_p2), e4 = Field::Constant(eps_p4);
    e2[Dim] = eps_J2, e4[Dim] = eps_J4;
    for (std::size_t a = 0; a < U.size(); ++a)
      D.push_back(wave_speed() * (dp * e2.cwiseProduct(once[a]) - dp * dp * dp * e4.cwiseProduct(twice[a])));
    return D;
  }

  /// Adjoint of L in the inner product Σ V f·g; the paper has L.
  std::vector<Field> adjoint_of_L(const std::vector<Field>& g) const {
    std::vector<Field> out(g.size(), Field::Zero());
    for (std::size_t a = 0; a < g.size(); ++a)
      for (const std::size_t b : lists[a])
        if (near(particles[a], particles[b]))
          out[a] += particles[b].V * (laplacian(particles[b], particles[a]) * g[b] -
                                      laplacian(particles[a], particles[b]) * g[a]);
    return out;
  }

  /// Matrix of the map λ ↦ λ × z.
  static Eigen::Matrix<double, Dim, Dim == 2 ? 1 : 3> cross_matrix(const Vector& z) {
    Eigen::Matrix<double, Dim, Dim == 2 ? 1 : 3> columns;
    if constexpr (Dim == 2)
      columns << -z[1], z[0];
    else
      columns << 0, z[2], -z[1], -z[2], 0, z[0], z[1], -z[0], 0;
    return columns;
  }

  /// Eq. 47, 48 for one body.
  void project(std::vector<Vector>& T, const std::vector<Vector>& Z, int body) const {
    constexpr int unknowns = Dim + (Dim == 2 ? 1 : 3);
    Mat<unknowns> A = Mat<unknowns>::Zero();
    Vec<unknowns> right = Vec<unknowns>::Zero();
    for (std::size_t a = 0; a < T.size(); ++a) {
      if (particles[a].body != body) continue;
      Eigen::Matrix<double, Dim, unknowns> C;
      C << cross_matrix(Z[a]), Matrix::Identity();
      A += particles[a].V * C.transpose() * C;
      right -= particles[a].V * C.transpose() * T[a];
    }
    const Vec<unknowns> lambda = solution(A, right);
    for (std::size_t a = 0; a < T.size(); ++a)
      if (particles[a].body == body)
        T[a] += cross_matrix(Z[a]) * lambda.template head<unknowns - Dim>() + lambda.template tail<Dim>();
  }

  std::vector<Rates> rates(const std::vector<Vector>& Z) {
    const std::size_t n = particles.size();
    std::vector<Vector> T(n, Vector::Zero()), Dp(n, Vector::Zero());
    std::vector<double> DJ(n, 0);
    std::vector<Rates> out(n);
    for (std::size_t k = 0; k < n; ++k) {
      const Particle& a = particles[k];
      Matrix grad = Matrix::Zero();
      for (const std::size_t l : lists[k]) {
        const Particle& b = particles[l];
        if (!near(a, b)) continue;
        if (one_sided)
          T[k] -= b.V * (stress(a) + stress(b)) * gradient(a, b);  // Eq. 30, Remark 4
        else
          T[k] += b.V * (stress(b) * gradient(b, a) - stress(a) * gradient(a, b));
        grad += b.V / rho0 * (b.p - a.p) * gradient(a, b).transpose();
      }
      out[k] = {a.p / rho0, Vector::Zero(), grad, Matrix::Zero(), cofactor(a).cwiseProduct(grad).sum()};
      if constexpr (Dim == 3) out[k].H = tensor_cross(a.F, grad);
    }
    if (jst) {
      const std::vector<Field> D = dissipation();
      for (std::size_t k = 0; k < n; ++k) Dp[k] = D[k].template head<Dim>(), DJ[k] = D[k][Dim];
    }
    for (int body = 0; projection && body < 2; ++body) {
      project(T, Z, body);
      project(Dp, Z, body);
      double sum = 0, volume = 0;
      for (std::size_t k = 0; k < n; ++k)
        if (particles[k].body == body) sum += particles[k].V * DJ[k], volume += particles[k].V;
      for (std::size_t k = 0; k < n; ++k)
        if (particles[k].body == body) DJ[k] -= sum / volume;
    }
    const auto touching = neighbors_within(dp, Z);
    for (std::size_t k = 0; k < n; ++k) {
      const Particle& a = particles[k];
      Vector E = Vector::Zero();
      for (const std::size_t l : touching[k]) {
        const Particle& b = particles[l];
        const Vector d = Z[k] - Z[l];
        if (a.body == b.body || d.norm() >= dp) continue;
        ++contacts;
        E += contact_stiffness * K / 2 * std::pow(dp, Dim - 2) * (dp - d.norm()) * d.normalized() / a.V;
      }
      if (!a.clamped) out[k].p = E - T[k] + Dp[k];
      out[k].J += DJ[k];
    }
    return out;
  }

  void step() {
    double fastest = 0;
    for (const Particle& a : particles) fastest = std::max(fastest, a.p.norm() / rho0);
    if (cfl > 0) dt = cfl * h / (wave_speed() + fastest);
    const std::vector<Particle> start = particles;
    std::vector<Vector> Z;
    for (const Particle& a : particles) Z.push_back(a.x);
    const auto add = [&] {
      const std::vector<Rates> r = rates(Z);
      for (std::size_t k = 0; k < r.size(); ++k) {
        particles[k].x += dt * r[k].x;
        particles[k].p += dt * r[k].p;
        particles[k].F += dt * r[k].F;
        particles[k].H += dt * r[k].H;
        particles[k].J += dt * r[k].J;
      }
    };
    add();
    for (std::size_t k = 0; k < Z.size(); ++k)
      Z[k] = start[k].x + dt / (2 * rho0) * (start[k].p + particles[k].p);
    add();
    for (std::size_t k = 0; k < Z.size(); ++k) {
      Particle& a = particles[k];
      a.x = 0.5 * (start[k].x + a.x);
      a.p = 0.5 * (start[k].p + a.p);
      a.F = 0.5 * (start[k].F + a.F);
      a.H = 0.5 * (start[k].H + a.H);
      a.J = 0.5 * (start[k].J + a.J);
    }
    time += dt;
  }
};

}  // namespace taut::test::naive_lee
