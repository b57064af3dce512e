#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "tests/engine/dense.hpp"
#include "tests/support/neighbor_sweep.hpp"

/// Transcription of [Zhang2024], [Zhang2024b] and [SPHinXsys2025] in 2D and 3D. tests/README.md (Transcriptions) lists
/// its choices.
namespace taut::test::naive {

template <int Dim>
using Vector = std::array<double, Dim>;
template <int Dim>
using Matrix = std::array<std::array<double, Dim>, Dim>;

template <int Dim>
double dot(const Vector<Dim>& a, const Vector<Dim>& b) {
  double sum = 0;
  for (int k = 0; k < Dim; ++k) sum += a[k] * b[k];
  return sum;
}

enum class Method { og, oas, enog, enog_nonconservative, gnog, gnog_amc };
inline Method method_named(const std::string& name) {
  if (name == "og") return Method::og;
  if (name == "oas") return Method::oas;
  if (name == "gnog") return Method::gnog;
  if (name == "gnog-amc") return Method::gnog_amc;
  return name == "enog" ? Method::enog : Method::enog_nonconservative;
}

constexpr double h_over_dp = 1.3, cfl_acoustic = 0.4, cfl_advection = 0.2;  // §5, §6
constexpr double epsilon = 0.3, exponent = 4;

template <int Dim>
struct Particle {
  Vector<Dim> x{}, v{};
  double m = 0, rho = 0, drho = 0, p = 0;
  int body = 0;
  bool clamped = false;
  Matrix<Dim> s{}, ds{};
  Vector<Dim> a_shear{}, da_shear{};
  Matrix<Dim> L{};        // velocity gradient, corrected for gnog and gnog-amc
  Vector<Dim> x_shown{};  // at the last update of an output-only stress
};

template <int Dim>
struct PairGeometry {
  std::size_t j = 0;
  Vector<Dim> e{};  // from j to i
  double r = 0, dW = 0, closeness = 0;
};

template <int Dim>
class Run {
 public:
  using Particle = naive::Particle<Dim>;

  Run(Method method, bool dual, double dp, double rho0, double c0, double G)
      : method_(method), dual_(dual), dp_(dp), h_(h_over_dp * dp), rho0_(rho0), c0_(c0), G_(G) {}

  std::vector<Particle> particles;
  bool cubic_spline = false;  // instead of Wendland's
  double pressure_diffusion = 0;
  bool penalty_rotates = false;    // gnog-amc
  int rebuilds = 0, contacts = 0;  // contacts: ordered pairs, summed over steps
  double time = 0;

  void start() {
    for (Particle& a : particles) {
      a.rho = rho0_;
      a.x_shown = a.x;
      speed_ = std::max(speed_, length(a.v));
    }
    greatest_speed_ = speed_;
    rebuild();
    find_rates(volumes(), 0);
  }

  /// Eq. 22–25.
  void step() {
    if (time > 0 && (!dual_ || distance_since_rebuild_ >= cfl_advection * h_)) {
      advance_shown_stress();
      rebuild();
    }
    const double dt = cfl_acoustic * h_ / (c0_ + speed_);
    for (Particle& a : particles) {  // Eq. 23
      for (int k = 0; k < Dim; ++k) a.x[k] += 0.5 * dt * a.v[k];
      advance_half(a, dt);
      a.p = c0_ * c0_ * (a.rho - rho0_);  // Eq. 4
    }
    refresh_contacts();
    const std::vector<double> V = volumes();
    const std::vector<Vector> acceleration = accelerations(V);
    speed_ = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {  // Eq. 24, 25
      Particle& a = particles[i];
      for (int k = 0; k < Dim; ++k) {
        if (!a.clamped) a.v[k] += dt * acceleration[i][k];
        a.x[k] += 0.5 * dt * a.v[k];
      }
      speed_ = std::max(speed_, length(a.v));
    }
    find_rates(V, dt);
    for (Particle& a : particles) advance_half(a, dt);  // Eq. 25
    greatest_speed_ = std::max(greatest_speed_, speed_);
    distance_since_rebuild_ += greatest_speed_ * dt;
    time += dt;
  }

  void finish() {
    for (Particle& a : particles) a.p = c0_ * c0_ * (a.rho - rho0_);
    advance_shown_stress();
  }

