#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/LU>

#include "tests/engine/dense.hpp"
#include "tests/support/neighbor_sweep.hpp"

/// Transcribes [Khayyer2024] and [TranDuc2023] §2.2 in 2D; the 3D form is ours. r_ij = r_j − r_i, ∇w = ∇_i w. Choices:
/// tests/README.md (Transcriptions).
namespace taut::test::naive_cauchy {

template <int Dim>
using Vector = Eigen::Vector<double, Dim>;
template <int Dim>
using Matrix = Eigen::Matrix<double, Dim, Dim>;

struct Method {
  bool tranduc = false;  // [TranDuc2023]
  bool corrected = false, delta = false, av = false, riemann = false, as = false, tic = false;

  double h_over_d0() const { return 1.2; }
  double cfl() const { return tranduc ? 0.4 : 0.5; }
  double epsilon() const { return tranduc ? 0.3 : 0.15; }
  double n() const { return tranduc ? 6 : 8; }
  double xsph() const { return tranduc ? 0 : 0.5; }
};

inline Method method_named(const std::string& name) {
  const auto has = [&](const char* part) { return name.find(part) != std::string::npos; };
  Method m;
  m.tranduc = has("ccb");
  m.corrected = !m.tranduc && !has("uncorrected");
  m.delta = name.starts_with("d-");
  m.av = has("-av") || name == "ccbwat";
  m.riemann = has("-r-");
  m.tic = has("tic");
  m.as = !m.tic && name != "ccb";
  return m;
}

struct Material {
  double rho0, K, G;
  double c() const { return std::sqrt(K / rho0); }
};

template <int Dim>
struct Particle {
  Vector<Dim> r = Vector<Dim>::Zero(), u = Vector<Dim>::Zero();
  double m = 0, rho = 0;
  Matrix<Dim> S = Matrix<Dim>::Zero();
  Material material{};
  int body = 0, of_material = 0;
  bool clamped = false;

  double V() const { return m / rho; }
  double p() const { return material.c() * material.c() * (rho - material.rho0); }  // Eq. 5
  Matrix<Dim> sigma() const { return S - p() * Matrix<Dim>::Identity(); }           // Eq. 3
};

struct Counts {
  long tension = 0, compression = 0, viscous = 0, inner = 0, outer = 0, diffused = 0, contacts = 0;
  long limited = 0, flattened = 0;  // slopes reduced by a limiter; slopes set to 0
};

template <int Dim>
class Run {
 public:
  using Particle = naive_cauchy::Particle<Dim>;
  using Vector = naive_cauchy::Vector<Dim>;
  using Matrix = naive_cauchy::Matrix<Dim>;

  Run(const Method& method, double d0, double c0)
      : is_(method), d0_(d0), h_(method.h_over_d0() * d0), c0_(c0) {}

  std::vector<Particle> particles;
  Counts counts;
  double time = 0;
  double riemann_factor = 1;
  int limiter = 0;  // 0: none, 1: minmod, 2: van Leer, 3: no reconstruction
  double geometry = 0.5;
  bool printed_weight = false;        // [TranDuc2023]: f_ij = (r/Δx)ⁿ
  bool diffusion_of_order_0 = false;  // Eq. B.3

  void step() {
    const double dt = is_.cfl() * h_ / c0_;  // Eq. 26
    find_others();
    const std::vector<Vector> a = accelerations();
    const std::vector<double> D = density_diffusion();
    const std::vector<double> rho = densities();  // at the start of the step
    for (std::size_t i = 0; i < particles.size(); ++i)
      if (!particles[i].clamped) particles[i].u = particles[i].u + dt * a[i];
    if (!is_.tranduc) stop_approach();
    const std::vector<Vector> u = transport_velocities();
    std::vector<Vector> at;
    for (std::size_t i = 0; i < particles.size(); ++i) at.push_back(particles[i].r + geometry * dt * u[i]);
    const std::vector<Matrix> grad_u = velocity_gradients(u, at);
    const std::vector<double> drho = density_rates(u, at, grad_u);
    for (std::size_t i = 0; i < particles.size(); ++i) {
      Particle& b = particles[i];
      b.rho = rho[i] + dt * (drho[i] + D[i]);
      b.S = next_stress(b, grad_u[i], dt);
      b.r = b.r + dt * u[i];
    }
    time += dt;
  }

 private:
  std::size_t n() const { return particles.size(); }
  bool near(std::size_t i, std::size_t j) const { return particles[i].body == particles[j].body; }
  /// The search radius exceeds the support, because positions change within a step.
  void find_others() {
    std::vector<Vector> r;
    for (const Particle& a : particles) r.push_back(a.r);
    others_ = neighbors_within(2.5 * h_, r);
  }

