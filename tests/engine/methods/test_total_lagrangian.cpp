
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <doctest/doctest.h>

#include "engine/diagnostics/balance.hpp"
#include "engine/judge/verdict.hpp"
#include "engine/layout/initial_particles.hpp"
#include "engine/materials/laws.hpp"
#include "engine/methods/tl_displacement/methods.hpp"
#include "engine/methods/tl_mixed/corrected_laplacian.hpp"
#include "engine/methods/tl_mixed/methods.hpp"
#include "engine/methods/tl_mixed/momentum_projection.hpp"
#include "engine/solver/initial_pairs.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

using V2 = Vec<double, 2>;
using M2 = Mat<double, 2>;
using Wendland = Kernel<KernelName::wendland_c2>;

struct Cloud {
  std::vector<V2> X;
  std::vector<double> V;
  std::vector<int> first;
  double dp;
  InitialParticles initial;

  Cloud() {
    const Scene scene = small_collision();
    initial = make_initial_particles(scene);
    dp = scene.spacing;
    first = initial.first;
    V = initial.V0;
    for (const Point& p : initial.x) X.push_back({p[0], p[1]});
  }
  InitialPairs<2> pairs(GradientCorrection gradient = GradientCorrection::corrected) const {
    const double h = tl.h_over_dp * dp;
    return make_initial_pairs<Wendland>(initial_neighbors(initial, reach_of_pairs<Wendland>(h)), X, V, h,
                                        gradient);
  }
};

PairLanes<2> four_at_a_time(const InitialPairs<2>& pairs) {
  return {pairs, 1, [&](int p) { return pairs.k[p]; }};
}

std::vector<M2> gradients(const InitialPairs<2>& pairs, const std::vector<V2>& u) {
  const PairLanes<2> of_four = four_at_a_time(pairs);
  Columns<2> columns;
  columns.resize(pairs.size());
  for (int i = 0; i < pairs.size(); ++i) columns[0][i] = u[i][0], columns[1][i] = u[i][1];
  std::vector<M2> all;
  for (int i = 0; i < pairs.size(); ++i)
    all.push_back(product(lane_of(of_four.view().difference_sum(columns, i / lanes), i % lanes), pairs.B[i]));
  return all;
}

void project_all(std::vector<V2>& a, const std::vector<V2>& Z, const std::vector<double>& V, int first,
                 int last) {
  Columns<2> columns;
  columns.resize(static_cast<int>(a.size()) + lanes);
  for (std::size_t i = 0; i < a.size(); ++i) columns[0][i] = a[i][0], columns[1][i] = a[i][1];
  project_on_momenta(columns, Z.data(), V.data(), first, last);
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = {columns[0][i], columns[1][i]};
}

/// dp² L̂(k) of the wave cos(k·X).
double symbol_on_lattice(double h, const V2& k) {
  constexpr int n = 9;
  std::vector<V2> X;
  InitialParticles initial;
  initial.body.resize(n * n);
  for (int i = 0; i < n * n; ++i) {
    X.push_back({1.0 * (i % n), 1.0 * (i / n)});
    initial.x.push_back({X[i][0], X[i][1]});
  }
  const std::vector<double> V(n * n, 1);
  const auto pairs = make_initial_pairs<Wendland>(initial_neighbors(initial, reach_of_pairs<Wendland>(h)), X,
                                                  V, h, GradientCorrection::corrected);
  const std::vector<double> w = corrected_laplacian<Wendland>(pairs, X, V, h, 1);
  constexpr int middle = n * n / 2;
  double sum = 0;
  for (int p = pairs.begin[middle]; p < pairs.begin[middle + 1]; ++p)
    sum += w[p] * (std::cos(dot(k, X[pairs.j[p]] - X[middle])) - 1);
  return sum;
}