 private:
  using Vector = naive::Vector<Dim>;
  using Matrix = naive::Matrix<Dim>;
  using PairGeometry = naive::PairGeometry<Dim>;
  static constexpr double zeta = 0.7 * Dim + 2.1;  // §6
  static double length(const Vector& a) { return std::sqrt(dot<Dim>(a, a)); }

  bool penalized() const { return method_ == Method::gnog || method_ == Method::gnog_amc; }
  bool nested() const { return method_ == Method::og || method_ == Method::oas || penalized(); }
  bool same_body(std::size_t i, std::size_t j) const { return particles[i].body == particles[j].body; }

  double norm() const {
    if (cubic_spline) return (Dim == 2 ? 10.0 / 7 : 1.0) / std::numbers::pi / std::pow(h_, Dim);
    return Dim == 2 ? 7 / (4 * std::numbers::pi * h_ * h_) : 21 / (16 * std::numbers::pi * h_ * h_ * h_);
  }
  double W(double r) const {
    const double q = r / h_;
    if (cubic_spline && q < 1) return norm() * (1 - 1.5 * q * q + 0.75 * q * q * q);
    if (cubic_spline) return q < 2 ? norm() / 4 * std::pow(2 - q, 3) : 0;
    return q < 2 ? norm() * std::pow(1 - q / 2, 4) * (1 + 2 * q) : 0;
  }
  double W_slope(double r) const {
    const double q = r / h_;
    if (cubic_spline && q < 1) return norm() / h_ * (-3 * q + 2.25 * q * q);
    if (cubic_spline) return q < 2 ? -0.75 * norm() / h_ * std::pow(2 - q, 2) : 0;
    return q < 2 ? -5 * norm() / h_ * q * std::pow(1 - q / 2, 3) : 0;
  }

  std::vector<double> volumes() const {
    std::vector<double> V;
    for (const Particle& a : particles) V.push_back(a.m / a.rho);
    return V;
  }

  void set_geometry(std::size_t i, PairGeometry& g) const {
    Vector d;
    for (int k = 0; k < Dim; ++k) d[k] = particles[i].x[k] - particles[g.j].x[k];
    g.r = length(d);
    for (int k = 0; k < Dim; ++k) g.e[k] = d[k] / g.r;
    g.dW = W_slope(g.r);
    g.closeness = std::pow(W(g.r) / W(dp_), exponent);
  }

  void rebuild() {
    std::vector<Vector> x;
    for (const Particle& a : particles) x.push_back(a.x);
    const auto near = neighbors_within(2 * h_, x);
    pairs_.assign(particles.size(), {});
    for (std::size_t i = 0; i < particles.size(); ++i) {
      for (const std::size_t j : near[i]) {
        PairGeometry& g = pairs_[i].emplace_back();
        g.j = j;
        set_geometry(i, g);
      }
    }
    volumes_at_rebuild_ = volumes();
    find_corrections();
    distance_since_rebuild_ = 0;
    ++rebuilds;
  }

  void refresh_contacts() {
    for (std::size_t i = 0; i < particles.size(); ++i) {
      for (PairGeometry& g : pairs_[i]) {
        if (same_body(i, g.j)) continue;
        set_geometry(i, g);
        ++contacts;
      }
    }
  }

  void advance_half(Particle& a, double dt) const {
    a.rho += 0.5 * dt * a.drho;
    for (int k = 0; k < Dim; ++k) {
      a.a_shear[k] += 0.5 * dt * a.da_shear[k];
      for (int l = 0; l < Dim; ++l) a.s[k][l] += 0.5 * dt * a.ds[k][l];
    }
  }

  /// R = −ε σ⁺/ρ².
  Matrix artificial_stress(const Particle& a) const {
    Eigen::Matrix<double, Dim, Dim> sigma;
    for (int k = 0; k < Dim; ++k)
      for (int l = 0; l < Dim; ++l) sigma(k, l) = a.s[k][l] - (k == l ? a.p : 0);
    const PrincipalAxes<Dim> principal = axes_of(sigma);
    Matrix R{};
    for (int axis = 0; axis < Dim; ++axis) {
      const auto n = principal.vectors.col(axis);
      const double tension = std::max(principal.values[axis], 0.0);
      for (int k = 0; k < Dim; ++k)
        for (int l = 0; l < Dim; ++l) R[k][l] -= epsilon * tension / (a.rho * a.rho) * n[k] * n[l];
    }
    return R;
  }

