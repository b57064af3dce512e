#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

/// The methods of [Zhang2024] in two dimensions, written a second time, straight from the paper: every
/// particle against every other, no lists, no lanes, nothing of the engine. Slow, and meant to be read beside
/// the paper.
///
/// Where the paper is silent or contradicts itself, this takes the same side as the engine says it does:
///   - Eq. 7 with the rotation terms of Jaumann; Eq. 14 and 27 with the sign that makes ∇v right;
///   - Eq. 11–12 with `pressure_diffusion` of (p_i − p_j)/(2 ρ0 c0) in U*; β = 1, or limited for `og`;
///   - Eq. 20 with G/ρ inside the integral; shear and stress advance in halves as the density does (Eq. 23,
///   25);
///   - Eq. 19 with ζ = 3.5; Eq. 18 without;
///   - Gray's artificial stress with ε = 0.3, n = 4;
///   - between two bodies no shear stress acts, and e_ij and ∂W/∂r are those of the middle of each step,
///   while
///     which pairs there are and their W/W(dp) are those of the advection step;
///   - held particles do not move; their density changes only in the methods that compute with a stress.
namespace taut::test::naive {

using Vector = std::array<double, 2>;
using Matrix = std::array<std::array<double, 2>, 2>;

enum class Method { og, oas, enog, enog_nonconservative };

constexpr double h_over_dp = 1.3, cfl_acoustic = 0.4, cfl_advection = 0.2;  // §5, §6
constexpr double zeta = 0.7 * 2 + 2.1;                                      // §6
constexpr double epsilon = 0.3, exponent = 4;                               // of the artificial stress

struct Particle {
  Vector x{}, v{};
  double m = 0, rho = 0, drho = 0, p = 0;
  int body = 0;
  bool held = false;
  Matrix s{}, ds{};              // shear stress and its rate: computed with, or only shown
  Vector a_shear{}, da_shear{};  // shear acceleration and its rate
  Vector x_shown{};              // where x stood when a stress that is only shown was last advanced
};

struct PairGeometry {
  bool neighbors = false;
  Vector e{};  // from j to i
  double r = 0, dW = 0, closeness = 0;
};

class Run {
 public:
  Run(Method method, bool dual, double dp, double rho0, double c0, double G)
      : method_(method), dual_(dual), dp_(dp), h_(h_over_dp * dp), rho0_(rho0), c0_(c0), G_(G) {}

  std::vector<Particle> particles;
  double pressure_diffusion = 0;   // share of (p_i − p_j)/(2 ρ0 c0) in U*
  int rebuilds = 0, contacts = 0;  // contacts: pairs of two bodies, summed over the steps
  double time = 0;

  void start() {
    for (Particle& a : particles) {
      a.rho = rho0_;
      a.x_shown = a.x;
      speed_ = std::max(speed_, std::hypot(a.v[0], a.v[1]));
    }
    greatest_speed_ = speed_;
    rebuild();
    find_rates(volumes());
  }

  /// One acoustic step, Eq. 22–25.
  void step() {
    if (time > 0 && (!dual_ || way_ >= cfl_advection * h_)) {
      advance_shown_stress();
      rebuild();
    }
    const double dt = cfl_acoustic * h_ / (c0_ + speed_);
    for (Particle& a : particles) {  // Eq. 23
      for (int k = 0; k < 2; ++k) a.x[k] += 0.5 * dt * a.v[k];
      advance_half(a, dt);
      a.p = c0_ * c0_ * (a.rho - rho0_);  // Eq. 4
    }
    refresh_contacts();
    const std::vector<double> V = volumes();
    const std::vector<Vector> acceleration = accelerations(V);
    speed_ = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {  // Eq. 24, and the positions of Eq. 25
      Particle& a = particles[i];
      for (int k = 0; k < 2; ++k) {
        if (!a.held) a.v[k] += dt * acceleration[i][k];
        a.x[k] += 0.5 * dt * a.v[k];
      }
      speed_ = std::max(speed_, std::hypot(a.v[0], a.v[1]));
    }
    find_rates(V);
    for (Particle& a : particles) advance_half(a, dt);  // Eq. 25
    greatest_speed_ = std::max(greatest_speed_, speed_);
    way_ += greatest_speed_ * dt;
    time += dt;
  }

  /// Brings pressure and shown stress up to the end of the step.
  void finish() {
    for (Particle& a : particles) a.p = c0_ * c0_ * (a.rho - rho0_);
    advance_shown_stress();
  }

 private:
  bool nested() const { return method_ == Method::og || method_ == Method::oas; }
  const PairGeometry& pair(std::size_t i, std::size_t j) const { return pairs_[i * particles.size() + j]; }
  bool same_body(std::size_t i, std::size_t j) const { return particles[i].body == particles[j].body; }

