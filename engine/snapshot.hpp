#pragma once

#include <cstddef>
#include <vector>

#include "engine/core/point.hpp"

namespace taut {

struct Impulse {
  Point linear{};   // N s (per metre depth in 2D)
  Point angular{};  // about the origin, N m s (per metre depth in 2D, only z)
};

/// Stress, Pa.
struct StressTensor {
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
};

/// All particles at one time, in creation order. In 2D, masses and energies are per metre depth.
struct Snapshot {
  int dim = 2;
  double time = 0;  // s
  long step = 0;
  std::vector<double> x0;   // reference position, n × dim, m
  std::vector<double> x;    // n × dim, m
  std::vector<double> v;    // n × dim, m/s
  std::vector<double> m;    // kg
  std::vector<double> rho;  // kg/m³
  std::vector<double> p;    // pressure, positive in compression, Pa
  /// Stress deviator in Pa: n × 4 (xx, xy, yy, zz) in 2D, n × 6 (xx, xy, xz, yy, yz, zz) in 3D.
  std::vector<double> s;
  std::vector<double> strain_energy;  // J; empty for methods that do not define it
  double contact_energy = 0;          // J
  double work = 0;                    // of drives, loads and gravity since the start, J
  std::vector<double> body_work;      // [body] J
  double damped = 0;                  // energy lost to Scene::damping since the start, J
  Impulse of_walls;                   // on the particles since the start
  std::vector<double> diameter;       // as drawn: V0^(1/dim), m
  std::vector<int> body;
  std::vector<int> material;
  std::vector<unsigned char> clamped;
  std::vector<unsigned char> driven;  // moved by a drive at some time

  std::size_t size() const { return m.size(); }

  Point initial(std::size_t i) const { return point(x0, i); }  // m
  Point position(std::size_t i) const { return point(x, i); }  // m
  Point velocity(std::size_t i) const { return point(v, i); }  // m/s
  StressTensor deviator(std::size_t i) const {                 // Pa
    if (const double* c = &s[i * stored(dim)]; dim == 3)
      return {c[0], c[3], c[5], c[1], c[2], c[4]};
    else
      return {c[0], c[2], c[3], c[1], 0, 0};
  }
  /// Stress σ = s − p I, Pa.
  StressTensor stress(std::size_t i) const {
    StressTensor sigma = deviator(i);
    for (double* normal : {&sigma.xx, &sigma.yy, &sigma.zz}) *normal -= p[i];
    return sigma;
  }

  void resize(int dimensions, std::size_t n) {
    dim = dimensions;
    const auto d = static_cast<std::size_t>(dim);
    for (std::vector<double>* field : {&x0, &x, &v}) field->resize(n * d);
    for (std::vector<double>* field : {&m, &rho, &p, &diameter}) field->resize(n);
    s.resize(n * stored(dim));
    body.resize(n), material.resize(n), clamped.resize(n), driven.resize(n);
  }
  void set_deviator(std::size_t i, const StressTensor& t) {
    double* c = &s[i * stored(dim)];
    if (dim == 3)
      c[0] = t.xx, c[1] = t.xy, c[2] = t.xz, c[3] = t.yy, c[4] = t.yz, c[5] = t.zz;
    else
      c[0] = t.xx, c[1] = t.xy, c[2] = t.yy, c[3] = t.zz;
  }

 private:
  static std::size_t stored(int dim) { return dim == 3 ? 6 : 4; }
  Point point(const std::vector<double>& of, std::size_t i) const {
    const auto d = static_cast<std::size_t>(dim);
    Point value{};
    for (std::size_t k = 0; k < d; ++k) value[k] = of[i * d + k];
    return value;
  }
};

}  // namespace taut
