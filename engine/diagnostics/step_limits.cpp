#include "engine/diagnostics/step_limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string_view>

#include "engine/kernels/kernel.hpp"
#include "engine/methods/catalogue.hpp"
#include "engine/methods/tl_displacement/describe.hpp"
#include "engine/methods/tl_displacement/methods.hpp"

namespace taut {
namespace {

/// Gradient weights V B W′ on an unbounded lattice with spacing 1.
template <const TlDisplacementFormulation& M, int Dim>
class Lattice {
 public:
  using V = std::array<double, Dim>;

  Lattice(double h, double normalised) : h_(h) {
    double sum_W = 0, moment = 0;
    for_each_neighbor([&](const V& x, double r) {
      sum_W += Kernel<M.kernel>::alpha(Dim) / std::pow(h, Dim) * Kernel<M.kernel>::w(r / h);
      if (r > 0) moment -= slope(r) * x[0] * x[0] / r;
    });
    scale_ = M.gradient == GradientCorrection::corrected ? 1 / moment : 1 / (1 + normalised * (sum_W - 1));
  }

  double nearest() const { return -scale_ * slope(1); }

  double greatest_wave_number() const {
    constexpr int waves = Dim == 2 ? 64 : 32;  // per axis, from 0 to π; the maximum is flat
    constexpr double step = std::numbers::pi / waves;
    double greatest = 0;
    for (int a = 0; a <= waves; ++a)
      for (int b = 0; b <= a; ++b)
        if constexpr (Dim == 2)
          greatest = std::max(greatest, wave_number({step * a, step * b}));
        else
          for (int c = 0; c <= b; ++c)
            greatest = std::max(greatest, wave_number({step * a, step * b, step * c}));
    return greatest;
  }

 private:
  double slope(double r) const {
    return Kernel<M.kernel>::alpha(Dim) / std::pow(h_, Dim + 1) * Kernel<M.kernel>::dw(r / h_);
  }
  template <class F>
  void for_each_neighbor(const F& f) const {
    const int reach = static_cast<int>(Kernel<M.kernel>::support * h_);
    const int high = Dim == 3 ? reach : 0;
    for (int x = -reach; x <= reach; ++x)
      for (int y = -reach; y <= reach; ++y)
        for (int z = -high; z <= high; ++z)
          if (const double r = std::hypot(x, y, z); r < Kernel<M.kernel>::support * h_) {
            const std::array<double, 3> place{double(x), double(y), double(z)};
            V v;
            std::copy_n(place.begin(), Dim, v.begin());
            f(v, r);
          }
  }
  double wave_number(const V& q) const {
    V sum{};
    for_each_neighbor([&](const V& x, double r) {
      if (r == 0) return;
      const double phase = std::inner_product(q.begin(), q.end(), x.begin(), 0.0);
      const double k = scale_ * slope(r) * std::sin(phase) / r;
      for (std::size_t a = 0; a < Dim; ++a) sum[a] += k * x[a];
    });
    return std::sqrt(std::inner_product(sum.begin(), sum.end(), sum.begin(), 0.0));
  }

  double h_;
  double scale_ = 1;
};

template <const TlDisplacementFormulation& M, int Dim>
std::vector<StepLimit> limits_of(const Scene& scene, const Settings& settings) {
  if (M.pair_force != PairForce::none) return {};
  const Material& material = scene.materials.at(static_cast<std::size_t>(scene.bodies.front().material));
  const double nu = material.poisson_ratio, dp = scene.spacing;
  Constants all;
  all.dp = 1;
  const auto c =
      constants_of(tl_displacement::constants(M, Dim), all, constant_values(M, Dim, all.dp, settings));
  const Lattice<M, Dim> lattice(c.h, c.normalised);
  const double stiffness = material.bulk_modulus() + 4.0 / 3 * material.shear_modulus();
  const double c_p = std::sqrt(stiffness / material.density);
  std::vector<StepLimit> limits{{"sharp limit of an unbounded lattice", "von Neumann",
                                 2 * dp / (c_p * lattice.greatest_wave_number())}};
  if (Dim == 2 && M.gradient == GradientCorrection::normalised) {
    const double doubled_G = 2 * material.shear_modulus();
    limits.push_back(
        {"sufficient with four neighbours", "[Zhang2020] Eq. 15b",
         dp / lattice.nearest() * std::sqrt(material.density * (1 - 2 * nu) / ((3 - 4 * nu) * doubled_G))});
  }
  return limits;
}

template <const auto&... M>
std::vector<StepLimit> find_limits(const Scene& scene, const Settings& settings, MethodList<M...>) {
  std::vector<StepLimit> limits;
  const auto of = [&]<const auto & One>() {
    return scene.dim == 3 ? limits_of<One, 3>(scene, settings) : limits_of<One, 2>(scene, settings);
  };
  static_cast<void>(((M.name == settings.method && (limits = of.template operator()<M>(), true)) || ...));
  return limits;
}

}  // namespace

std::vector<StepLimit> step_limits(const Scene& scene, const Settings& settings) {
  return find_limits(scene, settings, tl_displacement::Methods{});
}

}  // namespace taut
