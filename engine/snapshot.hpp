#pragma once

#include <cstddef>
#include <vector>

#include "engine/core/point.hpp"

namespace taut {

/// What bodies were given from outside.
struct Impulse {
  Point linear{};   // N s (per metre depth in 2D)
  Point angular{};  // about the origin, N m s; in 2D only the last component
};

/// The particles at one time, in the order of their creation, whatever order the solver keeps them in.
struct Snapshot {
  int dim = 2;
  double time = 0;  // s
  long step = 0;
  std::vector<double> x0;   // initial position, n × dim, m
  std::vector<double> x;    // position, n × dim, m
  std::vector<double> v;    // velocity, n × dim, m/s
  std::vector<double> m;    // mass (per metre depth in 2D), kg
  std::vector<double> rho;  // density, kg/m³
  std::vector<double> p;    // pressure, positive in compression, Pa
  std::vector<double> s;    // deviatoric stress xx, xy, yy, zz (2D) or xx, xy, xz, yy, yz, zz (3D), Pa
  std::vector<double>
      strain_energy;          // of methods that have one of their own, J (per metre depth in 2D); else empty
  double contact_energy = 0;  // of the contacts of bodies, J (per metre depth in 2D)
  double work = 0;            // of driven particles, loads and gravity so far, J (per metre depth in 2D)
  double damped = 0;          // taken by the scene's damping so far, J (per metre depth in 2D)
  Impulse of_walls;           // so far
  std::vector<double> diameter;  // of a particle as drawn: V0^(1/dim), m
  std::vector<int> body;         // index into Scene::bodies
  std::vector<int> material;     // index into Scene::materials
  std::vector<unsigned char> held;

  std::size_t size() const { return m.size(); }
  Point initial(std::size_t i) const { return vector_of(x0, i); }  // position at the start, m
  Point position(std::size_t i) const { return vector_of(x, i); }  // m
  Point velocity(std::size_t i) const { return vector_of(v, i); }  // m/s

 private:
  Point vector_of(const std::vector<double>& rows, std::size_t i) const {
    const auto components = static_cast<std::size_t>(dim);
    Point vector{};
    for (std::size_t a = 0; a < components; ++a) vector[a] = rows[components * i + a];
    return vector;
  }
};

}  // namespace taut