  double of_wendland() const {
    return (Dim == 2 ? 7 / (4 * std::numbers::pi) : 21 / (16 * std::numbers::pi)) / std::pow(h_, Dim);
  }
  double of_sinc() const { return (Dim == 2 ? 0.710379463738679 : 0.617012654222634) / std::pow(h_, Dim); }
  /// Eq. 11, 12, or [TranDuc2023] §2.1.
  double w(double r) const {
    const double q = r / h_, half = std::numbers::pi * q / 2;
    if (q >= 2) return 0;
    if (is_.tranduc) return of_sinc() * (q == 0 ? 1 : std::pow(std::sin(half) / half, 5));
    return of_wendland() * std::pow(1 - q / 2, 4) * (2 * q + 1);
  }
  Vector gradient(const Vector& r_ij) const {
    const double r = r_ij.norm(), q = r / h_, half = std::numbers::pi * q / 2;
    double slope = 0;
    if (q < 2 && is_.tranduc)
      slope = of_sinc() / h_ * 5 * std::pow(std::sin(half) / half, 4) *
              (std::cos(half) * half - std::sin(half)) / (half * half) * std::numbers::pi / 2;
    else if (q < 2)
      slope = -5 * of_wendland() / h_ * q * std::pow(1 - q / 2, 3);
    return (-slope / r) * r_ij;
  }
  Vector r_ij(std::size_t i, std::size_t j) const { return particles[j].r - particles[i].r; }

  std::vector<double> densities() const {
    std::vector<double> rho;
    for (const Particle& a : particles) rho.push_back(a.rho);
    return rho;
  }

  /// L_i; I if uncorrected.
  Matrix correction(std::size_t i, const std::vector<Vector>& r) const {
    if (!is_.corrected) return Matrix::Identity();
    Matrix M = Matrix::Zero();
    for (const std::size_t j : others_[i])
      if (near(i, j)) M += particles[j].V() * (r[j] - r[i]) * gradient(r[j] - r[i]).transpose();
    return M.inverse();
  }
  std::vector<Matrix> corrections() const {
    std::vector<Vector> r;
    for (const Particle& a : particles) r.push_back(a.r);
    std::vector<Matrix> L;
    for (std::size_t i = 0; i < n(); ++i) L.push_back(correction(i, r));
    return L;
  }

  /// Eq. 18–21.
  Matrix tensile(const Particle& a) {
    const Matrix s = a.sigma();
    Matrix R = Matrix::Zero();
    if constexpr (Dim == 2) {
      const double theta = 0.5 * std::atan2(2 * s(0, 1), s(0, 0) - s(1, 1)), co = std::cos(theta),
                   si = std::sin(theta);
      const double xx = s(0, 0) * co * co + s(1, 1) * si * si + 2 * s(0, 1) * si * co;
      const double yy = s(0, 0) * si * si + s(1, 1) * co * co - 2 * s(0, 1) * si * co;
      const double R_xx = xx > 0 ? -xx : 0, R_yy = yy > 0 ? -yy : 0;
      R << R_xx * co * co + R_yy * si * si, si * co * (R_xx - R_yy),  //
          si * co * (R_xx - R_yy), R_xx * si * si + R_yy * co * co;
    } else {
      const auto [values, vectors] = axes_of(s);
      for (int k = 0; k < Dim; ++k)
        if (values[k] > 0) R -= values[k] * vectors.col(k) * vectors.col(k).transpose();
    }
    ++(R.trace() < 0 ? counts.tension : counts.compression);
    return R;
  }

  /// Eq. 52.
  std::vector<bool> inner_particles() {
    std::vector<bool> surface, inner;
    for (std::size_t i = 0; i < n(); ++i) {
      double C = w(0) * particles[i].V();
      for (const std::size_t j : others_[i])
        if (near(i, j)) C += w(r_ij(i, j).norm()) * particles[j].V();
      surface.push_back(C < 0.9);
    }
    for (std::size_t i = 0; i < n(); ++i) {
      bool in = !surface[i];
      for (const std::size_t j : others_[i])
        if (near(i, j) && surface[j] && r_ij(i, j).norm() < 1.2 * d0_) in = false;
      inner.push_back(in);
      ++(in ? counts.inner : counts.outer);
    }
    return inner;
  }

  /// Eq. 16.
  double artificial_viscosity(const Particle& a, const Particle& b) {
    const Vector r = b.r - a.r;
    const double approach = (b.u - a.u).dot(r);
    if (approach >= 0) return 0;
    ++counts.viscous;
    return h_ * 0.5 * (a.material.c() + b.material.c()) / (0.5 * (a.rho + b.rho)) * approach /
           (r.dot(r) + 0.01 * h_ * h_);
  }

