#include "engine/diagnostics/fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Dense>

#include "engine/diagnostics/alternating_part.hpp"
#include "engine/diagnostics/deviator.hpp"

namespace taut {
namespace {

double von_mises(const Snapshot& now, std::size_t i) { return std::sqrt(1.5 * deviator_squared(now, i)); }

double pressure(const Snapshot& now, std::size_t i) { return now.p[i]; }

/// Cauchy stress σ = −p I + s, positive in tension, Pa.
double stress_xx(const Snapshot& now, std::size_t i) { return -now.p[i] + deviator(now, i)[0]; }
double stress_xy(const Snapshot& now, std::size_t i) { return deviator(now, i)[1]; }
double stress_yy(const Snapshot& now, std::size_t i) {
  return -now.p[i] + deviator(now, i)[now.dim == 3 ? 3 : 2];
}

double stress_xz(const Snapshot& now, std::size_t i) { return now.deviator(i).xz; }
double stress_yz(const Snapshot& now, std::size_t i) { return now.deviator(i).yz; }
double stress_zz(const Snapshot& now, std::size_t i) { return now.stress(i).zz; }

/// Principal stress, with σ_zz in 2D.
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

double body(const Snapshot& now, std::size_t i) { return now.body[i]; }
double material(const Snapshot& now, std::size_t i) { return now.material[i]; }

Eigen::Matrix3d matrix(const LinearMap& map) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(map.data());
}

double volume_ratio(const LinearMap& F) { return matrix(F).determinant(); }

/// Hencky strain ½ ln(F Fᵀ) in spatial axes.
Eigen::Matrix3d logarithmic_strain(const LinearMap& map) {
  const Eigen::Matrix3d F = matrix(map);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> stretch(F * F.transpose());
  const Eigen::Matrix3d& axes = stretch.eigenvectors();
  return axes * (0.5 * stretch.eigenvalues().array().log()).matrix().asDiagonal() * axes.transpose();
}

template <int A, int B>
double strain(const LinearMap& F) {
  return logarithmic_strain(F)(A, B);
}

double equivalent_strain(const LinearMap& F) {
  const Eigen::Matrix3d e = logarithmic_strain(F);
  return std::sqrt(2.0 / 3.0) * (e - e.trace() / 3 * Eigen::Matrix3d::Identity()).norm();
}

/// |r(x)|/dp of AlternatingPart; 0 for particles without weights.
std::vector<double> zigzag(const Snapshot& now) {
  std::vector<double> values(now.size());
  if (values.empty()) return values;
  std::vector<double> diameter = now.diameter;
  const auto middle = diameter.begin() + static_cast<std::ptrdiff_t>(diameter.size() / 2);
  std::ranges::nth_element(diameter, middle);
  const double spacing = *middle;  // some particles differ at edges and in aligned layers
  const AlternatingPart part = alternating_part(now, spacing);
  const std::vector<double> squared = alternating_sums(part, now, spacing).x;
  for (std::size_t row = 0; row < squared.size(); ++row)
    values[static_cast<std::size_t>(part.j[static_cast<std::size_t>(part.begin[row])])] =
        std::sqrt(squared[row]) / spacing;
  return values;
}

constexpr Field of_map(std::string_view key, std::string_view name, std::string_view help, bool is_signed,
                       double (*value)(const LinearMap&), int least_dim = 2, double middle = 0) {
  return {key, name, "", help, is_signed, nullptr, least_dim, value, middle, Counted::nothing};
}

constexpr Field counted(std::string_view key, std::string_view help, Counted what,
                        double (*value)(const Snapshot&, std::size_t)) {
  return {key, key, "", help, false, value, 2, nullptr, 0, what};
}

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
    of_map("J", "volume ratio J",
           "det F of the deformation gradient F, fitted to the motion of the neighbours", true, volume_ratio,
           2, 1),
    of_map("strain_xx", "strain xx", "logarithmic strain ½ ln F Fᵀ in spatial axes, positive in tension",
           true, strain<0, 0>),
    of_map("strain_xy", "strain xy", "logarithmic strain, half the shear angle if it is small", true,
           strain<0, 1>),
    of_map("strain_yy", "strain yy", "logarithmic strain, positive in tension", true, strain<1, 1>),
    of_map("equivalent_strain", "equivalent strain", "√(2/3 e:e) of the deviatoric logarithmic strain e",
           false, equivalent_strain),
    Field{
        .key = "zigzag",
        .name = "zigzag over spacing",
        .unit = "",
        .help =
            "displacement that alternates between neighbours, over the spacing, at most 1; 0 at corners and if held",
        .of_all = zigzag},
    counted("body", "number of the body in the scene, from 0; one colour per body", Counted::bodies, body),
    counted("material", "number of the material in the scene, from 0; one colour per material",
            Counted::materials, material),
    Field{"stress_xz", "stress xz", "Pa", "Cauchy stress, shear; in 3D", true, stress_xz, 3},
    Field{"stress_yz", "stress yz", "Pa", "Cauchy stress, shear; in 3D", true, stress_yz, 3},
    Field{"stress_zz", "stress zz", "Pa", "Cauchy stress, positive in tension; in 3D", true, stress_zz, 3},
    Field{"displacement_z", "displacement z", "m", "from the initial position; in 3D", true, displacement<2>,
          3},
    Field{"velocity_z", "velocity z", "m/s", "component of the velocity; in 3D", true, velocity<2>, 3},
    of_map("strain_xz", "strain xz", "logarithmic strain, shear; in 3D", true, strain<0, 2>, 3),
    of_map("strain_yz", "strain yz", "logarithmic strain, shear; in 3D", true, strain<1, 2>, 3),
    of_map("strain_zz", "strain zz", "logarithmic strain, positive in tension; in 3D", true, strain<2, 2>, 3),
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
  const Field* one = &field;
  return std::move(evaluate(std::span(&one, 1), snapshot).front());
}

std::vector<std::vector<double>> evaluate(std::span<const Field* const> fields, const Snapshot& snapshot) {
  std::vector<LinearMap> maps;
  if (std::ranges::any_of(fields, [](const Field* field) { return field->of_map; }))
    maps = affine_maps(snapshot);
  std::vector<std::vector<double>> values;
  for (const Field* field : fields) {
    if (field->of_all) {
      values.push_back(field->of_all(snapshot));
      continue;
    }
    std::vector<double>& of_field = values.emplace_back(snapshot.size());
    for (std::size_t i = 0; i < of_field.size(); ++i)
      of_field[i] = field->of_map ? field->of_map(maps[i]) : field->of_state(snapshot, i);
  }
  return values;
}

}  // namespace taut
