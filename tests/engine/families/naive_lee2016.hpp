#pragma once

// The mixed methods of [Lee2016] written down from the paper, by pairs and without any thought of speed: Eq.
// 29c (internal force), 33a, 33c (F and J), 35–38 with A.1–A.5 (dissipation), 43 (time), 45–51 (projections,
// from the full system of Eq. 48), 8–12 (stress); the penalty contact of [TranDuc2023] Eq. 2.13. Everything
// goes with the momentum p per volume of the start.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Dense>

namespace taut::test::naive_lee {

using Vector = Eigen::Vector2d;
using Matrix = Eigen::Matrix2d;

struct Particle {
  Vector X = Vector::Zero(), x = X, p = X;
  Matrix F = Matrix::Identity();
  double J = 1, V = 0;
  int body = 0;
  bool held = false;
  Matrix L = Matrix::Zero();      // correction of the gradient
  Vector alpha = Vector::Zero();  // and of the Laplacian
  double beta = 0;
};

struct Rates {
  Vector x, p;
  Matrix F;
  double J;
};

struct Run {
  bool jst, with_J;
  double dp, h, cfl, rho0, K, G, contact_stiffness;
  double eps_p2, eps_p4, eps_J2, eps_J4;
  bool projection, adjoint;
  std::vector<Particle> particles;
  double time = 0;
  long contacts = 0;

  double wave_speed() const { return std::sqrt((K + 4 * G / 3) / rho0); }

  bool near(const Particle& a, const Particle& b) const {
    return &a != &b && a.body == b.body && (a.X - b.X).norm() < 2 * h;
  }
  /// Wendland C2 and its derivatives by r, α = 7/(4π h²).
  double alpha_h() const { return 7 / (4 * std::numbers::pi * h * h); }
  double dW(double r) const {
    const double q = r / h;
    return alpha_h() / h * -5 * q * std::pow(1 - q / 2, 3);
  }
  double ddW(double r) const {
    const double q = r / h;
    return alpha_h() / (h * h) * (-5 * std::pow(1 - q / 2, 3) + 7.5 * q * std::pow(1 - q / 2, 2));
  }
  /// ∇W_b(X_a) corrected
  Vector gradient(const Particle& a, const Particle& b) const {
    const Vector d = a.X - b.X;
    return a.L * (dW(d.norm()) / d.norm() * d);
  }
  double plain_laplacian(const Particle& a, const Particle& b) const {
    const double r = (a.X - b.X).norm();
    return ddW(r) + dW(r) / r;
  }
  double laplacian(const Particle& a, const Particle& b) const {  // Eq. A.2
    const Vector r = a.X - b.X;
    return plain_laplacian(a, b) + a.alpha.dot(r) + a.beta * r.squaredNorm();
  }

  void start() {
    for (Particle& a : particles) {
      Matrix M = Matrix::Zero();
      Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
      Eigen::Vector3d right(0, 0, 4);
      for (const Particle& b : particles) {
        if (!near(a, b)) continue;
        const Vector r = a.X - b.X;
        M += b.V * dW(r.norm()) / r.norm() * r * (b.X - a.X).transpose();
        const Eigen::Vector3d basis(r[0] / dp, r[1] / dp, r.squaredNorm() / (dp * dp));
        A += b.V * basis * basis.transpose();
        right -= b.V * plain_laplacian(a, b) * dp * dp * basis;
      }
      a.L = M.inverse();
      const Eigen::Vector3d solution = A.fullPivLu().solve(right) / (dp * dp);
      a.alpha = solution.head<2>() / dp;
      a.beta = solution[2] / (dp * dp);
    }
  }

  Matrix stress(const Particle& a) const {
    const double j = a.F.determinant(), J = with_J ? a.J : j, zeta = G / 2;  // the paper has J for j too
    const Matrix H = a.F.determinant() * a.F.inverse().transpose();
    const double FF = a.F.squaredNorm() + 1;
    const double Sigma_J = -2.0 / 3 * zeta * std::pow(j, -5.0 / 3) * FF + K * (J - 1);
    return 2 * zeta * std::pow(j, -2.0 / 3) * a.F + Sigma_J * H;
  }

