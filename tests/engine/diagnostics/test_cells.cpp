#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/diagnostics/cells.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

using Vector = std::array<double, 3>;

struct Lattice {
  std::vector<double> x, diameter;
  std::vector<int> body;

  Cells cells(int dim) const { return {dim, x, diameter, body}; }
};

Lattice block(int dim, int n, double dp, double angle = 0) {
  Lattice lattice;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < (dim == 3 ? n : 1); ++k) {
        const double a = (i + 0.5) * dp, b = (j + 0.5) * dp;
        lattice.x.push_back(std::cos(angle) * a - std::sin(angle) * b);
        lattice.x.push_back(std::sin(angle) * a + std::cos(angle) * b);
        if (dim == 3) lattice.x.push_back((k + 0.5) * dp);
        lattice.diameter.push_back(dp);
        lattice.body.push_back(0);
      }
  return lattice;
}

std::vector<double> moved(const std::vector<double>& x, int dim, const std::array<Vector, 3>& F) {
  std::vector<double> result(x.size());
  const auto d = static_cast<std::size_t>(dim);
  for (std::size_t i = 0; i < x.size(); ++i) {
    result[i] = 0.7;
    for (std::size_t k = 0; k < d; ++k) result[i] += F[i % d][k] * x[i - i % d + k];
  }
  return result;
}

constexpr std::array<Vector, 3> map_of_space{{{1.2, 0.3, -0.1}, {-0.4, 0.9, 0.2}, {0.1, -0.2, 1.1}}};

double measure(const double* e, std::size_t dim) {
  if (dim == 2) return std::abs(e[0] * e[3] - e[1] * e[2]);
  return std::abs(e[0] * (e[4] * e[8] - e[5] * e[7]) - e[1] * (e[3] * e[8] - e[5] * e[6]) +
                  e[2] * (e[3] * e[7] - e[4] * e[6]));
}

double sum_of_measures(const CellShapes& shapes, std::size_t dim) {
  double sum = 0;
  for (std::size_t i = 0; i < shapes.particle.size(); ++i) sum += measure(&shapes.edge[dim * dim * i], dim);
  return sum;
}