template <class L>
double stress_when_turned(const L& law, double angle) {
  const Cloud cloud;
  std::vector<V2> u;
  for (const V2& X : cloud.X)
    u.push_back({(std::cos(angle) - 1) * X[0] - std::sin(angle) * X[1],
                 std::sin(angle) * X[0] + (std::cos(angle) - 1) * X[1]});
  double most = 0;
  for (M2 F : gradients(cloud.pairs(), u)) {
    F(0, 0) += 1, F(1, 1) += 1;
    const auto [sigma, zz] = law.cauchy(F, determinant(F));
    most =
        std::max({most, std::abs(sigma(0, 0)), std::abs(sigma(0, 1)), std::abs(sigma(1, 1)), std::abs(zz)});
  }
  return most;
}

/// Greatest pressure or deviator component, divided by ρ v² of the corners.
double stress_of_turning(const std::string& method, double angle) {
  const double speed = 0.01;  // in sound speeds
  const Scene scene = rotating_plate(speed);
  const double v = speed * scene.materials[0].sound_speed();
  const auto simulation = make_simulation(scene, with_method(method));
  simulation->advance_to(angle * std::numbers::sqrt2 * 0.01 / v);
  double most = 0;
  for (const double p : simulation->snapshot().p) most = std::max(most, std::abs(p));
  for (const double s : simulation->snapshot().s) most = std::max(most, std::abs(s));
  return most / (scene.materials[0].density * v * v);
}

}  // namespace

TEST_SUITE("term") {
  TEST_CASE("initial pairs: pairs are antisymmetric, within one body, and exact for linear fields") {
    const Cloud cloud;
    const InitialPairs<2> pairs = cloud.pairs();
    const M2 A{{{0.3, -1.2}, {0.7, 2.1}}};
    std::vector<V2> u;
    for (const V2& X : cloud.X)
      u.push_back({A(0, 0) * X[0] + A(0, 1) * X[1], A(1, 0) * X[0] + A(1, 1) * X[1]});
    double lack = 0;
    for (const M2& gradient : gradients(pairs, u))
      for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b) lack = std::max(lack, std::abs(gradient(a, b) - A(a, b)));
    CHECK(lack < 1e-12);
    long seen = 0;
    for (int i = 0; i < pairs.size(); ++i) {
      for (int p = pairs.begin[i]; p < pairs.begin[i + 1]; ++p) {
        const int j = pairs.j[p];
        REQUIRE((i < cloud.first[1]) == (j < cloud.first[1]));
        for (int q = pairs.begin[j]; q < pairs.begin[j + 1]; ++q) {
          if (pairs.j[q] != i) continue;
          ++seen;
          CHECK((pairs.k[p][0] == -pairs.k[q][0] && pairs.k[p][1] == -pairs.k[q][1]));
        }
      }
    }
    CHECK(seen == static_cast<long>(pairs.j.size()));
    CHECK(seen > 6 * pairs.size());
  }

  TEST_CASE("initial pairs: the force is minus the derivative of the energy") {
    const Cloud cloud;
    const InitialPairs<2> pairs = cloud.pairs();
    const LawOf<Law::neo_hookean> law{{5e6, 2e6}};
    std::vector<V2> u;
    for (const V2& X : cloud.X)
      u.push_back({1e-4 * std::sin(900 * X[0] + 300 * X[1]), 1e-4 * std::cos(700 * X[1])});
    const auto F_of = [&](const std::vector<V2>& displacement) {
      std::vector<M2> F = gradients(pairs, displacement);
      for (M2& f : F) f(0, 0) += 1, f(1, 1) += 1;
      return F;
    };
    const auto energy = [&](const std::vector<V2>& displacement) {
      const std::vector<M2> F = F_of(displacement);
      double sum = 0;
      for (int i = 0; i < pairs.size(); ++i) sum += cloud.V[i] * law.energy(F[i], determinant(F[i]));
      return sum;
    };
    Columns<4> stress;
    stress.resize(pairs.size());
    const std::vector<M2> F = F_of(u);
    for (int i = 0; i < pairs.size(); ++i) {
      const M2 VPB = product(law.piola(F[i], determinant(F[i])), cloud.V[i] * pairs.B[i]);
      for (int k = 0; k < 4; ++k) stress[k][i] = VPB(k / 2, k % 2);
    }
    const PairLanes<2> of_four = four_at_a_time(pairs);
    const double step = 1e-4 * cloud.dp;
    for (const int i : {0, 7, pairs.size() / 2, pairs.size() - 1}) {
      const V2 force = lane_of(of_four.view().pair_sum(stress, i / lanes), i % lanes);
      for (int a = 0; a < 2; ++a) {
        std::vector<V2> up = u, down = u;
        up[i][a] += step, down[i][a] -= step;
        CHECK(force[a] == relative(-(energy(up) - energy(down)) / (2 * step), 1e-5));
      }
    }
  }
}