  /// ε₂ c h_min L[U] − ε₄ c h_min³ L[L[U]] of (p_x, p_y, J).
  std::vector<Eigen::Vector3d> dissipation() const {
    const auto L = [&](const std::vector<Eigen::Vector3d>& U) {
      std::vector<Eigen::Vector3d> out(U.size(), Eigen::Vector3d::Zero());
      for (std::size_t a = 0; a < U.size(); ++a)
        for (std::size_t b = 0; b < U.size(); ++b)
          if (near(particles[a], particles[b]))
            out[a] += particles[b].V * (U[b] - U[a]) * laplacian(particles[a], particles[b]);
      return out;
    };
    std::vector<Eigen::Vector3d> U;
    for (const Particle& a : particles) U.emplace_back(a.p[0], a.p[1], a.J);
    const std::vector<Eigen::Vector3d> once = L(U), twice = adjoint ? adjoint_of_L(once) : L(once);
    std::vector<Eigen::Vector3d> D;
    const Eigen::Vector3d e2(eps_p2, eps_p2, eps_J2), e4(eps_p4, eps_p4, eps_J4);
    for (std::size_t a = 0; a < U.size(); ++a)
      D.push_back(wave_speed() * (dp * e2.cwiseProduct(once[a]) - dp * dp * dp * e4.cwiseProduct(twice[a])));
    return D;
  }

  /// Of the matrix of L with respect to Σ V; not in the paper, which has L.
  std::vector<Eigen::Vector3d> adjoint_of_L(const std::vector<Eigen::Vector3d>& g) const {
    std::vector<Eigen::Vector3d> out(g.size(), Eigen::Vector3d::Zero());
    for (std::size_t a = 0; a < g.size(); ++a)
      for (std::size_t b = 0; b < g.size(); ++b)
        if (near(particles[a], particles[b]))
          out[a] += particles[b].V * (laplacian(particles[b], particles[a]) * g[b] -
                                      laplacian(particles[a], particles[b]) * g[a]);
    return out;
  }

  /// Eq. 47, 48 in the plane, for one body: unknowns λ_ang and λ_lin.
  void project(std::vector<Vector>& T, const std::vector<Vector>& Z, int body) const {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    const auto column = [](const Vector& z) { return Vector(-z[1], z[0]); };  // e_z × Z
    for (std::size_t a = 0; a < T.size(); ++a) {
      if (particles[a].body != body) continue;
      Eigen::Matrix<double, 2, 3> C;
      C << column(Z[a]), Matrix::Identity();
      A += particles[a].V * C.transpose() * C;
      right -= particles[a].V * C.transpose() * T[a];
    }
    const Eigen::Vector3d lambda = A.fullPivLu().solve(right);
    for (std::size_t a = 0; a < T.size(); ++a)
      if (particles[a].body == body) T[a] += lambda[0] * column(Z[a]) + lambda.tail<2>();
  }

  std::vector<Rates> rates(const std::vector<Vector>& Z) {
    const std::size_t n = particles.size();
    std::vector<Vector> T(n, Vector::Zero()), Dp(n, Vector::Zero());
    std::vector<double> DJ(n, 0);
    std::vector<Rates> out(n);
    for (std::size_t k = 0; k < n; ++k) {
      const Particle& a = particles[k];
      Matrix grad = Matrix::Zero();
      for (const Particle& b : particles) {
        if (!near(a, b)) continue;
        T[k] += b.V * (stress(b) * gradient(b, a) - stress(a) * gradient(a, b));
        grad += b.V / rho0 * (b.p - a.p) * gradient(a, b).transpose();
      }
      out[k] = {a.p / rho0, Vector::Zero(), grad,
                (a.F.determinant() * a.F.inverse().transpose()).cwiseProduct(grad).sum()};
    }
    if (jst) {
      const std::vector<Eigen::Vector3d> D = dissipation();
      for (std::size_t k = 0; k < n; ++k) Dp[k] = D[k].head<2>(), DJ[k] = D[k][2];
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
    for (std::size_t k = 0; k < n; ++k) {
      const Particle& a = particles[k];
      Vector E = Vector::Zero();
      for (std::size_t l = 0; l < n; ++l) {
        const Particle& b = particles[l];
        const Vector d = Z[k] - Z[l];
        if (a.body == b.body || d.norm() >= dp) continue;
        ++contacts;
        E += contact_stiffness * K / 2 * (dp - d.norm()) * d.normalized() / a.V;
      }
      if (!a.held) out[k].p = E - T[k] + Dp[k];
      out[k].J += DJ[k];
    }
    return out;
  }

  void step() {
    double fastest = 0;
    for (const Particle& a : particles) fastest = std::max(fastest, a.p.norm() / rho0);
    const double dt = cfl * h / (wave_speed() + fastest);
    const std::vector<Particle> start = particles;
    std::vector<Vector> Z;
    for (const Particle& a : particles) Z.push_back(a.x);
    const auto add = [&] {
      const std::vector<Rates> r = rates(Z);
      for (std::size_t k = 0; k < r.size(); ++k) {
        particles[k].x += dt * r[k].x;
        particles[k].p += dt * r[k].p;
        particles[k].F += dt * r[k].F;
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
      a.J = 0.5 * (start[k].J + a.J);
    }
    time += dt;
  }
};

}  // namespace taut::test::naive_lee