bool has_edge(const CellShapes& shapes, std::size_t cell, int dim, const Vector& wanted) {
  const auto d = static_cast<std::size_t>(dim);
  for (std::size_t k = 0; k < d; ++k) {
    const double* edge = &shapes.edge[d * (d * cell + k)];
    for (const double sign : {1.0, -1.0}) {
      double off = 0;
      for (std::size_t c = 0; c < d; ++c) off += std::abs(sign * edge[c] - wanted[c]);
      if (off < 1e-9) return true;
    }
  }
  return false;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("cells: an affine motion deforms each cell affinely") {
    const double dp = 0.1;
    for (const int dim : {2, 3}) {
      const auto d = static_cast<std::size_t>(dim);
      for (const double angle : {0.0, 0.4}) {
        const Lattice lattice = block(dim, 5, dp, angle);
        const std::vector<double> now = moved(lattice.x, dim, map_of_space);
        const CellShapes shapes = lattice.cells(dim).at(now);
        REQUIRE(shapes.edge.size() == shapes.particle.size() * d * d);
        for (std::size_t i = 0; i < shapes.particle.size(); ++i) {
          for (std::size_t c = 0; c < d; ++c)
            CHECK(shapes.centre[d * i + c] == Approx(now[d * shapes.particle[i] + c]));
          Vector along{}, across{};
          for (std::size_t c = 0; c < d; ++c) {
            along[c] = dp * (map_of_space[c][0] * std::cos(angle) + map_of_space[c][1] * std::sin(angle));
            across[c] = dp * (-map_of_space[c][0] * std::sin(angle) + map_of_space[c][1] * std::cos(angle));
          }
          CHECK(has_edge(shapes, i, dim, along));
          CHECK(has_edge(shapes, i, dim, across));
        }
      }
    }
  }

  TEST_CASE("cells: in 3D interior cells are left out until the body tears") {
    const int n = 6;
    Lattice lattice = block(3, n, 0.1);
    const Cells cells = lattice.cells(3);
    const auto outside = static_cast<std::size_t>(n * n * n - (n - 2) * (n - 2) * (n - 2));
    CHECK(cells.at(lattice.x).particle.size() == outside);
    CHECK(cells.at(moved(lattice.x, 3, map_of_space)).particle.size() == outside);
    std::vector<double> apart = lattice.x;
    for (std::size_t i = 0; i < apart.size(); i += 3)
      if (apart[i] > 0.3) apart[i] += 0.2;
    CHECK(cells.at(apart).particle.size() == outside + 2 * (n - 2) * (n - 2));
  }

  TEST_CASE("cells: cells of a ring lie along its layers and are as thick as the layers are apart") {
    Lattice ring;
    const double dr = 0.1;
    const int layers = 3, count = 58;
    for (int layer = 0; layer < layers; ++layer)
      for (int k = 0; k < count; ++k) {
        const double r = 1 + dr * layer, angle = 2 * M_PI * k / count;
        ring.x.push_back(r * std::cos(angle)), ring.x.push_back(r * std::sin(angle));
        ring.diameter.push_back(std::sqrt(2 * M_PI * r / count * dr)), ring.body.push_back(0);
      }
    const CellShapes shapes = ring.cells(2).at(ring.x);
    for (std::size_t i = 0; i < shapes.particle.size(); ++i) {
      const double x = ring.x[2 * i], y = ring.x[2 * i + 1], r = std::hypot(x, y);
      const double* e = &shapes.edge[4 * i];
      const double along = std::max(std::abs(e[1] * x - e[0] * y), std::abs(e[3] * x - e[2] * y)) / r;
      const double across = std::max(std::abs(e[0] * x + e[1] * y), std::abs(e[2] * x + e[3] * y)) / r;
      CHECK(across == Approx(dr).epsilon(0.01));
      CHECK(along == Approx(ring.diameter[i] * ring.diameter[i] / dr).epsilon(0.01));
    }
  }

  TEST_CASE("cells: neighbouring bodies do not affect each other's cells") {
    Lattice two = block(2, 4, 0.1);
    const Lattice one = two;
    for (std::size_t i = 0; i < one.x.size(); i += 2) {
      two.x.push_back(one.x[i] + 0.4), two.x.push_back(one.x[i + 1]);
      two.diameter.push_back(0.1), two.body.push_back(1);
    }
    std::vector<double> now = two.x;
    for (std::size_t i = one.x.size(); i < now.size(); i += 2) now[i + 1] += 0.03;
    const CellShapes shapes = two.cells(2).at(now);
    for (std::size_t i = 0; i < shapes.particle.size(); ++i) CHECK(has_edge(shapes, i, 2, {0.1, 0, 0}));
  }

  TEST_CASE("cells: boundary particles have the inner part of a cell") {
    const double dp = 0.1;
    // volume of a boundary particle over the volume of its full cell: 1/2 at a plane of symmetry, less at free faces
    for (const auto& [dim, part] : {std::pair{2u, 0.5}, {3u, 0.5}, {2u, 1.0 / 3}, {3u, 0.41}}) {
      const int n = 5;
      Lattice lattice = block(static_cast<int>(dim), n, dp);
      for (std::size_t i = 0; i < lattice.diameter.size(); ++i) {
        double volume = 1;
        for (std::size_t c = 0; c < dim; ++c) {
          const double at = lattice.x[dim * i + c];
          if (at < dp || at > (n - 1) * dp) volume *= part;
        }
        lattice.diameter[i] = dp * std::pow(volume, 1.0 / static_cast<double>(dim));
      }
      const CellShapes shapes = lattice.cells(static_cast<int>(dim)).at(lattice.x);
      double expected = std::pow((n - 1) * dp, dim);
      if (dim == 3) expected -= std::pow((n - 2) * dp, 3);  // interior particles are not drawn
      CHECK(sum_of_measures(shapes, dim) == Approx(expected));
      for (std::size_t i = 0; i < shapes.particle.size(); ++i)
        for (std::size_t c = 0; c < dim; ++c) {
          double reach = 0;
          for (std::size_t k = 0; k < dim; ++k) reach += std::abs(shapes.edge[dim * (dim * i + k) + c]) / 2;
          CHECK(shapes.centre[dim * i + c] - reach > 0.5 * dp - 1e-9);
          CHECK(shapes.centre[dim * i + c] + reach < (n - 0.5) * dp + 1e-9);
        }
    }
  }

  TEST_CASE("cells: single particles and single rows of particles have cells") {
    Lattice single;
    single.x = {0.1, 0.2, 0.3}, single.diameter = {0.1}, single.body = {0};
    CHECK(sum_of_measures(single.cells(3).at(single.x), 3) == Approx(1e-3));
    Lattice row;
    for (int i = 0; i < 4; ++i) {
      for (const double at : {0.1 * i, 0.0, 0.0}) row.x.push_back(at);
      row.diameter.push_back(0.1), row.body.push_back(0);
    }
    std::vector<double> longer = row.x;
    for (double& at : longer) at *= 1.5;
    CHECK(sum_of_measures(row.cells(3).at(longer), 3) == Approx(4 * 1.5e-3));
    std::vector<double> upright(row.x.size());
    for (std::size_t i = 0; i < 4; ++i) upright[3 * i + 1] = row.x[3 * i];
    CHECK(sum_of_measures(row.cells(3).at(upright), 3) == Approx(4e-3));
    CHECK(Cells(2, {}, {}, {}).at({}).particle.empty());
  }
}

}  // namespace of_this_file
