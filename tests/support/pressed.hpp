#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/contact/face_contacts.hpp"
#include "engine/contact/facet_contacts.hpp"
#include "engine/methods/catalogue.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace taut::test {

inline Scene scene_of_shapes(const std::vector<Shape>& shapes, int dim, double dp) {
  Scene scene;
  scene.name = "faces";
  scene.dim = dim;
  scene.spacing = dp;
  scene.materials = {ring_rubber()};
  scene.contact = ContactLaw::surface;
  for (const Shape& shape : shapes) {
    Body body;
    body.name = "body " + std::to_string(scene.bodies.size());
    body.shapes = {shape};
    scene.bodies.push_back(body);
  }
  return scene;
}

/// Evaluates surface contact without a solver.
template <int Dim>
class Pressed {
 public:
  using V = Vec<double, Dim>;

  explicit Pressed(const Scene& scene)
      : scene_(scene), initial_(make_initial_particles(scene_)), walls_(scene_), faces_(input()) {
    for (int i = 0; i < initial_.size(); ++i) {
      V x;
      for (int k = 0; k < Dim; ++k) x[k] = initial_.x[i][k];
      s.x.push_back(x);
      s.v.push_back({});
      s.m.push_back(1);
      s.mobile.push_back(1);
      s.id.push_back(i);
      s.body.push_back(initial_.body[i]);
    }
  }

  void shift(int body, const V& by) {
    for (int i = 0; i < s.size(); ++i)
      if (s.body[i] == body) s.x[i] += by;
  }
  const std::vector<V>& forces() {
    faces_.search(s, walls_, {});
    return forces_as_found();
  }
  const std::vector<V>& forces_as_found() {
    force_.assign(s.size(), V{});
    faces_.evaluate(s, 1, walls_, force_, 1);
    return force_;
  }
  V force_on(int body) {
    V sum{};
    const std::vector<V>& f = forces();
    for (int i = 0; i < s.size(); ++i)
      if (s.body[i] == body) sum += f[i];
    return sum;
  }
  double energy() { return faces_.energy(s, walls_); }
  double gap() { return faces_.gap(s, 0, 1); }
  V between(int a, int b) const { return faces_.between(s, a, b); }
  V of_wall(int a) const { return faces_.of_wall(s, a, 0, walls_); }
  const Impulse& of_walls() const { return walls_.recorded_impulse(); }
  const std::vector<int>& touching() const { return faces_.touching(); }

  Particles<Dim> s;

 private:
  SolverInput input() {
    constants_.dp = scene_.spacing;
    constants_.contact_stiffness = 2;
    std::vector<Elasticity> materials;
    for (const Material& material : scene_.materials) {
      Elasticity& e = materials.emplace_back();
      e.K = material.bulk_modulus();
      e.G = material.shear_modulus();
    }
    return {find_method("oenog")->formulation,
            scene_,
            initial_,
            constants_,
            materials,
            Law::none,
            ContactLaw::surface,
            true,
            Stepping::dual,
            1};
  }

  Scene scene_;
  InitialParticles initial_;
  Constants constants_;
  WallContacts<Dim> walls_;
  ContactsOfFaces<Dim> faces_;
  std::vector<V> force_;
};

/// Bends the face x = 0 onto a circle of radius |r|. The body, x > 0, is inside the circle if r > 0.
template <int Dim>
Vec<double, Dim> bent(Vec<double, Dim> x, double r) {
  const double angle = x[1] / r, away = r - x[0];
  x[0] = r - away * std::cos(angle), x[1] = away * std::sin(angle);
  return x;
}

/// Number of particles of a block that may touch and started at least `inside` from its ends.
template <int Dim, class Motion>
int touching_after(const Motion& motion, double dp, double inside) {
  constexpr double height = 0.02;
  Pressed<Dim> body(scene_of_shapes({Box{{0, 0, 0}, {0.006, height, Dim == 3 ? 0.006 : 0}}}, Dim, dp));
  const auto start = body.s.x;
  for (auto& x : body.s.x) x = motion(x);
  body.forces();
  return static_cast<int>(std::ranges::count_if(
      body.touching(), [&](int i) { return std::min(start[i][1], height - start[i][1]) >= inside; }));
}

}  // namespace taut::test
