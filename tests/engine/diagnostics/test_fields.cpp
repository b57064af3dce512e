#include <algorithm>
#include <cmath>
#include <set>

#include <doctest/doctest.h>

#include "engine/diagnostics/fields.hpp"
#include "tests/support/made_snapshot.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;
using test::made_snapshot;

namespace {

double value(const char* key, const Snapshot& now, std::size_t particle = 0) {
  const Field* field = find_field(key);
  REQUIRE_MESSAGE(field != nullptr, key);
  const std::vector<double> values = evaluate(*field, now);
  REQUIRE(values.size() == now.size());
  return values[particle];
}

Snapshot block(int dim) {
  std::vector<Point> places;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < (dim == 3 ? 3 : 1); ++k) places.push_back({1.0 * i, 1.0 * j, 1.0 * k});
  return made_snapshot(dim, places);
}

Point turned(const Point& X, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * X[0] - s * X[1], s * X[0] + c * X[1], X[2]};
}

void move(Snapshot& now, const auto& motion) {
  const auto d = static_cast<std::size_t>(now.dim);
  for (std::size_t i = 0; i < now.size(); ++i) {
    const Point x = motion(now.initial(i));
    for (std::size_t k = 0; k < d; ++k) now.x[d * i + k] = x[k];
  }
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("fields: every row has a unique key, a name, a help text and, unless dimensionless, a unit") {
    std::set<std::string_view> keys;
    for (const Field& field : fields()) {
      CAPTURE(field.key);
      CHECK(keys.insert(field.key).second);
      CHECK(find_field(field.key) == &field);
      CHECK_FALSE(field.name.empty());
      CHECK(field.unit.empty() == (field.of_map || field.of_all || field.counts != Counted::nothing));
      CHECK_FALSE(field.help.empty());
    }
    CHECK(keys.size() == fields().size());
    CHECK(keys.contains("von_mises"));
    CHECK(find_field("von_Mises") == nullptr);
    CHECK(find_field("") == nullptr);
  }

  TEST_CASE("fields: in 2D stress components are s − p I, and the von Mises stress includes s_zz") {
    Snapshot now = made_snapshot(2, {{0, 0, 0}, {1, 0, 0}});
    now.p = {0, 10};
    now.s = {0, 0, 0, 0, 3, 5, 1, -4};
    CHECK(value("stress_xx", now, 1) == -10 + 3);
    CHECK(value("stress_xy", now, 1) == 5);
    CHECK(value("stress_yy", now, 1) == -10 + 1);
    CHECK(value("pressure", now, 1) == 10);
    CHECK(value("von_mises", now, 1) == Approx(std::sqrt(1.5 * (9 + 1 + 16 + 2 * 25))));
    CHECK(value("von_mises", now, 0) == 0);
  }

  TEST_CASE("fields: von Mises stress is the tension of a bar and √3 times pure shear") {
    Snapshot bar = made_snapshot(2, {{0, 0, 0}});
    bar.p = {-2};
    bar.s = {4, 0, -2, -2};
    CHECK(value("stress_xx", bar) == 6);
    CHECK(value("stress_yy", bar) == 0);
    CHECK(value("von_mises", bar) == Approx(6));
    bar.s = {0, 6, 0, 0};
    CHECK(value("von_mises", bar) == Approx(6 * std::sqrt(3.0)));
  }

  TEST_CASE("fields: in 3D von Mises stress does not depend on the axes") {
    Snapshot now = made_snapshot(3, {{0, 0, 0}, {1, 0, 0}});
    now.p = {1, 1};
    now.s = {4, 0, 0, -2, 0, -2, 0, 2, 2, 0, 2, 0};  // xx, xy, xz, yy, yz, zz
    CHECK(value("von_mises", now, 0) == Approx(6));
    CHECK(value("von_mises", now, 1) == Approx(6));
    CHECK(value("stress_xx", now, 0) == 3);
    CHECK(value("stress_yy", now, 0) == -3);
    CHECK(value("stress_xy", now, 0) == 0);
    CHECK(value("stress_xy", now, 1) == 2);
  }

  TEST_CASE("fields: in 3D stress components are s − p I, and principal stresses are sorted") {
    Snapshot now = made_snapshot(3, {{0, 0, 0}, {1, 0, 0}});
    now.p = {7, 1};
    now.s = {1, 2, 3, 4, 5, -5, 0, 2, 2, 0, 2, 0};  // second: tension along (1, 1, 1)
    CHECK(value("stress_xx", now) == 1 - 7);
    CHECK(value("stress_xy", now) == 2);
    CHECK(value("stress_xz", now) == 3);
    CHECK(value("stress_yy", now) == 4 - 7);
    CHECK(value("stress_yz", now) == 5);
    CHECK(value("stress_zz", now) == -5 - 7);
    CHECK(value("principal_1", now, 1) == Approx(4 - 1));
    CHECK(value("principal_2", now, 1) == Approx(-2 - 1));
    CHECK(value("principal_3", now, 1) == Approx(-2 - 1));
    now.s[1] = NAN;
    CHECK(std::isnan(value("principal_2", now)));
    CHECK(value("principal_1", now, 1) == Approx(3));
  }

  TEST_CASE("fields: principal stresses in 2D are the in-plane ones and σ_zz, greatest first") {
    Snapshot now = made_snapshot(2, {{0, 0, 0}});
    now.p = {1};
    now.s = {3, 4, -3, 0.5};
    CHECK(value("principal_1", now) == Approx(4));
    CHECK(value("principal_2", now) == Approx(-0.5));
    CHECK(value("principal_3", now) == Approx(-6));
  }

  TEST_CASE("fields: some fields exist in 3D only") {
    CHECK(fields(2).size() + 8 == fields(3).size());
    for (const char* key :
         {"velocity_z", "displacement_z", "stress_xz", "stress_yz", "stress_zz", "strain_zz"}) {
      CAPTURE(key);
      CHECK(find_field(key, 3) != nullptr);
      CHECK(find_field(key, 2) == nullptr);
    }
    CHECK(find_field("principal_3", 2) == find_field("principal_3", 3));
  }

  TEST_CASE("fields: displacement, velocity and density equal the values of the particle") {
    Snapshot now = made_snapshot(3, {{9, 9, 9}, {1, 2, 3}});
    now.x = {9, 9, 9, 3, -1, 9};
    now.v = {0, 0, 0, 1, -2, 2};
    now.rho = {1, 7};
    CHECK(value("displacement", now, 1) == Approx(7));
    CHECK(value("displacement_x", now, 1) == 2);
    CHECK(value("displacement_y", now, 1) == -3);
    CHECK(value("displacement_z", now, 1) == 6);
    CHECK(value("speed", now, 1) == Approx(3));
    CHECK(value("velocity_x", now, 1) == 1);
    CHECK(value("velocity_y", now, 1) == -2);
    CHECK(value("velocity_z", now, 1) == 2);
    CHECK(value("density", now, 1) == 7);
    CHECK(value("displacement", now, 0) == 0);
    CHECK(value("speed", now, 0) == 0);
  }

  TEST_CASE("fields: J and logarithmic strains of an affine motion are exact at every particle") {
    for (const int dim : {2, 3}) {
      CAPTURE(dim);
      // F = V R
      const double c = std::cos(M_PI / 6), s = std::sin(M_PI / 6), a = std::log(1.5), b = std::log(0.8);
      const double third = dim == 3 ? 1.25 : 1;
      Snapshot now = block(dim);
      move(now, [&](const Point& X) -> Point {
        const Point r = turned(X, 2 * M_PI / 9);
        const double u = 1.5 * (c * r[0] + s * r[1]), w = 0.8 * (-s * r[0] + c * r[1]);
        return {c * u - s * w + 7, s * u + c * w, third * r[2]};
      });
      const double e = std::log(third), mean = (a + b + e) / 3;
      const double square = (a - mean) * (a - mean) + (b - mean) * (b - mean) + (e - mean) * (e - mean);
      for (std::size_t i = 0; i < now.size(); ++i) {
        CHECK(value("J", now, i) == Approx(1.5 * 0.8 * third).epsilon(1e-7));
        CHECK(value("strain_xx", now, i) == Approx(c * c * a + s * s * b).epsilon(1e-7));
        CHECK(value("strain_yy", now, i) == Approx(s * s * a + c * c * b).epsilon(1e-7));
        CHECK(value("strain_xy", now, i) == Approx(c * s * (a - b)).epsilon(1e-7));
        if (dim == 3) CHECK(value("strain_zz", now, i) == Approx(e).epsilon(1e-7));
        CHECK(value("equivalent_strain", now, i) == Approx(std::sqrt(2.0 / 3 * square)).epsilon(1e-7));
      }
    }
  }

  TEST_CASE(
      "fields: bodies one particle thick turn without strain, and are strained along their length only") {
    const std::vector<Point> row = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    std::vector<Point> sheet = row;
    for (const Point& at : row) sheet.push_back({at[0], 1, 0});
    const std::vector<Snapshot> thin = {made_snapshot(2, row), made_snapshot(3, row),
                                        made_snapshot(3, sheet)};
    for (Snapshot now : thin) {
      CAPTURE(now.dim);
      CAPTURE(now.size());
      move(now, [](const Point& X) -> Point {  // stretch along x, then turns about z and x
        const Point r = turned({1.2 * X[0], X[1], 0}, 1.5);
        return {r[0], 0.8 * r[1], 0.6 * r[1]};
      });
      if (now.dim == 2) move(now, [](const Point& X) { return turned({1.2 * X[0], X[1], 0}, 1.5); });
      for (std::size_t i = 0; i < now.size(); ++i) {
        CHECK(value("J", now, i) == Approx(1.2).epsilon(1e-6));
        CHECK(value("equivalent_strain", now, i) == Approx(std::log(1.2) * 2 / 3).epsilon(1e-6));
      }
    }
  }

  TEST_CASE("fields: zigzag is the amplitude over the spacing, and 0 for rotations and stretches") {
    std::vector<Point> places;
    for (int k = 0; k < 64; ++k) places.push_back({1.0 * (k % 8), 1.0 * (k / 8), 0});
    Snapshot now = made_snapshot(2, places);
    move(now, [](const Point& X) -> Point { return {2 * X[1] + 3, -0.5 * X[0], 0}; });
    for (std::size_t i = 0; i < now.size(); ++i) CHECK(value("zigzag", now, i) < 1e-12);
    for (std::size_t i = 0; i < now.size(); ++i) now.x[2 * i] += i % 2 ? 0.1 : -0.1;
    CHECK(value("zigzag", now, 27) == relative(0.1, 1e-9));
    now.diameter[63] = 1.2;
    CHECK(value("zigzag", now, 27) == relative(0.1, 1e-9));
    CHECK(value("zigzag", now, 0) == 0);
  }

  TEST_CASE("fields: a rotated body beside another body has no strain") {
    Snapshot now = block(3);
    const std::size_t n = now.size();
    Snapshot other = block(3);
    for (double& x : other.x0) x += 2.5;
    now.resize(3, 2 * n);
    std::ranges::copy(other.x0, now.x0.begin() + static_cast<std::ptrdiff_t>(3 * n));
    std::fill(now.diameter.begin(), now.diameter.end(), 1.0);
    std::fill(now.body.begin() + static_cast<std::ptrdiff_t>(n), now.body.end(), 1);
    now.x = now.x0;
    for (std::size_t i = 0; i < n; ++i) {
      const Point x = turned(now.initial(i), 2.0);
      std::ranges::copy(x, now.x.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
    for (const char* key : {"strain_xx", "strain_xy", "strain_yy", "strain_xz", "strain_yz", "strain_zz",
                            "equivalent_strain"}) {
      CAPTURE(key);
      for (std::size_t i = 0; i < n; ++i) CHECK(std::abs(value(key, now, i)) < 1e-7);
    }
    for (std::size_t i = 0; i < n; ++i) CHECK(value("J", now, i) == Approx(1).epsilon(1e-7));
    CHECK(value("body", now, 0) == 0);
    CHECK(value("body", now, n) == 1);
  }

  TEST_CASE("fields: an isolated particle has no strain") {
    Snapshot now = made_snapshot(2, {{0, 0, 0}, {9, 0, 0}});
    now.x = {1, 1, 0, 0};
    CHECK(value("J", now) == 1);
    CHECK(value("equivalent_strain", now) == 0);
  }

  TEST_CASE("fields: fields with negative values are signed, and norms and density are not") {
    Snapshot now = made_snapshot(2, {{0, 0, 0}});
    now.x = {-1, -1};
    now.v = {-1, -1};
    now.p = {-1};
    now.s = {-3, -1, -3, 6};
    for (const Field& field : fields(2)) {
      CAPTURE(field.key);
      if (evaluate(field, now)[0] < 0) CHECK(field.is_signed);
    }
    for (const char* key : {"von_mises", "speed", "density", "displacement"}) {
      CHECK_FALSE(find_field(key)->is_signed);
    }
  }
}

}  // namespace of_this_file
