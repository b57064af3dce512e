#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>
#include <vector>

#include <doctest/doctest.h>

#include "engine/layout/surface_mesh.hpp"
#include "engine/scene/shapes/turned.hpp"
#include "tests/support/pressed.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

constexpr double pi = std::numbers::pi, dp = 0.002;

Ring shell(Point centre = {}) { return {centre, 0.012, 0.02, RoundLayout::aligned}; }
Cylinder pipe(Point from, Point to) { return {from, to, 0.02, 0.012, RoundLayout::aligned}; }

double volume_of(const std::vector<InitialSite>& sites) {
  return std::accumulate(sites.begin(), sites.end(), 0.0,
                         [](double sum, const InitialSite& site) { return sum + site.V0; });
}

struct Faces {
  double area = 0, outwards = 0;  // outwards: ∫ outward distance from site to patch dA
  double aside = 0;               // greatest tangential distance from site to patch
  Point sum{};
  explicit Faces(const FacePatches& faces, const std::vector<InitialSite>& sites) {
    for (const FacePatches::Patch& patch : faces.patches) {
      std::array<Point, 4> corner{};
      for (std::size_t k = 0; k < corner.size(); ++k) corner[k] = faces.node[patch.node[k]];
      const Point a = vector_area(corner);
      const double size = distance_between(a, {}, 3);
      double out = 0, square = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        sum[k] += a[k];
        double way = -sites[patch.site].x[k];
        for (const Point& x : corner) way += 0.25 * x[k];
        out += way * a[k] / size;
        square += way * way;
      }
      area += size, outwards += out * size;
      aside = std::max(aside, std::sqrt(std::max(0.0, square - out * out)));
    }
  }
};

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("aligned layers: a hollow ball has its exact volume, four layers and the symmetries of a cube") {
    const std::vector<InitialSite> sites = shell().sites(3, dp);
    const double volume = measure_of_ball(3, 0.02) - measure_of_ball(3, 0.012);
    CHECK(volume_of(sites) == Approx(volume).epsilon(1e-13));
    CHECK(static_cast<double>(sites.size()) * dp * dp * dp == Approx(volume).epsilon(0.06));
    std::set<double> radii;
    std::set<std::array<double, 4>> places;
    for (const InitialSite& site : sites) {
      radii.insert(std::round(distance_between(site.x, {}, 3) / dp * 1e9));
      places.insert({site.x[0], site.x[1], site.x[2], site.V0});
      CHECK(site.V0 > 0.5 * dp * dp * dp);
      CHECK(site.V0 < 2 * dp * dp * dp);
    }
    CHECK(radii == std::set<double>{6.5e9, 7.5e9, 8.5e9, 9.5e9});
    REQUIRE(places.size() == sites.size());
    for (const InitialSite& site : sites) {
      const Point& x = site.x;
      CHECK(places.contains({-x[0] + 0.0, x[1], x[2], site.V0}));
      CHECK(places.contains({x[1], x[0], x[2], site.V0}));
      CHECK(places.contains({x[1], x[2], x[0], site.V0}));
    }
  }

  TEST_CASE(
      "aligned layers: a pipe along z or an oblique axis has its exact volume and slices that are rings") {
    const std::vector<InitialSite> along = pipe({0, 0, 0}, {0, 0, 0.01}).sites(3, dp);
    CHECK(volume_of(along) == Approx(pi * (4e-4 - 1.44e-4) * 0.01).epsilon(1e-13));
    const std::vector<InitialSite> ring = shell().sites(2, dp);
    REQUIRE(along.size() == 5 * ring.size());
    const Point from{0.001, 0.002, 0.003}, to{0.007, 0.002, 0.011};
    const std::vector<InitialSite> tilted = pipe(from, to).sites(3, dp);
    REQUIRE(tilted.size() == along.size());
    for (std::size_t k = 0; k < tilted.size(); ++k) {
      CHECK(tilted[k].V0 == Approx(along[k].V0).epsilon(1e-12));
      Point x{};
      for (std::size_t a = 0; a < 3; ++a) x[a] = tilted[k].x[a] - from[a];
      const double height = 0.6 * x[0] + 0.8 * x[2];
      CHECK(height == Approx(along[k].x[2]));
      CHECK(distance_between(x, {0.6 * height, 0, 0.8 * height}, 3) ==
            Approx(std::hypot(along[k].x[0], along[k].x[1])));
    }
  }

  TEST_CASE("aligned layers: shapes in 3D with the layout lattice or spaced give no sites and no patches") {
    Ring cut = shell();
    cut.layout = RoundLayout::lattice;
    CHECK(cut.sites(3, dp).empty());
    CHECK(cut.patches(dp).patches.empty());
    cut.layout = RoundLayout::spaced;
    CHECK(cut.sites(3, dp).empty());
    CHECK(cut.patches(dp).patches.empty());
    CHECK(Cylinder{{0, 0, 0}, {0, 0, 1}, 0.1}.sites(3, dp).empty());
  }

  TEST_CASE("aligned layers: faces are closed, face outwards and lie in front of the outermost particles") {
    const auto check = [](const auto& shape, double area) {
      const std::vector<InitialSite> sites = shape.sites(3, dp);
      const Faces faces(shape.patches(dp), sites);
      CHECK(faces.area == Approx(area).epsilon(0.01));
      CHECK(faces.outwards == Approx(0.5 * dp * area).epsilon(0.06));
      CHECK(faces.aside < 0.1 * dp);
      for (const double component : faces.sum) CHECK(std::abs(component) < 1e-12 * area);
    };
    check(shell({0.01, 0, 0}), 4 * pi * (4e-4 + 1.44e-4));
    check(pipe({0, 0, 0}, {0.006, 0, 0.008}), 2 * pi * (0.02 + 0.012) * 0.01 + 2 * pi * (4e-4 - 1.44e-4));
    check(Turned{shell(), {{0, 0, 1}, {0.01, 0, 0}, 30}}, 4 * pi * (4e-4 + 1.44e-4));
  }

  TEST_CASE(
      "aligned layers: contact uses the faces of the layers, mirrored to the last bit for a mirrored body") {
    Scene scene = scene_of_shapes({shell({0.03, 0.001, 0})}, 3, dp);
    CHECK(can_have_surface_mesh(scene));
    const InitialParticles initial = make_initial_particles(scene);
    const SurfaceMesh mesh = make_surface_mesh(scene, initial);
    REQUIRE(mesh.closed == std::vector<bool>{true});
    for (const Point& x : mesh.x) {
      const double r = distance_between(x, {0.03, 0.001, 0}, 3);
      CHECK(std::min(std::abs(r - 0.012), std::abs(r - 0.02)) < 1e-15);
    }
    for (const SurfaceMesh::Facet& facet : mesh.facets) {
      const double r = distance_between(initial.x[facet.particle], {0.03, 0.001, 0}, 3);
      CHECK((std::abs(r - 0.013) < 1e-12 || std::abs(r - 0.019) < 1e-12));
      // a chord's middle lies in the body at the outer face, and in the cavity at the inner face
      const double l = std::sqrt(facet.area), bulge = l * l / (r < 0.016 ? -4 * 0.012 : 4 * 0.02);
      CHECK(facet.bulge == Approx(bulge).epsilon(0.25));
    }
    scene.bodies[0].shapes[0].shift(0, -2 * 0.03);
    scene.bodies[0].mirror[0] = true;
    const SurfaceMesh image = make_surface_mesh(scene, make_initial_particles(scene));
    REQUIRE(image.size() == mesh.size());
    for (int n = 0; n < mesh.size(); ++n)
      CHECK(image.x[n] == Point{-mesh.x[n][0], mesh.x[n][1], mesh.x[n][2]});
    for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
      const auto area = [f](const SurfaceMesh& of) {
        std::array<Point, 4> corner{};
        for (std::size_t k = 0; k < corner.size(); ++k) corner[k] = of.x[of.facets[f].node[k]];
        return vector_area(corner);
      };
      const Point a = area(mesh);
      CHECK(area(image) == Point{-a[0], a[1], a[2]});
    }
  }
}

}  // namespace of_this_file