  /// Eq. 28, 31, 51 (9, 17 uncorrected), or [TranDuc2023] Eq. 2.3.
  std::vector<Vector> accelerations() {
    const std::vector<Matrix> L = corrections();
    const std::vector<Matrix> grad_u =
        is_.riemann ? plain_velocity_gradients(L) : std::vector<Matrix>(n(), Matrix::Zero());
    const std::vector<bool> inner = is_.tic ? inner_particles() : std::vector<bool>(n(), false);
    std::vector<Matrix> R;
    for (const Particle& a : particles) R.push_back(tensile(a));
    std::vector<Vector> acceleration(n(), Vector::Zero());
    for (std::size_t i = 0; i < n(); ++i) {
      for (const std::size_t j : others_[i]) {
        if (!near(i, j)) continue;
        const Particle &a = particles[i], &b = particles[j];
        const Vector dw = gradient(r_ij(i, j));
        const double r = r_ij(i, j).norm(), nearness = printed_weight ? r / d0_ : w(r) / w(d0_);
        const double f = is_.epsilon() * std::pow(nearness, is_.n());
        const double aa = is_.tranduc ? a.rho * a.rho : a.rho * b.rho;
        const double bb = is_.tranduc ? b.rho * b.rho : a.rho * b.rho;
        Vector sum = (1 / bb * (b.sigma() * L[j]) + 1 / aa * (a.sigma() * L[i])) * dw;
        if (is_.as || (is_.tic && !inner[i]))
          sum = sum + f * (1 / bb * (R[j] * L[j]) + 1 / aa * (R[i] * L[i])) * dw;
        if (is_.tic && inner[i]) sum = sum - (1 / aa * (-2.0 * (R[i] * L[i]))) * dw;  // Eq. 50
        if (is_.av) sum = sum + artificial_viscosity(a, b) * dw;
        if (is_.riemann) sum = sum + riemann(a, b, grad_u[i], grad_u[j]) * dw;
        acceleration[i] = acceleration[i] + b.m * sum;
      }
      if (is_.tranduc) acceleration[i] = acceleration[i] + 1 / particles[i].m * penalty(particles[i]);
    }
    return acceleration;
  }

  /// Eq. 45 with u, not û.
  std::vector<Matrix> plain_velocity_gradients(const std::vector<Matrix>& L) const {
    std::vector<Matrix> grad(n(), Matrix::Zero());
    for (std::size_t i = 0; i < n(); ++i)
      for (const std::size_t j : others_[i])
        if (near(i, j))
          grad[i] += particles[j].V() * (particles[j].u - particles[i].u) *
                     (L[i] * gradient(r_ij(i, j))).transpose();
    return grad;
  }

  /// Limiters compare the differences to the other particle and to its mirror image.
  double limited(double across, double by_gradient) {
    const double mirrored = 2 * by_gradient - across;
    if (limiter == 0) return by_gradient;
    if (limiter == 3 || across * mirrored <= 0) return ++counts.flattened, 0;
    ++counts.limited;
    if (limiter == 1) return std::copysign(std::min(std::abs(across), std::abs(mirrored)), across);
    return 2 / (1 / across + 1 / mirrored);  // harmonic mean
  }

  /// Eq. 37, 40, 41, 43, 44: factor of m_j ∇w.
  double riemann(const Particle& a, const Particle& b, const Matrix& grad_a, const Matrix& grad_b) {
    const Vector r = b.r - a.r, e = r / r.norm();
    const double across = (b.u - a.u).dot(e);
    const double u_i = a.u.dot(e) + 0.5 * limited(across, (grad_a * r).dot(e));
    const double u_j = b.u.dot(e) - 0.5 * limited(across, (grad_b * r).dot(e));
    const double C = (a.material.c() * a.rho * std::sqrt(a.rho) + b.material.c() * b.rho * std::sqrt(b.rho)) /
                     (std::sqrt(a.rho) + std::sqrt(b.rho));
    ++counts.viscous;
    return riemann_factor * C * (u_j - u_i) / (a.rho * b.rho);
  }

  /// Eq. 33–35.
  std::vector<double> density_diffusion() {
    std::vector<double> D(n(), 0.0);
    if (!is_.delta) return D;
    const std::vector<Matrix> L = corrections();
    std::vector<Vector> grad_rho(n(), Vector::Zero());
    const auto same = [&](std::size_t i, std::size_t j) {
      return near(i, j) && particles[i].of_material == particles[j].of_material;
    };
    for (std::size_t i = 0; i < n(); ++i)
      for (const std::size_t j : others_[i])
        if (same(i, j))
          grad_rho[i] = grad_rho[i] + (particles[j].rho - particles[i].rho) * particles[j].V() *
                                          (L[i] * gradient(r_ij(i, j)));
    for (std::size_t i = 0; i < n(); ++i) {
      for (const std::size_t j : others_[i]) {
        if (!same(i, j)) continue;
        const Vector r = r_ij(i, j);
        double psi = 2 * (particles[j].rho - particles[i].rho);
        if (!diffusion_of_order_0) psi -= (grad_rho[i] + grad_rho[j]).dot(r);
        D[i] += 0.002 * h_ * c0_ * psi * r.dot(gradient(r)) / r.dot(r) * particles[j].V();
      }
      if (D[i] != 0) ++counts.diffused;
    }
    return D;
  }