  /// Eq. 12 with the linearised P*; limited for `og`.
  double riemann_pressure(const Particle& a, const Particle& b, const Vector& e) const {
    const double U_L = -dot<Dim>(a.v, e), U_R = -dot<Dim>(b.v, e);
    const double limited = std::min(3 * std::max(U_L - U_R, 0.0) / c0_, 1.0);
    const double beta = method_ == Method::og ? limited : 1;
    return 0.5 * (a.p + b.p) + 0.5 * beta * rho0_ * c0_ * (U_L - U_R);
  }

  std::vector<Vector> accelerations(const std::vector<double>& V) const {
    std::vector<Vector> acceleration(particles.size(), Vector{});
    std::vector<Matrix> R;
    for (const Particle& a : particles) R.push_back(artificial_stress(a));
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const Particle& a = particles[i];
      for (const PairGeometry& g : pairs_[i]) {
        const std::size_t j = g.j;
        const Particle& b = particles[j];
        const double P = riemann_pressure(a, b, g.e);
        for (int k = 0; k < Dim; ++k) {
          acceleration[i][k] -= 2 * b.m * P / (a.rho * b.rho) * g.dW * g.e[k];  // Eq. 12
          for (int l = 0; l < Dim; ++l) {
            if (nested() && same_body(i, j))
              acceleration[i][k] += V[j] / a.rho * (a.s[k][l] + b.s[k][l]) * g.dW * g.e[l];  // Eq. 13
            if (method_ == Method::oas)
              acceleration[i][k] += b.m * (R[i][k][l] + R[j][k][l]) * g.closeness * g.dW * g.e[l];
          }
        }
      }
      for (int k = 0; k < Dim; ++k) acceleration[i][k] += a.a_shear[k];
    }
    return acceleration;
  }

  void find_rates(const std::vector<double>& V, double dt) {
    for (std::size_t i = 0; i < particles.size(); ++i) {
      Particle& a = particles[i];
      double divergence = 0;
      Matrix gradient{};
      Vector laplacian{};
      for (const PairGeometry& g : pairs_[i]) {
        const std::size_t j = g.j;
        Vector v_ij;
        for (int k = 0; k < Dim; ++k) v_ij[k] = a.v[k] - particles[j].v[k];
        const double along = dot<Dim>(v_ij, g.e);
        const double diffusion = pressure_diffusion * (a.p - particles[j].p) / (rho0_ * c0_);
        divergence -= V[j] * (along + diffusion) * g.dW;  // Eq. 11
        if (!same_body(i, j)) continue;
        for (int k = 0; k < Dim; ++k) {
          for (int l = 0; l < Dim; ++l) gradient[k][l] -= v_ij[k] * g.dW * g.e[l] * V[j];  // Eq. 14
          const bool plain = method_ == Method::enog_nonconservative;                      // Eq. 18, 19
          laplacian[k] += 2 * (plain ? v_ij[k] : zeta * along * g.e[k]) / g.r * g.dW * V[j];
        }
      }
      a.drho = a.clamped && !nested() ? 0 : -a.rho * divergence;  // Eq. 1
      if (penalized()) gradient = times(gradient, corrections_[i]);
      a.L = gradient;
      if (nested()) a.ds = stress_rate(gradient, a.s);
      for (int k = 0; k < Dim && !nested(); ++k) a.da_shear[k] = G_ / a.rho * laplacian[k];  // Eq. 20
    }
    for (Particle& a : particles)
      if (penalty_rotates) rotate_penalty(a, dt);
    if (penalized()) find_penalties(V);
  }

  /// [SPHinXsys2025], first version.
  static void rotate_penalty(Particle& a, double dt) {
    Eigen::Vector3d spin{0, 0, 0.5 * (a.L[1][0] - a.L[0][1])}, penalty{0, 0, 0};
    if constexpr (Dim == 3) spin.head(2) << 0.5 * (a.L[2][1] - a.L[1][2]), 0.5 * (a.L[0][2] - a.L[2][0]);
    if (spin.norm() == 0) return;
    for (int k = 0; k < Dim; ++k) penalty[k] = a.a_shear[k];
    penalty = Eigen::AngleAxisd(spin.norm() * dt, spin.normalized()) * penalty;
    for (int k = 0; k < Dim; ++k) a.a_shear[k] = penalty[k];
  }

