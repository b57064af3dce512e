#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "engine/diagnostics/lattice_volume.hpp"
#include "engine/diagnostics/measures.hpp"
#include "engine/diagnostics/measures_in_space.hpp"
#include "engine/error.hpp"
#include "tests/support/made_snapshot.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

/// The third particle is also displaced by `extra`.
Snapshot sheared(Point extra = {}) {
  Snapshot now = made_snapshot(2, {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 2}});
  for (std::size_t i = 0; i < now.size(); ++i) now.x[2 * i] += 0.1 * now.x0[2 * i + 1];
  for (std::size_t k = 0; k < 2; ++k) now.x[2 * 2 + k] += extra[k];
  return now;
}

Measure displacement() {
  Measure measure;
  measure.name = "displacement";
  measure.kind = "field_rmse";
  measure.fields = {"displacement_x", "displacement_y"};
  return measure;
}

std::vector<Solution> shear() {
  return {[](const Point& x, double t) { return t * x[1]; }, [](const Point&, double) { return 0.0; }};
}

/// Adds a linearised rigid motion.
void move(Snapshot& now) {
  for (std::size_t i = 0; i < now.size(); ++i) {
    now.x[2 * i] += 0.3 - 0.5 * now.x0[2 * i + 1];
    now.x[2 * i + 1] += -0.2 + 0.5 * now.x0[2 * i];
  }
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE(
      "field_error: the error is relative to the greatest value of the solution at the snapshot's time") {
    Snapshot now = sheared({0.03, -0.04});
    now.time = 0.1;
    const auto error = field_error(displacement(), now, shear());
    REQUIRE(error);
    CHECK(error->greatest == Approx(0.05 / 0.2));
    CHECK(error->rms == Approx(0.05 / 0.2 / std::sqrt(5.0)));
    now.time = 0;
    CHECK_FALSE(field_error(displacement(), now, shear()));
    Scene scene;
    scene.measures = {displacement()};
    scene.references["neo_hookean"].solution["displacement"] = shear();
    CHECK(measure(scene, {{0}, {}}, "neo_hookean", {}, &now)[0].why ==
          "the reference is 0 everywhere, so there is no relative error");
    std::ranges::fill(now.clamped, 1);
    CHECK(measure(scene, {{0}, {}}, "neo_hookean", {}, &now)[0].why ==
          "all particles of the body are clamped");
    Measure misspelt = displacement();
    misspelt.fields[0] = "displacement_z";
    CHECK_THROWS_AS(field_error(misspelt, now, shear()), SceneError);
  }

  TEST_CASE("field_error: clamped particles and other bodies do not count") {
    Snapshot now = sheared({1, 0});
    now.time = 0.1;
    now.clamped[2] = 1;
    CHECK(field_error(displacement(), now, shear())->greatest == Approx(0).scale(1).epsilon(1e-12));
    now.clamped[2] = 0;
    now.body[2] = 1;
    CHECK(field_error(displacement(), now, shear())->rms == Approx(0).scale(1).epsilon(1e-12));
  }

  TEST_CASE("field_error: a rigid motion is subtracted only if the measure requests it") {
    Measure free = displacement();
    free.rigid_motion_free = true;
    Snapshot now = sheared();
    now.time = 0.1;
    move(now);
    CHECK(field_error(displacement(), now, shear())->greatest > 1);
    CHECK(field_error(free, now, shear())->greatest < 1e-12);
    Snapshot at_place = sheared({0.03, -0.04}), moved = at_place;
    at_place.time = moved.time = 0.1;
    move(moved);
    const double left = field_error(free, at_place, shear())->rms;
    CHECK(left > 0.3 * field_error(displacement(), at_place, shear())->rms);
    CHECK(left < field_error(displacement(), at_place, shear())->rms);
    CHECK(field_error(free, moved, shear())->rms == Approx(left).epsilon(1e-9));
  }

  TEST_CASE("field_error: in 3D a rotation about any axis is subtracted") {
    const auto displaced = [](double moved, Point extra) {
      Snapshot now = made_snapshot(3, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}, {0.5, 2, 3}});
      now.time = 0.1;
      for (std::size_t i = 0; i < now.size(); ++i) {
        const Point X = now.initial(i);
        now.x[3 * i] += 0.1 * X[1] + moved * (0.3 + 0.5 * X[2] + 0.4 * X[1]);
        now.x[3 * i + 1] += moved * (-0.2 - 0.4 * X[0] - 0.2 * X[2]);
        now.x[3 * i + 2] += moved * (0.1 + 0.2 * X[1] - 0.5 * X[0]);
      }
      for (std::size_t k = 0; k < 3; ++k) now.x[3 * 3 + k] += extra[k];
      return now;
    };
    Measure fixed = displacement();
    fixed.fields.emplace_back("displacement_z");
    Measure free = fixed;
    free.rigid_motion_free = true;
    std::vector<Solution> exact = shear();
    exact.emplace_back([](const Point&, double) { return 0.0; });
    CHECK(field_error(fixed, displaced(1, {}), exact)->greatest > 1);
    CHECK(field_error(free, displaced(1, {}), exact)->greatest < 1e-12);
    const double left = field_error(free, displaced(0, {0.03, -0.04, 0.05}), exact)->rms;
    CHECK(left > 0.2 * field_error(fixed, displaced(0, {0.03, -0.04, 0.05}), exact)->rms);
    CHECK(left < field_error(fixed, displaced(0, {0.03, -0.04, 0.05}), exact)->rms);
    CHECK(field_error(free, displaced(1, {0.03, -0.04, 0.05}), exact)->rms == Approx(left).epsilon(1e-9));
  }

  TEST_CASE("field_rmse, field_error: the result is taken at the end of the run, and its reference is 0") {
    Scene scene = made_scene(2, 1, {unit_bulk()});
    scene.until = 0.1;
    scene.measures = {displacement(), displacement()};
    scene.measures[1].name = "worst";
    scene.measures[1].kind = "field_error";
    Reference& reference = scene.references["neo_hookean"];
    reference.name = "exact";
    reference.solution = {{"displacement", shear()}, {"worst", shear()}};
    Snapshot now = sheared({0.03, -0.04});
    now.time = 0.1;
    const auto results = measure(scene, {}, "neo_hookean", {}, &now);
    CHECK(*results[0].value == Approx(0.25 / std::sqrt(5.0)));
    CHECK(*results[0].reference == 0);
    CHECK(*results[0].error == *results[0].value);
    CHECK(*results[1].value == Approx(0.25));
    now.time = 0.09;
    CHECK_FALSE(measure(scene, {}, "neo_hookean", {}, &now)[0].value);
    CHECK_FALSE(measure(scene, {}, "neo_hookean")[1].value);
    CHECK_FALSE(measure(scene, {}, "2d_deviator", {}, &now)[0].value);
  }

  TEST_CASE("volume_change: the sum over cells between particles is exact for trilinear maps") {
    for (const int dim : {2, 3}) {
      CAPTURE(dim);
      std::vector<Point> places{{9, 0.5, 0}};
      for (int k = 0; k <= (dim == 3 ? 2 : 0); ++k)
        for (int j = 0; j <= 1; ++j)
          for (int i = 0; i <= 3; ++i) places.push_back({0.5 * i, 0.25 * j, 0.125 * k});
      Snapshot now = made_snapshot(dim, places);
      now.body[0] = 1;
      now.diameter.assign(now.size(), 0.2);
      CHECK(lattice_volume(now, 0, now.x0) == Approx(dim == 3 ? 1.5 * 0.25 * 0.25 : 1.5 * 0.25));
      CHECK(lattice_volume(now, 1, now.x0) == 0);
      const auto d = static_cast<std::size_t>(dim);
      for (std::size_t i = 0; i < now.size(); ++i) {
        const Point X = now.initial(i);
        now.x[d * i] = 1.1 * X[0] * (1 + X[2]) + 3 * X[1];
        now.x[d * i + 1] = X[1] * (dim == 2 ? 2 + X[0] : 2 * (1 + X[2]));
      }
      const double mean = dim == 2 ? 1.1 * 2.75 - 3 * 0.125 : 2.2 * (std::pow(1.25, 3) - 1) / 0.75;
      Scene scene = made_scene(dim, 0.5, {unit_bulk(), unit_bulk()});
      Measure measured;
      measured.name = measured.kind = "volume_change";
      scene.measures = {measured};
      scene.until = 0;
      CHECK(*measure(scene, {}, "neo_hookean", {}, &now)[0].value == Approx(mean - 1));
      scene.until = 1;
      CHECK_FALSE(measure(scene, {}, "neo_hookean", {}, &now)[0].value);
    }
  }

  TEST_CASE("volume_change: the gap between two parts of a body is not a cell") {
    std::vector<Point> places;
    for (const double from : {0.0, 3.0})
      for (int j = 0; j <= 2; ++j)
        for (int i = 0; i <= 2; ++i) places.push_back({from + 0.5 * i, 0.5 * j, 0});
    Snapshot now = made_snapshot(2, places);
    now.diameter.assign(now.size(), 0.5);
    CHECK(lattice_volume(now, 0, now.x0) == Approx(2));
    for (std::size_t i = 9; i < now.size(); ++i) now.x[2 * i] += 1;
    CHECK(lattice_volume(now, 0, now.x) == Approx(2));
  }
}

}  // namespace of_this_file
