#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/layout/initial_particles.hpp"
#include "engine/methods/bonded/layout/bonds.hpp"
#include "engine/methods/bonded/layout/interfaces.hpp"
#include "tests/support/neighbor_sweep.hpp"

namespace taut::test {

/// A value and its derivatives by `Components` variables.
template <int Components>
struct Dual {
  double value = 0;
  std::array<double, Components> slope{};

  Dual() = default;
  Dual(double v) : value(v) {}  // NOLINT: a constant
  static Dual variable(double v, int k) {
    Dual d(v);
    d.slope[k] = 1;
    return d;
  }
  Dual combined(double v, double of_this, const Dual& b, double of_b) const {
    Dual r(v);
    for (int k = 0; k < Components; ++k) r.slope[k] = of_this * slope[k] + of_b * b.slope[k];
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
template <int Components>
Dual<Components> operator*(double a, const Dual<Components>& b) {
  return Dual<Components>(a) * b;
}
template <int Components>
Dual<Components> operator/(double a, const Dual<Components>& b) {
  return Dual<Components>(a) / b;
}

/// Shares initial particles, bonds and interfaces with the solver. In 2D the scene must have one body, in 3D touching
/// bodies the same material.
template <int Dim>
class NaiveOenogIn {
 public:
  using Place = std::array<double, Dim>;
  using Places = std::vector<Place>;

  NaiveOenogIn(const Scene& scene, double h_over_dp)
      : NaiveOenogIn(scene, make_initial_particles(scene), h_over_dp) {}
  NaiveOenogIn(const Scene& scene, const InitialParticles& initial, double h_over_dp)
      : scene_(scene), initial_(initial), bonds_(make_bonds(scene, initial_, h_over_dp * scene.spacing)) {
    std::vector<Elasticity> materials;
    for (const Material& m : scene.materials)
      materials.push_back({m.density, m.sound_speed(), m.bulk_modulus(), m.shear_modulus()});
    interfaces_ = make_interfaces(initial_, materials, bonds_, scene.spacing);
    site_of_.assign(initial_.size(), -1);
    for (std::size_t s = 0; s < interfaces_.sites.size(); ++s)
      site_of_[interfaces_.sites[s].id] = static_cast<int>(s);
    for (int i = 0; i < initial_.size(); ++i) {
      x.emplace_back(), v.emplace_back();
      for (int k = 0; k < Dim; ++k) x[i][k] = initial_.x[i][k], v[i][k] = initial_.v[i][k];
    }
  }

  int size() const { return initial_.size(); }
  bool clamped(int i) const { return initial_.clamped[i]; }
  const Bonds& bonds() const { return bonds_; }
  const Interfaces& interfaces() const { return interfaces_; }
  double contacts = 0;  // ordered pairs, summed over steps

  /// E = Σ [V W(F) + V0 G Σ w (φ(λ) − φ(λ°))], in 2D minus the face terms (THEORY.md). Interfaces have other terms.
  /// Bonds use `modulus` for G; λ° must be in ½ … 2.
  double energy(const Places& at) const {
    double E = 0;
    for (int i = 0; i < size(); ++i) {
      if (clamped(i)) continue;
      if (site_of_[i] >= 0) {
        E += of_site(at, i).value;
        for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1]; ++b)
          E += strength(i, b) * phi(stretch(at, i, b));
        continue;
      }
      const auto F = gradient(at, i);
      for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1]; ++b)
        E += strength(i, b) * phi(stretch(at, i, b));
      for (const auto& [X, strength] : cancelled(i))
        E -= strength * phi(std::sqrt(affine(X, duals(F)).value));
      E += bonds_.volume[i] * W(i, duals(F)).value;
    }
    return E;
  }

  /// −∂E/∂x.
  Places force(const Places& at) const {
    Places f(at.size());
    for (int i = 0; i < size(); ++i) {
      if (clamped(i)) continue;
      if (site_of_[i] >= 0) {
        pull_site(at, i, f);
        continue;
      }
      const auto F = duals(gradient(at, i));
      Number left = bonds_.volume[i] * W(i, F);
      for (const auto& [X, strength] : cancelled(i)) {
        const Number s = affine(X, F);
        left = left - strength / 24 * (2.0 * s * s - 3.0 * s + 1 / s);
      }
      pull(at, i, left.slope, f);
    }
    return f;
  }

  /// For the benchmark, with explicit derivatives except at material interfaces.
  Places force_by_hand(const Places& at) const {
    Places f(at.size());
    for (int i = 0; i < size(); ++i) {
      if (clamped(i)) continue;
      if (site_of_[i] >= 0) {
        pull_site(at, i, f);
        continue;
      }
      const Square F = gradient(at, i);
      Square T = neo_hookean(i, F);
      for (double& component : T) component *= bonds_.volume[i];
      for (const auto& [X, strength] : cancelled(i)) {
        Place x{};
        for (int k = 0; k < components; ++k) x[k / Dim] += F[k] * X[k % Dim];
        const double r2 = squared(X), s = squared(x) / r2;
        const double slope = strength / 24 * (4 * s - 3 - 1 / (s * s));  // dφ(λ°)/ds, s = λ°²
        for (int k = 0; k < components; ++k) T[k] -= slope * 2 / r2 * x[k / Dim] * X[k % Dim];
      }
      pull(at, i, T, f);
    }
    return f;
  }

  /// V0 G w τ q̇/r0² (x_j − x_i), summed over both ends of each bond; q = ½ (r²/r0² − 1).
  Places drag(double damping) const {
    double shear_speed = 0, share = 0;
    for (int i = 0; i < size(); ++i) {
      shear_speed = std::max(shear_speed, std::sqrt(G(i) / material(i).density));
      share = std::max(share, of_bonds(i) / G(i));
    }
    const double tau = damping * scene_.spacing / (shear_speed * share);
    Places f(x.size());
    for (int i = 0; i < size(); ++i) {
      for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1] && !clamped(i); ++b) {
        const int j = bonds_.j[b];
        const auto d = way(x, i, b);
        const double r0 = rest(i, b);
        double rate = 0;
        for (int a = 0; a < Dim; ++a) rate += d[a] * ((clamped(j) ? 0 : v[j][a]) - v[i][a]) / (r0 * r0);
        const double k = strength(i, b) / (r0 * r0);
        for (int a = 0; a < Dim; ++a) {
          f[i][a] += k * tau * rate * d[a];
          f[j][a] -= k * tau * rate * d[a];
        }
      }
    }
    return f;
  }

  /// [TranDuc2023] Eq. 2.13 with `contact_stiffness` 2.
  Places push() {
    Places f(x.size());
    const auto near = neighbors_within(scene_.spacing, x);
    for (int i = 0; i < size() && Dim == 3; ++i) {
      for (const std::size_t j : near[i]) {
        Place d;
        for (int k = 0; k < Dim; ++k) d[k] = x[i][k] - x[j][k];
        const double r = length(d);
        if (initial_.body[i] == initial_.body[j] || r >= scene_.spacing) continue;
        ++contacts;
        for (int k = 0; k < Dim; ++k) f[i][k] += K(i) * scene_.spacing * (scene_.spacing - r) * d[k] / r;
      }
    }
    return f;
  }

  /// `own`: step length, or 0 for the CFL step.
  void step(double cfl, double damping, double own = 0) {
    double c = interfaces_.wave_speed, fastest = 0;
    for (int i = 0; i < size(); ++i) {
      c = std::max(c, std::sqrt((K(i) + 4.0 / 3 * G(i)) / material(i).density));
      fastest = std::max(fastest, length(v[i]));
    }
    const double dt =
        own > 0 ? own : cfl * scene_.spacing / (c + fastest) * std::min(1.0, std::sqrt(1.5 / stiffest_));
    for (int i = 0; i < size(); ++i)
      for (int k = 0; k < Dim; ++k) x[i][k] += dt / 2 * v[i][k];
    const Places f = by_hand ? force_by_hand(x) : force(x), dashpots = drag(damping), others = push();
    stiffest_ = 0;
    for (int i = 0; i < size(); ++i)
      for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1]; ++b) {
        const double l = stretch(x, i, b);
        stiffest_ = std::max(stiffest_, (24 * l * l - 6 + 6 * std::pow(l, -4)) / 24);  // φ″
      }
    for (int i = 0; i < size(); ++i) {
      if (clamped(i)) continue;
      const double m = material(i).density * bonds_.mass[i];
      for (int k = 0; k < Dim; ++k) {
        v[i][k] += dt * (f[i][k] + dashpots[i][k] + others[i][k]) / m;
        x[i][k] += dt / 2 * v[i][k];
      }
    }
  }

  Places x, v;
  bool by_hand = false;

 private:
  const Material& material(int i) const { return scene_.materials[initial_.material[i]]; }
  double K(int i) const { return material(i).bulk_modulus(); }
  double G(int i) const { return material(i).shear_modulus(); }
  /// Modulus of bonds; below G if Lamé's λ is negative.
  double of_bonds(int i) const {
    const double lambda = K(i) - 2.0 / 3 * G(i);
    return lambda < 0 ? G(i) + (Dim == 2 ? 1 : 1.5) * lambda : G(i);
  }
  double modulus(int i, int b) const {
    const int j = bonds_.j[b];
    return clamped(j) ? of_bonds(i) : 1 / (0.5 / of_bonds(i) + 0.5 / of_bonds(j));
  }

  static double phi(double l) { return (2 * std::pow(l, 4) - 3 * l * l + std::pow(l, -2)) / 24; }
  static double dphi(double l) { return (8 * std::pow(l, 3) - 6 * l - 2 * std::pow(l, -3)) / 24; }

  double strength(int i, int b) const { return initial_.V0[i] * modulus(i, b) * bonds_.of(i, b).weight; }
  static constexpr int components = Dim * Dim;  // of F, row by row
  using Square = std::array<double, components>;
  using Number = Dual<components>;
  using Duals = std::array<Number, components>;
  static Duals duals(const Square& F_now) {
    Duals F;
    for (int k = 0; k < components; ++k) F[k] = Number::variable(F_now[k], k);
    return F;
  }
  /// Subtracted stretch terms: X and strength.
  std::vector<std::pair<Point, double>> cancelled(int i) const {
    std::vector<std::pair<Point, double>> all;
    for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1]; ++b)
      all.emplace_back(bonds_.of(i, b).X, strength(i, b));
    for (const FaceTerm& term : bonds_.face_terms_of(i))
      all.emplace_back(term.t, initial_.V0[i] * of_bonds(i) * term.weight);
    return all;
  }
  Number affine(const Point& X, const Duals& F) const {
    Number sum;
    for (int a = 0; a < Dim; ++a) {
      Number x_a;
      for (int k = 0; k < Dim; ++k) x_a = x_a + F[Dim * a + k] * X[k];
      sum = sum + x_a * x_a;
    }
    return sum / Number(squared(X));
  }
  /// Neo-Hookean, J ≥ ½.
  Number W(int i, const Duals& F) const { return neo_hookean_energy(material(i), F); }
  template <class N>
  static N neo_hookean_energy(const Material& m, const std::array<N, components>& F) {
    N J, C = 3 - Dim;
    if constexpr (Dim == 2)
      J = F[0] * F[3] - F[1] * F[2];
    else
      for (int k = 0; k < 3; ++k)
        J = J + F[k] * (F[3 + (k + 1) % 3] * F[6 + (k + 2) % 3] - F[3 + (k + 2) % 3] * F[6 + (k + 1) % 3]);
    for (const N& component : F) C = C + component * component;
    return m.shear_modulus() / 2 * (J.to(-2.0 / 3) * C - 3) + m.bulk_modulus() / 2 * (J - 1) * (J - 1);
  }

  static constexpr int most_bonds = 26;
  /// Derivatives at an interface: by F, its jump b, and the squared stretches s of bonds.
  using Wide = Dual<components + Dim + most_bonds>;
  using WideSquare = std::array<Wide, components>;
  static WideSquare with(WideSquare F, double share, const std::array<Wide, Dim>& b, const Point& n) {
    for (int k = 0; k < components; ++k) F[k] = F[k] + share * n[k % Dim] * b[k / Dim];
    return F;
  }
  Wide squared_stretch(int i, int b, const WideSquare& F) const {
    Wide squared;
    for (int a = 0; a < Dim; ++a) {
      Wide x_a;
      for (int k = 0; k < Dim; ++k) x_a = x_a + bonds_.of(i, b).X[k] * F[Dim * a + k];
      squared = squared + x_a * x_a;
    }
    return 1 / (rest(i, b) * rest(i, b)) * squared;
  }
  bool across(int i, int b) const {
    return material(bonds_.j[b]).youngs_modulus != material(i).youngs_modulus;
  }
  Wide of_site(const Places& at, int i) const {
    const Interfaces::Site& site = interfaces_.sites[site_of_[i]];
    const Square F_now = gradient(at, i);
    Place b_now{};
    for (int n = interfaces_.begin[site_of_[i]]; n < interfaces_.begin[site_of_[i] + 1]; ++n)
      for (int k = 0; k < Dim; ++k) b_now[k] += interfaces_.weight[n] * (at[interfaces_.j[n]][k] - at[i][k]);
    WideSquare F;
    std::array<Wide, Dim> kink;
    for (int k = 0; k < components; ++k) F[k] = Wide::variable(F_now[k], k);
    for (int k = 0; k < Dim; ++k) kink[k] = Wide::variable(b_now[k], components + k);
    const WideSquare own = with(F, 1, kink, site.m), other = with(own, -1, kink, site.N),
                     middle = with(own, -0.5, kink, site.N);
    const double V = bonds_.volume[i];
    Wide E = V * (1 - site.share) * neo_hookean_energy(material(i), own) +
             V * site.share * neo_hookean_energy(scene_.materials[site.other], other);
    const auto phi_of = [](const Wide& s) { return 1.0 / 24 * (2.0 * s * s - 3.0 * s + 1 / s); };
    const auto psi_of = [](const Wide& s) { return 1.0 / 12 * (4.0 * s - 3 - 1 / (s * s)); };
    for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1]; ++b) {
      const Wide s_own = squared_stretch(i, b, own);
      if (!across(i, b)) {
        E = E - strength(i, b) * phi_of(s_own);
        continue;
      }
      const Wide s_mid = squared_stretch(i, b, middle),
                 s = Wide::variable(std::pow(stretch(at, i, b), 2), components + Dim + b - bonds_.begin[i]);
      const double alone =
          initial_.V0[i] * std::min(of_bonds(i), greatest_across * modulus(i, b)) * bonds_.of(i, b).weight;
      E = E + 0.5 * (alone * psi_of(s_own) - strength(i, b) * psi_of(s_mid)) * (s - s_mid) -
          strength(i, b) * phi_of(s_mid) +
          std::max(0.0, alone - strength(i, b)) / 8 * (s - s_mid) * (s - s_mid);
    }
    return E;
  }
  void pull_site(const Places& at, int i, Places& f) const {
    const auto slope = of_site(at, i).slope;
    Square T;
    std::copy_n(slope.begin(), components, T.begin());
    pull(at, i, T, f);
    for (int n = interfaces_.begin[site_of_[i]]; n < interfaces_.begin[site_of_[i] + 1]; ++n) {
      for (int k = 0; k < Dim; ++k) {
        const double on_i = interfaces_.weight[n] * slope[components + k];
        f[i][k] += on_i, f[interfaces_.j[n]][k] -= on_i;
      }
    }
    for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1]; ++b) {
      const auto d = way(at, i, b);
      for (int k = 0; k < Dim; ++k) {
        const double on_i =
            slope[components + Dim + b - bonds_.begin[i]] * 2 * d[k] / (rest(i, b) * rest(i, b));
        f[i][k] += on_i, f[bonds_.j[b]][k] -= on_i;
      }
    }
  }

  /// ∂W/∂F = G J^(−2/3) (F − C/3 F⁻ᵀ) + K (J − 1) J F⁻ᵀ, C = tr FᵀF, in 2D plus 1
  Square neo_hookean(int i, const Square& F) const {
    Square H;  // J F⁻ᵀ
    double J = 0, C = 3 - Dim;
    if constexpr (Dim == 2)
      H = {F[3], -F[2], -F[1], F[0]};
    else
      for (int k = 0; k < 9; ++k) {
        const int a = (k / 3 + 1) % 3 * 3, b = (k / 3 + 2) % 3 * 3, c = (k + 1) % 3, d = (k + 2) % 3;
        H[k] = F[a + c] * F[b + d] - F[a + d] * F[b + c];
      }
    for (int k = 0; k < components; ++k) J += F[k] * H[k] / Dim, C += F[k] * F[k];
    const double shear = G(i) * std::pow(J, -2.0 / 3);
    Square P;
    for (int k = 0; k < components; ++k) P[k] = shear * (F[k] - C / 3 * H[k] / J) + K(i) * (J - 1) * H[k];
    return P;
  }

  /// Adds the forces of i's bonds; T is the derivative by F of the energy without φ(λ).
  void pull(const Places& at, int i, const Square& T, Places& f) const {
    for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1]; ++b) {
      const auto d = way(at, i, b);
      const double r = length(d), r0 = rest(i, b);
      const double along = strength(i, b) * dphi(r / r0) / r0;
      for (int k = 0; k < Dim; ++k) {
        double on_i = along * d[k] / r;
        for (int l = 0; l < Dim; ++l) on_i += T[Dim * k + l] * bonds_.gradient(i, b)[l];
        f[i][k] += on_i;
        f[bonds_.j[b]][k] -= on_i;
      }
    }
  }

  /// Vector to j, or to the fixed point on the clamp's face.
  Place way(const Places& at, int i, int b) const {
    const int j = bonds_.j[b];
    Place d;
    for (int k = 0; k < Dim; ++k)
      d[k] = (clamped(j) ? initial_.x[i][k] + bonds_.of(i, b).X[k] : at[j][k]) - at[i][k];
    return d;
  }
  template <std::size_t N>
  static double squared(const std::array<double, N>& d) {
    double sum = 0;
    for (const double component : d) sum += component * component;
    return sum;
  }
  static double length(const Place& d) { return std::sqrt(squared(d)); }
  double rest(int i, int b) const {
    Place X;
    for (int k = 0; k < Dim; ++k) X[k] = bonds_.of(i, b).X[k];
    return length(X);
  }
  double stretch(const Places& at, int i, int b) const { return length(way(at, i, b)) / rest(i, b); }
  Square gradient(const Places& at, int i) const {
    Square F{};
    for (int b = bonds_.begin[i]; b < bonds_.begin[i + 1]; ++b) {
      const auto d = way(at, i, b);
      for (int a = 0; a < Dim; ++a)
        for (int k = 0; k < Dim; ++k) F[Dim * a + k] += d[a] * bonds_.gradient(i, b)[k];
    }
    return F;
  }

  const Scene& scene_;
  InitialParticles initial_;
  Bonds bonds_;
  Interfaces interfaces_;
  std::vector<int> site_of_;  // −1: none
  double stiffest_ = 1;       // greatest φ″ of the last step
};
using NaiveOenog = NaiveOenogIn<2>;

}  // namespace taut::test