  /// Eq. 14.
  std::vector<Vector> transport_velocities() const {
    std::vector<Vector> u;
    for (std::size_t i = 0; i < n(); ++i) {
      const Particle& a = particles[i];
      u.push_back(a.u);
      for (const std::size_t j : others_[i]) {
        if (!near(i, j) || a.clamped) continue;
        const Particle& b = particles[j];
        u[i] = u[i] + is_.xsph() * 2 * b.m / (b.rho + a.rho) * w(r_ij(i, j).norm()) * (b.u - a.u);
      }
    }
    return u;
  }

  /// Eq. 29 (13 uncorrected).
  std::vector<Matrix> velocity_gradients(const std::vector<Vector>& u, const std::vector<Vector>& r) const {
    std::vector<Matrix> grad(n(), Matrix::Zero());
    for (std::size_t i = 0; i < n(); ++i) {
      const Matrix L = correction(i, r);
      for (const std::size_t j : others_[i])
        if (near(i, j)) grad[i] += particles[j].V() * (u[j] - u[i]) * (L * gradient(r[j] - r[i])).transpose();
    }
    return grad;
  }

  /// Eq. 27 (8 uncorrected), or [TranDuc2023].
  std::vector<double> density_rates(const std::vector<Vector>& u, const std::vector<Vector>& r,
                                    const std::vector<Matrix>& grad_u) const {
    std::vector<double> rate;
    for (std::size_t i = 0; i < n(); ++i) {
      double sum = -particles[i].rho * grad_u[i].trace();
      if (is_.tranduc) {
        sum = 0;
        for (const std::size_t j : others_[i])
          if (near(i, j)) sum += particles[j].m * (u[i] - u[j]).dot(gradient(r[j] - r[i]));
      }
      rate.push_back(sum);
    }
    return rate;
  }

  /// Eq. 6, 7, 24.
  static Matrix next_stress(const Particle& a, const Matrix& grad_u, double dt) {
    const Matrix I = Matrix::Identity();
    const Matrix strain = 0.5 * (grad_u + grad_u.transpose()), spin = 0.5 * (grad_u - grad_u.transpose());
    const Matrix Q = (I - 0.5 * dt * spin).inverse() * (I + 0.5 * dt * spin);
    return Q * a.S * Q.transpose() + 2 * a.material.G * dt * (strain - strain.trace() / 3 * I);
  }

  /// Calls f(b, b.r − a.r, distance) for particles of other bodies within one spacing.
  template <class F>
  void for_each_touch(const Particle& a, const F& f) {
    for (const std::size_t j : others_[static_cast<std::size_t>(&a - particles.data())]) {
      const Particle& b = particles[j];
      const Vector r = b.r - a.r;
      const double distance = r.norm();
      if (a.body == b.body || distance >= d0_) continue;
      ++counts.contacts;
      f(b, r, distance);
    }
  }

  /// [TranDuc2023] Eq. 2.13.
  Vector penalty(const Particle& a) {
    Vector force = Vector::Zero();
    for_each_touch(a, [&](const Particle& b, const Vector& r, double distance) {
      const double K = a.material.K * b.material.K / (a.material.K + b.material.K);
      force = force - std::pow(d0_, Dim - 2) * K * (d0_ - distance) / distance * r;
    });
    return force;
  }

  /// Eq. 53, 54 with the new velocities.
  void stop_approach() {
    std::vector<Vector> change;
    for (const Particle& a : particles) {
      Vector impulse = Vector::Zero();
      for_each_touch(a, [&](const Particle& b, const Vector& r, double) {
        if ((b.u - a.u).dot(r) >= 0 || (a.clamped && b.clamped)) return;
        const double mass = a.clamped ? b.m : b.clamped ? a.m : a.m * b.m / (a.m + b.m);
        impulse = impulse + mass * (b.u - a.u).dot(r) / r.dot(r) * r;
      });
      change.push_back(a.clamped ? Vector(Vector::Zero()) : Vector(1 / a.m * impulse));
    }
    for (std::size_t i = 0; i < n(); ++i) particles[i].u = particles[i].u + change[i];
  }

  Method is_;
  double d0_, h_, c0_;
  std::vector<std::vector<std::size_t>> others_;
};

}  // namespace taut::test::naive_cauchy
