#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include <doctest/doctest.h>

#include "engine/kernels/kernel.hpp"
#include "tests/support/relative.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

using Kernels = std::tuple<Kernel<KernelName::wendland_c2>, Kernel<KernelName::cubic_spline>,
                           Kernel<KernelName::sinc>, Kernel<KernelName::gauss>>;

template <class F>
void for_each_kernel(const F& f) {
  std::apply(
      [&](const auto&... kernel) {
        const auto one = [&]<class K>(const K&) {
          CAPTURE(std::string(K::name));
          f.template operator()<K>();
        };
        (one(kernel), ...);
      },
      Kernels{});
}

template <class F>
double integral(double from, double to, const F& f) {
  const int n = 2000;
  const double step = (to - from) / n;
  double sum = f(from) + f(to);
  for (int k = 1; k < n; ++k) sum += (k % 2 == 1 ? 4 : 2) * f(from + k * step);
  return sum * step / 3;
}

double surface_of_ball(int dim, double r) {
  return dim == 2 ? 2 * std::numbers::pi * r : 4 * std::numbers::pi * r * r;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("kernel: the integral is 1 in 2D and 3D for any smoothing length") {
    for_each_kernel([]<class K>() {
      for (const int dim : {2, 3}) {
        for (const double h : {0.4, 1.3}) {
          CAPTURE(dim);
          const auto shell = [=](double r) {
            return surface_of_ball(dim, r) * K::alpha(dim) / std::pow(h, dim) * K::w(r / h);
          };
          const double end = K::support * h * (1 - 1e-12);  // a kernel may be truncated there
          CHECK(integral(0, end, shell) == Approx(1).epsilon(1e-10));
        }
      }
    });
  }

  TEST_CASE("kernel: w' is the derivative of w") {
    for_each_kernel([]<class K>() {
      const double step = 1e-5;
      for (double q = 0.01; q < K::support + 0.5; q += 0.07) {
        CAPTURE(q);
        const double difference = (K::w(q + step) - K::w(q - step)) / (2 * step);
        CHECK(K::dw(q) == Approx(difference).epsilon(1e-7).scale(1));
        CHECK(q * K::dw_per_q(q) == Approx(K::dw(q)).epsilon(1e-14));
      }
    });
  }

  TEST_CASE("kernel: w'' of Wendland C2 is the derivative of w'") {
    using K = Kernel<KernelName::wendland_c2>;
    const double step = 1e-5;
    for (double q = 0.01; q < K::support + 0.5; q += 0.07) {
      CAPTURE(q);
      const double difference = (K::dw(q + step) - K::dw(q - step)) / (2 * step);
      CHECK(K::ddw(q) == Approx(difference).epsilon(1e-7).scale(1));
    }
  }

  TEST_CASE("kernel: w falls from q = 0 to the support and is 0 from there on") {
    for_each_kernel([]<class K>() {
      CHECK(K::w(0.0) > 0);
      CHECK(K::dw(0.0) == 0);
      for (double q = 0.01; q < K::support - 0.005; q += 0.01) {
        CAPTURE(q);
        CHECK(K::dw(q) < 0);
        CHECK(K::w(q) > 0);
      }
      for (const double q : {K::support, K::support + 1e-9, 2 * K::support, 1e6}) {
        CAPTURE(q);
        CHECK(K::w(q) == 0);
        CHECK(K::dw(q) == 0);
      }
    });
  }

  TEST_CASE("kernel: four packed values equal single ones to the last bit") {
    for_each_kernel([]<class K>() {
      const Pack q = {0.1, 0.77, 1.9, 2.4};
      const Pack w = K::w(q), dw = K::dw(q);
      for (int lane = 0; lane < lanes; ++lane) {
        CHECK(w[lane] == K::w(q[lane]));
        CHECK(dw[lane] == K::dw(q[lane]));
      }
    });
  }
}

}  // namespace of_this_file