TEST_SUITE("term") {
  TEST_CASE(
      "initial pairs: one-sided forces are exact for differences of a linear stress, and their sum does not vanish") {
    const Cloud cloud;
    const InitialPairs<2> pairs = cloud.pairs();
    const PairLanes<2> of_four = four_at_a_time(pairs);
    const M2 slope_x = {{{3, -1}, {0.5, 2}}}, slope_y = {{{-2, 4}, {1, 0.7}}};
    Columns<4> stress;
    stress.resize(pairs.size());
    const auto length = [](const V2& a) { return std::sqrt(dot(a, a)); };
    const auto at = [&](int i) {
      return combination(1 + cloud.X[i][0] / cloud.dp, slope_x, cloud.X[i][1] / cloud.dp, slope_y);
    };
    for (int i = 0; i < pairs.size(); ++i)
      for (int k = 0; k < 4; ++k) stress[k][i] = at(i)(k / 2, k % 2);
    const V2 divergence = {(slope_x(0, 0) + slope_y(0, 1)) / cloud.dp,
                           (slope_x(1, 0) + slope_y(1, 1)) / cloud.dp};
    V2 one_sided{}, opposite{};
    for (int i = 0; i < pairs.size(); ++i) {
      Sym<Pack, 2> B;
      for (int c = 0; c < 3; ++c) B.c[c] = filled<Pack>(pairs.B[i].c[c]);
      const V2 sum = lane_of(of_four.view().one_sided_sum(stress, B, i / lanes), i % lanes);
      V2 k{};
      for (int p = pairs.begin[i]; p < pairs.begin[i + 1]; ++p) k += pairs.k[p];
      const V2 of_differences = sum - 2.0 * (at(i) * (pairs.B[i] * k));
      CHECK(length(of_differences - divergence) < 1e-11 * length(divergence));
      one_sided += cloud.V[i] * sum;
      opposite += lane_of(of_four.view().pair_sum(stress, i / lanes), i % lanes);
    }
    CHECK(length(one_sided) > 1e-3 * cloud.dp * cloud.dp * length(divergence));
    CHECK(length(opposite) < 1e-12 * cloud.dp * pairs.size());
  }

  TEST_CASE("corrected Laplacian: in 2D linear fields give 0, and the squared distance 4, at surfaces too") {
    const Cloud cloud;
    const InitialPairs<2> pairs = cloud.pairs();
    const std::vector<double> w = corrected_laplacian<Wendland>(
        pairs, cloud.X, cloud.V, pf_jst.h_over_dp * cloud.dp, cloud.dp * cloud.dp);
    const LaplacianLanes<2> of_four = with_laplacian(pairs, w, cloud.V, 1);
    Columns<4> U;
    U.resize(pairs.size());
    for (int i = 0; i < pairs.size(); ++i) {
      for (int j = 0; j < pairs.size(); ++j) {
        const double x = (cloud.X[j][0] - cloud.X[i][0]) / cloud.dp,
                     y = (cloud.X[j][1] - cloud.X[i][1]) / cloud.dp;
        U[0][j] = 1, U[1][j] = 3 + x, U[2][j] = y - 2 * x, U[3][j] = x * x + y * y;
      }
      const Vec<double, 4> L =
          lane_of(differences_and_laplacian(of_four.view(), U, i / lanes).laplacian, i % lanes);
      CHECK(L[0] == 0);
      CHECK(std::abs(L[1]) < 1e-10);
      CHECK(std::abs(L[2]) < 1e-10);
      CHECK(L[3] == relative(4, 1e-10));
    }
  }

  TEST_CASE("projection: the result is the nearest field without force and torque") {
    const Cloud cloud;
    const int first = cloud.first[1], last = cloud.first[2];
    std::vector<V2> a;
    for (const V2& X : cloud.X)
      a.push_back({std::sin(900 * X[0]) + 1, std::cos(700 * X[0] * X[1]) + 40 * X[0]});
    const std::vector<V2> before = a;
    project_all(a, cloud.X, cloud.V, first, last);
    CHECK((a[0][0] == before[0][0] && a[0][1] == before[0][1]));
    V2 force{}, force_before{};
    double torque = 0, torque_before = 0, along = 0, size = 0;
    for (int i = first; i < last; ++i) {
      const V2& X = cloud.X[i];
      const V2 d = a[i] - before[i];
      force += cloud.V[i] * a[i];
      force_before += cloud.V[i] * before[i];
      torque += cloud.V[i] * (X[0] * a[i][1] - X[1] * a[i][0]);
      torque_before += cloud.V[i] * (X[0] * before[i][1] - X[1] * before[i][0]);
      along += cloud.V[i] * dot(d, a[i]);  // the change is orthogonal to all admissible fields
      size += cloud.V[i] * dot(d, d);
    }
    CHECK(std::abs(force[0]) + std::abs(force[1]) < 1e-12 * std::abs(force_before[0]));
    CHECK(std::abs(torque) < 1e-12 * std::abs(torque_before));
    CHECK(size > 0);
    CHECK(std::abs(along) < 1e-12 * size);
  }
}

