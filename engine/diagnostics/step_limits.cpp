#include "engine/diagnostics/step_limits.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "engine/families/catalogue.hpp"
#include "engine/kernels/kernel.hpp"
#include "engine/methods/all_methods.hpp"

namespace taut {
namespace {

/// V B W′ of a method on an unbounded square lattice of spacing 1, as the gradients have it.
template <const Formulation& M>
class Lattice {
 public:
  Lattice(double h, double normalised) : h_(h) {
    double sum_W = 0, moment = 0;
    for_each_neighbor([&](double x, double, double r) {
      sum_W += Kernel<M.kernel>::alpha(2) / (h * h) * Kernel<M.kernel>::w(r / h);
      if (r > 0) moment -= slope(r) * x * x / r;
    });
    scale_ = M.gradient == GradientCorrection::corrected ? 1 / moment : 1 / (1 + normalised * (sum_W - 1));
  }

  /// |W′| at the four nearest
  double nearest() const { return -scale_ * slope(1); }

  /// Greatest |κ(q)|
  double greatest_wave_number() const {
    constexpr int waves = 64;  // along each axis, from 0 to π: the greatest is flat
    double greatest = 0;
    for (int a = 0; a <= waves; ++a)
      for (int b = 0; b <= a; ++b)
        greatest =
            std::max(greatest, wave_number(std::numbers::pi * a / waves, std::numbers::pi * b / waves));
    return greatest;
  }

 private:
  double slope(double r) const {
    return Kernel<M.kernel>::alpha(2) / (h_ * h_ * h_) * Kernel<M.kernel>::dw(r / h_);
  }
  template <class F>
  void for_each_neighbor(const F& f) const {
    const int reach = static_cast<int>(Kernel<M.kernel>::support * h_);
    for (int x = -reach; x <= reach; ++x)
      for (int y = -reach; y <= reach; ++y)
        if (const double r = std::hypot(x, y); r < Kernel<M.kernel>::support * h_) f(x, y, r);
  }
  double wave_number(double q_x, double q_y) const {
    double x_sum = 0, y_sum = 0;
    for_each_neighbor([&](double x, double y, double r) {
      if (r == 0) return;
      const double k = scale_ * slope(r) * std::sin(q_x * x + q_y * y) / r;
      x_sum += k * x;
      y_sum += k * y;
    });
    return std::hypot(x_sum, y_sum);
  }

  double h_;  // over the spacing
  double scale_ = 1;
};

template <const Formulation& M>
std::vector<StepLimit> limits_of(const Scene& scene, const Settings& settings) {
  if constexpr (M.family != Family::tl_displacement) {
    return {};
  } else {
    const Material& material = scene.materials.at(static_cast<std::size_t>(scene.bodies.front().material));
    const double nu = material.poisson_ratio, dp = scene.spacing;
    Constants c;
    c.dp = 1;
    set_constants(c, M, 2, settings);
    const Lattice<M> lattice(c.h, c.normalised);
    const double stiffness = material.bulk_modulus() + 4.0 / 3 * material.shear_modulus();
    const double c_p = std::sqrt(stiffness / material.density);
    std::vector<StepLimit> limits{{"sharp limit of an unbounded lattice", "von Neumann",
                                   2 * dp / (c_p * lattice.greatest_wave_number())}};
    if (M.gradient == GradientCorrection::normalised) {
      const double doubled_G = 2 * material.shear_modulus();
      limits.push_back(
          {"sufficient with four neighbours", "[Zhang2020] Eq. 15b",
           dp / lattice.nearest() * std::sqrt(material.density * (1 - 2 * nu) / ((3 - 4 * nu) * doubled_G))});
    }
    return limits;
  }
}

template <const Formulation&... M>
std::vector<StepLimit> find_limits(const Scene& scene, const Settings& settings, MethodList<M...>) {
  std::vector<StepLimit> limits;
  static_cast<void>(((M.name == settings.method && (limits = limits_of<M>(scene, settings), true)) || ...));
  return limits;
}

}  // namespace

std::vector<StepLimit> step_limits(const Scene& scene, const Settings& settings) {
  return find_limits(scene, settings, Methods{});
}

}  // namespace taut