  /// [Zhang2024b] with ξ = 4, [SPHinXsys2025] with ξ = 2.
  void find_penalties(const std::vector<double>& V) {
    for (std::size_t i = 0; i < particles.size(); ++i) {
      Particle& a = particles[i];
      a.da_shear = {};
      for (const PairGeometry& g : pairs_[i]) {
        const Particle& b = particles[g.j];
        if (!same_body(i, g.j)) continue;
        Vector unexplained;
        for (int k = 0; k < Dim; ++k) {
          unexplained[k] = a.v[k] - b.v[k];
          for (int l = 0; l < Dim; ++l) unexplained[k] -= 0.5 * (a.L[k][l] + b.L[k][l]) * g.r * g.e[l];
        }
        const bool central = method_ == Method::gnog_amc;
        const double along = dot<Dim>(unexplained, g.e);
        for (int k = 0; k < Dim; ++k)
          a.da_shear[k] +=
              (central ? 2 * along * g.e[k] : 4 * unexplained[k]) * G_ / a.rho * V[g.j] / g.r * g.dW;
      }
    }
  }

  /// Eq. 27 with the geometry of the last rebuild.
  void find_corrections() {
    corrections_.clear();
    for (std::size_t i = 0; i < particles.size(); ++i) {
      Eigen::Matrix<double, Dim, Dim> moment = Eigen::Matrix<double, Dim, Dim>::Zero();
      for (const PairGeometry& g : pairs_[i])
        for (int k = 0; k < Dim && same_body(i, g.j); ++k)
          for (int l = 0; l < Dim; ++l)
            moment(k, l) -= g.r * g.e[k] * g.dW * g.e[l] * volumes_at_rebuild_[g.j];
      corrections_.push_back(moment.inverse());
    }
  }
  static Matrix times(const Matrix& A, const Eigen::Matrix<double, Dim, Dim>& B) {
    Matrix product{};
    for (int k = 0; k < Dim; ++k)
      for (int l = 0; l < Dim; ++l)
        for (int n = 0; n < Dim; ++n) product[k][l] += A[k][n] * B(n, l);
    return product;
  }

  /// Eq. 7 and 8 with Jaumann's rotation terms.
  Matrix stress_rate(const Matrix& L, const Matrix& s) const {
    Matrix rate{};
    double divergence = 0;
    for (int k = 0; k < Dim; ++k) divergence += L[k][k];
    for (int k = 0; k < Dim; ++k) {
      for (int l = 0; l < Dim; ++l) {
        rate[k][l] = 2 * G_ * (0.5 * (L[k][l] + L[l][k]) - (k == l ? divergence / Dim : 0));
        for (int n = 0; n < Dim; ++n)
          rate[k][l] += 0.5 * (L[k][n] - L[n][k]) * s[n][l] - s[k][n] * 0.5 * (L[n][l] - L[l][n]);
      }
    }
    return rate;
  }

  /// Eq. 26–27 for the displacements since the last update.
  void advance_shown_stress() {
    if (nested()) return;
    const std::vector<double>& V = volumes_at_rebuild_;
    std::vector<Vector> way;
    for (const Particle& a : particles) {
      way.emplace_back();
      for (int k = 0; k < Dim; ++k) way.back()[k] = a.x[k] - a.x_shown[k];
    }
    for (std::size_t i = 0; i < particles.size(); ++i) {
      Matrix gradient{};
      for (const PairGeometry& g : pairs_[i])
        for (int k = 0; k < Dim && same_body(i, g.j); ++k)
          for (int l = 0; l < Dim; ++l) gradient[k][l] -= (way[i][k] - way[g.j][k]) * g.dW * g.e[l] * V[g.j];
      const Matrix corrected = times(gradient, corrections_[i]);
      Particle& a = particles[i];
      const Matrix change = stress_rate(corrected, a.s);
      for (int k = 0; k < Dim; ++k)
        for (int l = 0; l < Dim; ++l) a.s[k][l] += change[k][l];
      a.x_shown = a.x;
    }
  }

  Method method_;
  bool dual_;
  double dp_, h_, rho0_, c0_, G_;
  std::vector<std::vector<PairGeometry>> pairs_;
  std::vector<Eigen::Matrix<double, Dim, Dim>> corrections_;
  std::vector<double> volumes_at_rebuild_;
  double speed_ = 0, greatest_speed_ = 0, distance_since_rebuild_ = 0;
};

}  // namespace taut::test::naive