TEST_SUITE("analytic") {
  TEST_CASE("JST: checkerboards in 2D decay 16 times faster with eight neighbours than with twelve") {
    constexpr double pi = std::numbers::pi;
    CHECK(symbol_on_lattice(pf_jst.h_over_dp, {pi, 0}) == relative(-4, 0.001));
    CHECK(symbol_on_lattice(1.05, {pi, 0}) == relative(-3.66, 0.002));
    CHECK(symbol_on_lattice(pf_jst.h_over_dp, {pi, pi}) ==
          relative(-7.78, 0.002));  // decay is proportional to its square
    CHECK(symbol_on_lattice(1.05, {pi, pi}) == relative(-1.93, 0.002));
  }
  TEST_CASE("total Lagrangian: rotation creates no stress except with the linear law") {
    for (const double angle : {0.4, 1.6, 3.1, -2.0}) {
      CAPTURE(angle);
      CHECK(stress_when_turned(LawOf<Law::neo_hookean>{{1, 1}}, angle) < 1e-12);
      CHECK(stress_when_turned(LawOf<Law::st_venant_kirchhoff>{{1, 1}}, angle) < 1e-12);
      CHECK(stress_when_turned(LawOf<Law::rotated_piola>{{1, 1}}, angle) < 1e-12);
      CHECK(stress_when_turned(LawOf<Law::linear_elastic>{{1, 1}}, angle) > 0.1);
    }
  }
  TEST_CASE("total Lagrangian: a plate rotating by 3.1 rad is stressed by its inertia only") {
    for (const std::string method : {"tl", "icb", "pf-jst", "pfj-jst"}) {
      CAPTURE(method);
      const double stress = stress_of_turning(method, 3.1);
      CHECK(stress > 0.1);
      CHECK(stress < 3);
    }
    CHECK(stress_of_turning("tl-small-strain", 3.1) > 30);
  }
}