  /// Wendland's C2 kernel in two dimensions.
  double W(double r) const {
    const double q = r / h_;
    return q < 2 ? 7 / (4 * std::numbers::pi * h_ * h_) * std::pow(1 - q / 2, 4) * (1 + 2 * q) : 0;
  }
  double W_slope(double r) const {
    const double q = r / h_;
    return q < 2 ? -35 / (4 * std::numbers::pi * h_ * h_ * h_) * q * std::pow(1 - q / 2, 3) : 0;
  }

  std::vector<double> volumes() const {
    std::vector<double> V;
    for (const Particle& a : particles) V.push_back(a.m / a.rho);
    return V;
  }

  void set_geometry(std::size_t i, std::size_t j) {
    PairGeometry& g = pairs_[i * particles.size() + j];
    const Vector d = {particles[i].x[0] - particles[j].x[0], particles[i].x[1] - particles[j].x[1]};
    g.r = std::sqrt(d[0] * d[0] + d[1] * d[1]);
    g.e = {d[0] / g.r, d[1] / g.r};
    g.dW = W_slope(g.r);
  }

  /// The configuration of an advection step.
  void rebuild() {
    pairs_.assign(particles.size() * particles.size(), {});
    for (std::size_t i = 0; i < particles.size(); ++i) {
      for (std::size_t j = 0; j < particles.size(); ++j) {
        if (i == j) continue;
        set_geometry(i, j);
        PairGeometry& g = pairs_[i * particles.size() + j];
        g.neighbors = g.r < 2 * h_;
        g.closeness = std::pow(W(g.r) / W(dp_), exponent);
      }
    }
    way_ = 0;
    ++rebuilds;
  }

  void refresh_contacts() {
    for (std::size_t i = 0; i < particles.size(); ++i) {
      for (std::size_t j = 0; j < particles.size(); ++j) {
        if (same_body(i, j) || !pair(i, j).neighbors) continue;
        set_geometry(i, j);
        ++contacts;
      }
    }
  }

  void advance_half(Particle& a, double dt) const {
    a.rho += 0.5 * dt * a.drho;
    for (int k = 0; k < 2; ++k) {
      a.a_shear[k] += 0.5 * dt * a.da_shear[k];
      for (int l = 0; l < 2; ++l) a.s[k][l] += 0.5 * dt * a.ds[k][l];
    }
  }

  /// R = −ε σ⁺/ρ² through the principal axes of σ.
  Matrix artificial_stress(const Particle& a) const {
    const double xx = a.s[0][0] - a.p, yy = a.s[1][1] - a.p, xy = a.s[0][1];
    const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
    Matrix R{};
    for (const double axis : {angle, angle + 0.5 * std::numbers::pi}) {
      const Vector n = {std::cos(axis), std::sin(axis)};
      const double stress = xx * n[0] * n[0] + 2 * xy * n[0] * n[1] + yy * n[1] * n[1];
      for (int k = 0; k < 2; ++k)
        for (int l = 0; l < 2; ++l)
          R[k][l] -= epsilon * std::max(stress, 0.0) / (a.rho * a.rho) * n[k] * n[l];
    }
    return R;
  }

  /// Eq. 12, with the linearised P*; for `og` its dissipation is limited.
  double riemann_pressure(const Particle& a, const Particle& b, const Vector& e) const {
    const double U_L = -(a.v[0] * e[0] + a.v[1] * e[1]), U_R = -(b.v[0] * e[0] + b.v[1] * e[1]);
    const double limited = std::min(3 * std::max(U_L - U_R, 0.0) / c0_, 1.0);
    const double beta = method_ == Method::og ? limited : 1;
    return 0.5 * (a.p + b.p) + 0.5 * beta * rho0_ * c0_ * (U_L - U_R);
  }

  std::vector<Vector> accelerations(const std::vector<double>& V) const {
    std::vector<Vector> acceleration(particles.size(), Vector{});
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const Particle& a = particles[i];
      for (std::size_t j = 0; j < particles.size(); ++j) {
        const PairGeometry& g = pair(i, j);
        if (!g.neighbors) continue;
        const Particle& b = particles[j];
        const double P = riemann_pressure(a, b, g.e);
        const Matrix R_i = artificial_stress(a), R_j = artificial_stress(b);
        for (int k = 0; k < 2; ++k) {
          acceleration[i][k] -= 2 * b.m * P / (a.rho * b.rho) * g.dW * g.e[k];  // Eq. 12
          for (int l = 0; l < 2; ++l) {
            if (nested() && same_body(i, j))
              acceleration[i][k] += V[j] / a.rho * (a.s[k][l] + b.s[k][l]) * g.dW * g.e[l];  // Eq. 13
            if (method_ == Method::oas)
              acceleration[i][k] += b.m * (R_i[k][l] + R_j[k][l]) * g.closeness * g.dW * g.e[l];
          }
        }
      }
      for (int k = 0; k < 2; ++k) acceleration[i][k] += a.a_shear[k];
    }
    return acceleration;
  }

