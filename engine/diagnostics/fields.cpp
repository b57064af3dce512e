#include "engine/diagnostics/fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>

#include "engine/diagnostics/deviator.hpp"

namespace taut {
namespace {

double von_mises(const Snapshot& now, std::size_t i) { return std::sqrt(1.5 * deviator_squared(now, i)); }

double pressure(const Snapshot& now, std::size_t i) { return now.p[i]; }

/// Cauchy stress σ = −p I + s, positive in tension.
double stress_xx(const Snapshot& now, std::size_t i) { return -now.p[i] + deviator(now, i)[0]; }
double stress_xy(const Snapshot& now, std::size_t i) { return deviator(now, i)[1]; }
double stress_yy(const Snapshot& now, std::size_t i) {
  return -now.p[i] + deviator(now, i)[now.dim == 3 ? 3 : 2];
}

double stress_xz(const Snapshot& now, std::size_t i) { return now.deviator(i).xz; }
double stress_yz(const Snapshot& now, std::size_t i) { return now.deviator(i).yz; }
double stress_zz(const Snapshot& now, std::size_t i) { return now.stress(i).zz; }

/// The `Rank`-th greatest eigenvalue of the stress; in 2D σ_zz is one of the three.
template <int Rank>
double principal(const Snapshot& now, std::size_t i) {
  const StressTensor t = now.stress(i);
  Eigen::Matrix3d sigma;
  sigma << t.xx, t.xy, t.xz, t.xy, t.yy, t.yz, t.xz, t.yz, t.zz;
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sigma, Eigen::EigenvaluesOnly)
      .eigenvalues()[3 - Rank];
}

template <std::size_t Axis>
double velocity(const Snapshot& now, std::size_t i) {
  return now.velocity(i)[Axis];
}

template <std::size_t Axis>
double displacement(const Snapshot& now, std::size_t i) {
  return now.position(i)[Axis] - now.initial(i)[Axis];
}

double length(const Point& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

double speed(const Snapshot& now, std::size_t i) { return length(now.velocity(i)); }

double distance_moved(const Snapshot& now, std::size_t i) {
  const Point x = now.position(i), X = now.initial(i);
  return length({x[0] - X[0], x[1] - X[1], x[2] - X[2]});
}

double density(const Snapshot& now, std::size_t i) { return now.rho[i]; }

constexpr std::array all = {
    Field{"von_mises", "von Mises stress", "Pa", "√(3/2 s:s) of the deviatoric stress s", false, von_mises},
    Field{"pressure", "pressure", "Pa", "positive in compression", true, pressure},
    Field{"stress_xx", "stress xx", "Pa", "Cauchy stress, positive in tension", true, stress_xx},
    Field{"stress_xy", "stress xy", "Pa", "Cauchy stress, shear", true, stress_xy},
    Field{"stress_yy", "stress yy", "Pa", "Cauchy stress, positive in tension", true, stress_yy},
    Field{"speed", "speed", "m/s", "magnitude of the velocity", false, speed},
    Field{"density", "density", "kg/m³", "mass per present volume", false, density},
    Field{"displacement", "displacement", "m", "distance from the initial position", false, distance_moved},
    Field{"displacement_x", "displacement x", "m", "from the initial position", true, displacement<0>},
    Field{"displacement_y", "displacement y", "m", "from the initial position", true, displacement<1>},
    Field{"velocity_x", "velocity x", "m/s", "component of the velocity", true, velocity<0>},
    Field{"velocity_y", "velocity y", "m/s", "component of the velocity", true, velocity<1>},
    Field{"principal_1", "greatest principal stress", "Pa", "Cauchy stress, positive in tension", true,
          principal<1>},
    Field{"principal_2", "middle principal stress", "Pa", "Cauchy stress, positive in tension", true,
          principal<2>},
    Field{"principal_3", "least principal stress", "Pa", "Cauchy stress, positive in tension", true,
          principal<3>},
    Field{"stress_xz", "stress xz", "Pa", "Cauchy stress, shear; in 3D", true, stress_xz, 3},
    Field{"stress_yz", "stress yz", "Pa", "Cauchy stress, shear; in 3D", true, stress_yz, 3},
    Field{"stress_zz", "stress zz", "Pa", "Cauchy stress, positive in tension; in 3D", true, stress_zz, 3},
    Field{"displacement_z", "displacement z", "m", "from the initial position; in 3D", true, displacement<2>,
          3},
    Field{"velocity_z", "velocity z", "m/s", "component of the velocity; in 3D", true, velocity<2>, 3},
};

}  // namespace

std::span<const Field> fields(int dim) {
  static_assert(std::ranges::is_sorted(all, {}, &Field::least_dim));
  return {all.begin(), std::ranges::upper_bound(all, dim, {}, &Field::least_dim)};
}

const Field* find_field(std::string_view key, int dim) {
  const auto known = fields(dim);
  const auto found = std::ranges::find(known, key, &Field::key);
  return found == known.end() ? nullptr : &*found;
}

std::vector<double> evaluate(const Field& field, const Snapshot& snapshot) {
  std::vector<double> values(snapshot.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = field.value(snapshot, i);
  return values;
}

}  // namespace taut