TEST_SUITE("failure") {
  TEST_CASE("pf: without dissipation the energy more than doubles, and with dissipation the energy falls") {
    const Scene scene = small_collision();
    const auto gain = [&](const std::string& method) {
      Settings settings = with_method(method);
      settings.cfl = 0.3;  // [Lee2016] §5
      const auto simulation = make_simulation(scene, settings);
      const Balance before = balance(simulation->snapshot(), scene);
      make_steps(*simulation, 2400);
      const Balance after = balance(simulation->snapshot(), scene);
      return (after.kinetic + after.strain) / before.kinetic;
    };
    CHECK(gain("pf") > 2);
    CHECK(gain("pf-jst") < 1);
    CHECK(gain("pfj-jst") < 1);
  }
}

TEST_SUITE("conservation") {
  TEST_CASE("pf-jst: the projection conserves both momenta of a rotating plate") {
    Scene scene = rotating_plate(0.2);
    const auto turn = scene.bodies[0].velocity[0];
    // symmetry alone would conserve the momenta
    scene.bodies[0].velocity[0] = [=](const Point& x) { return turn(x) + 2 * shake(x, 0.007); };
    struct Change {
      double linear, angular;
    };
    const auto change = [&](double projection, double adjoint, double h) {
      Settings settings = with_method("pf-jst");
      settings.constants = {{"projection", projection}, {"adjoint", adjoint}, {"h", h}};
      const auto simulation = make_simulation(scene, settings);
      const Balance before = balance(simulation->snapshot(), scene);
      make_steps(*simulation, 400);
      const Balance after = balance(simulation->snapshot(), scene);
      return Change{std::hypot(after.linear_momentum[0] - before.linear_momentum[0],
                               after.linear_momentum[1] - before.linear_momentum[1]) /
                        before.momentum_scale,
                    std::abs(after.angular_momentum[2] - before.angular_momentum[2]) / before.angular_scale};
    };
    for (const double h : {pf_jst.h_over_dp, 1.05}) {
      for (const double adjoint : {0.0, 1.0}) {
        const Change projected = change(1, adjoint, h);
        CHECK(projected.linear < 1e-12);
        CHECK(projected.angular < 1e-12);
      }
    }
    const Change printed = change(0, 0, 1.05), with_adjoint = change(0, 1, 1.05);
    CHECK(printed.linear > 1e-5);
    CHECK(printed.angular > 1e-4);
    CHECK(with_adjoint.linear < 1e-12);  // the Laplacian of a constant is 0
    CHECK(with_adjoint.angular > 1e-6);
  }
  TEST_CASE("tl: a collision with penalty contact conserves the energy to second order in the step") {
    const Scene scene = small_collision();
    double drift[2] = {};
    for (int k = 0; k < 2; ++k) {
      Settings settings = with_method("tl");
      settings.cfl = k == 0 ? 0.2 : 0.1;
      const auto simulation = make_simulation(scene, settings);
      const Balance before = balance(simulation->snapshot(), scene);
      double pressed = 0;
      for (int look = 1; look <= 20; ++look) {
        simulation->advance_to(5e-6 * look);
        const Balance now = balance(simulation->snapshot(), scene);
        pressed = std::max(pressed, simulation->snapshot().contact_energy / before.kinetic);
        drift[k] = std::max(drift[k], std::abs(now.kinetic + now.strain - before.kinetic) / before.kinetic);
      }
      CHECK(pressed > 0.01);
    }
    MESSAGE("drift of the energy: " << drift[0] << ", " << drift[1]);
    CHECK(drift[0] < 1e-2);
    CHECK(drift[1] < 0.35 * drift[0]);
  }
}

}  // namespace of_this_file