  /// The rates of density and shear from the velocities; the geometry is that of the pairs.
  void find_rates(const std::vector<double>& V) {
    for (std::size_t i = 0; i < particles.size(); ++i) {
      Particle& a = particles[i];
      double divergence = 0;
      Matrix gradient{};
      Vector laplacian{};
      for (std::size_t j = 0; j < particles.size(); ++j) {
        const PairGeometry& g = pair(i, j);
        if (!g.neighbors) continue;
        const Vector v_ij = {a.v[0] - particles[j].v[0], a.v[1] - particles[j].v[1]};
        const double along = v_ij[0] * g.e[0] + v_ij[1] * g.e[1];
        const double diffusion = pressure_diffusion * (a.p - particles[j].p) / (rho0_ * c0_);
        divergence -= V[j] * (along + diffusion) * g.dW;  // Eq. 11: U* + v_i·e_ij = ½ (along + diffusion)
        if (!same_body(i, j)) continue;
        for (int k = 0; k < 2; ++k) {
          for (int l = 0; l < 2; ++l) gradient[k][l] -= v_ij[k] * g.dW * g.e[l] * V[j];  // Eq. 14
          const bool plain = method_ == Method::enog_nonconservative;                    // Eq. 18, Eq. 19
          laplacian[k] += 2 * (plain ? v_ij[k] : zeta * along * g.e[k]) / g.r * g.dW * V[j];
        }
      }
      a.drho = a.held && !nested() ? 0 : -a.rho * divergence;  // Eq. 1
      if (nested()) a.ds = stress_rate(gradient, a.s);
      for (int k = 0; k < 2 && !nested(); ++k) a.da_shear[k] = G_ / a.rho * laplacian[k];  // Eq. 20
    }
  }

  /// Eq. 7 and 8 with the rotation terms of Jaumann.
  Matrix stress_rate(const Matrix& L, const Matrix& s) const {
    Matrix rate{};
    const double divergence = L[0][0] + L[1][1];
    for (int k = 0; k < 2; ++k) {
      for (int l = 0; l < 2; ++l) {
        rate[k][l] = 2 * G_ * (0.5 * (L[k][l] + L[l][k]) - (k == l ? divergence / 2 : 0));
        for (int n = 0; n < 2; ++n)
          rate[k][l] += 0.5 * (L[k][n] - L[n][k]) * s[n][l] - s[k][n] * 0.5 * (L[n][l] - L[l][n]);
      }
    }
    return rate;
  }

  /// Eq. 26–27 for the displacements since the stress was last advanced, on the geometry held meanwhile.
  void advance_shown_stress() {
    if (nested()) return;
    const std::vector<double> V = volumes();
    std::vector<Vector> way;
    for (const Particle& a : particles) way.push_back({a.x[0] - a.x_shown[0], a.x[1] - a.x_shown[1]});
    for (std::size_t i = 0; i < particles.size(); ++i) {
      Matrix gradient{}, moment{};
      for (std::size_t j = 0; j < particles.size(); ++j) {
        const PairGeometry& g = pair(i, j);
        if (!g.neighbors || !same_body(i, j)) continue;
        for (int k = 0; k < 2; ++k) {
          for (int l = 0; l < 2; ++l) {
            gradient[k][l] -= (way[i][k] - way[j][k]) * g.dW * g.e[l] * V[j];
            moment[k][l] -= g.r * g.e[k] * g.dW * g.e[l] * V[j];
          }
        }
      }
      const double det = moment[0][0] * moment[1][1] - moment[0][1] * moment[1][0];
      const Matrix B = {
          {{moment[1][1] / det, -moment[0][1] / det}, {-moment[1][0] / det, moment[0][0] / det}}};
      Matrix corrected{};
      for (int k = 0; k < 2; ++k)
        for (int l = 0; l < 2; ++l)
          for (int n = 0; n < 2; ++n) corrected[k][l] += gradient[k][n] * B[n][l];
      Particle& a = particles[i];
      const Matrix change = stress_rate(corrected, a.s);
      for (int k = 0; k < 2; ++k)
        for (int l = 0; l < 2; ++l) a.s[k][l] += change[k][l];
      a.x_shown = a.x;
    }
  }

  Method method_;
  bool dual_;
  double dp_, h_, rho0_, c0_, G_;
  std::vector<PairGeometry> pairs_;
  double speed_ = 0, greatest_speed_ = 0, way_ = 0;
};

}  // namespace taut::test::naive
