#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "engine/methods/tl_mixed/boundary_projection.hpp"
#include "engine/solver/initial_pairs.hpp"

namespace taut {

/// V_a W̃_a(X_i) of particle i and its initial neighbours, with W̃ = α (1 + β·(X_i − X_a)) W. [Lee2016] Eq. 23
template <class K, int Dim>
std::vector<std::pair<int, double>> corrected_kernel(const InitialPairs<Dim>& pairs,
                                                     const std::vector<Vec<double, Dim>>& X,
                                                     const std::vector<double>& V, double h, int i) {
  std::vector<std::pair<int, double>> w{{i, V[i] * K::w(0.0)}};  // without α_K/hᵈ, which α cancels
  double M0 = w[0].second;
  Vec<double, Dim> M1{};
  Sym<double, Dim> M2{};
  for (int p = pairs.begin[i]; p < pairs.begin[i + 1]; ++p) {
    const int a = pairs.j[p];
    const Vec<double, Dim> d = X[i] - X[a];
    const double VW = V[a] * K::w(std::sqrt(dot(d, d)) / h);
    w.emplace_back(a, VW);
    M0 += VW;
    M1 += VW * d;
    for (int k = 0; k < Dim; ++k)
      for (int l = k; l < Dim; ++l) M2(k, l) += VW * d[k] * d[l];
  }
  Vec<double, Dim> beta{};
  const Sym<double, Dim> inverse_M2 = inverse(M2);
  for (int k = 0; k < Dim; ++k)
    for (int l = 0; l < Dim; ++l) beta[k] -= inverse_M2(k, l) * M1[l];
  const double alpha = 1 / (M0 + dot(beta, M1));
  for (auto& [a, value] : w) value *= alpha * (1 + dot(beta, X[i] - X[a]));
  return w;
}

template <class K, int Dim>
class PrescribedBoundary {
 public:
  using V = Vec<double, Dim>;

  /// `axes`: bit k of [i] prescribes component k. V0 in m^Dim, m in kg.
  void prescribe(std::vector<unsigned char> axes, const InitialPairs<Dim>& pairs, const std::vector<V>& X,
                 const std::vector<double>& V0, const std::vector<double>& m, const std::vector<int>& first,
                 double h) {
    if (axes == axes_) return;
    axes_ = std::move(axes);
    bodies_.clear();
    for (std::size_t b = 0; b + 1 < first.size(); ++b) {
      std::vector<int> points, particles, index(V0.size(), -1);
      std::vector<Weights> weights;
      std::vector<BoundaryPoint> seen;
      for (int i = first[b]; i < first[b + 1]; ++i) {
        if (axes_[i] == 0) continue;
        points.push_back(i);
        weights.push_back(corrected_kernel<K>(pairs, X, V0, h, i));
        seen.push_back({weights.back(), axes_[i], {}});
        for (auto& [a, w] : seen.back().w) {
          if (index[a] < 0) {
            index[a] = static_cast<int>(particles.size());
            particles.push_back(a);
          }
          a = index[a];
        }
      }
      if (points.empty()) continue;
      std::vector<double> masses;
      for (const int a : particles) masses.push_back(m[a]);
      bodies_.push_back({points, weights, particles, BoundaryProjection(std::move(seen), std::move(masses))});
    }
  }

  /// Projects velocities v(i) on the prescribed given(i), in m/s. Then calls use(i, impulse, weights) for each prescribed
  /// particle: particle a of `weights` has received w_a times the impulse, in N s.
  template <class Velocity, class Given, class Use>
  void project(const Velocity& v, const Given& given, const Use& use) {
    for (Body& body : bodies_) {
      for (std::size_t p = 0; p < body.points.size(); ++p)
        body.projection.points()[p].velocity = point_of(given(body.points[p]));
      std::vector<Point> velocities;
      for (const int a : body.particles) velocities.push_back(point_of(v(a)));
      const std::vector<Point> impulses = body.projection(velocities);
      for (std::size_t a = 0; a < body.particles.size(); ++a) v(body.particles[a]) = vector_of(velocities[a]);
      for (std::size_t p = 0; p < body.points.size(); ++p)
        use(body.points[p], vector_of(impulses[p]), body.weights[p]);
    }
  }

 private:
  using Weights = std::vector<std::pair<int, double>>;
  struct Body {
    std::vector<int> points;
    std::vector<Weights> weights;  // of each point
    std::vector<int> particles;
    BoundaryProjection projection;
  };
  static Point point_of(const V& v) {
    Point p{};
    for (int k = 0; k < Dim; ++k) p[k] = v[k];
    return p;
  }
  static V vector_of(const Point& p) {
    V v;
    for (int k = 0; k < Dim; ++k) v[k] = p[k];
    return v;
  }

  std::vector<unsigned char> axes_;
  std::vector<Body> bodies_;
};

}  // namespace taut
