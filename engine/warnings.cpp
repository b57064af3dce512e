#include "engine/warnings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "engine/diagnostics/balance.hpp"
#include "engine/diagnostics/conservation.hpp"
#include "engine/methods/ul_cauchy/formulation.hpp"
#include "engine/neighbors/close_pairs.hpp"

namespace taut {
namespace {

void warn_about_masses(std::vector<std::string>& warnings, const Scene& scene, const Snapshot& start) {
  constexpr double tolerated = 0.02;
  std::vector<double> volume(scene.bodies.size());  // [body] undeformed, m^dim
  for (std::size_t i = 0; i < start.size(); ++i)
    volume[static_cast<std::size_t>(start.body[i])] +=
        start.m[i] / scene.materials[static_cast<std::size_t>(start.material[i])].density;
  for (std::size_t b = 0; b < volume.size(); ++b) {
    const std::vector<Shape>& shapes = scene.bodies[b].shapes;
    if (shapes.size() != 1 || !scene.bodies[b].without.empty() || !shapes[0]->has_exact_measure()) continue;
    const double excess = volume[b] / shapes[0]->measure(scene.dim) - 1;
    if (std::abs(excess) < tolerated) continue;
    warnings.push_back(
        fmt::format("the particles of body '{}' weigh {:.3g} % {} than its shape; "
                    "a smaller spacing fits better",
                    scene.bodies[b].name, 100 * std::abs(excess), excess > 0 ? "more" : "less"));
  }
}

void warn_about_speeds(std::vector<std::string>& warnings, const Scene& scene, const Snapshot& start) {
  const auto dim = static_cast<std::size_t>(start.dim);
  Point common{};  // m/s
  if (scene.walls.empty() && !exchanges_momentum(scene, start)) {
    const double mass = std::accumulate(start.m.begin(), start.m.end(), 0.0);
    for (std::size_t i = 0; i < start.v.size(); ++i) common[i % dim] += start.m[i / dim] * start.v[i] / mass;
  }
  std::vector<double> mach(scene.bodies.size());  // [body] greatest
  for (std::size_t i = 0; i < start.size(); ++i) {
    double v2 = 0;
    for (std::size_t k = 0; k < dim; ++k) v2 += std::pow(start.v[i * dim + k] - common[k], 2);
    const double c = scene.materials[static_cast<std::size_t>(start.material[i])].sound_speed();
    double& greatest = mach[static_cast<std::size_t>(start.body[i])];
    greatest = std::max(greatest, std::sqrt(v2) / c);
  }
  const auto fastest = std::ranges::max_element(mach);
  if (fastest == mach.end() || !(*fastest > 1)) return;
  warnings.push_back(
      fmt::format("body '{}' starts at {:.3g} times its sound speed; "
                  "check the units of its velocity (m/s) and moduli (Pa)",
                  scene.bodies[static_cast<std::size_t>(fastest - mach.begin())].name, *fastest));
}

void warn_about_contacts(std::vector<std::string>& warnings, const Scene& scene, const Snapshot& start) {
  constexpr double of_motion = 1e-3;
  constexpr double of_stiffness = 1e-9;  // ½ε² for a strain ε of 4e-5
  const double kinetic = balance(start, scene).kinetic, stored = start.contact_energy;  // J
  double stiffness = 0;                                                                 // J
  for (std::size_t i = 0; i < start.size(); ++i) {
    const Material& material = scene.materials[static_cast<std::size_t>(start.material[i])];
    stiffness += start.m[i] / material.density * material.youngs_modulus;
  }
  if (!(stored > of_motion * kinetic + of_stiffness * stiffness)) return;
  const std::string share =
      kinetic > 0 ? fmt::format(", {:.3g} % of the kinetic energy", 100 * stored / kinetic) : "";
  warnings.push_back(
      fmt::format("contacts store {:.4g} J at the start{}: bodies or walls overlap and will be pushed apart",
                  stored, share));
}

void warn_about_joined_bodies(std::vector<std::string>& warnings, const Scene& scene, const Snapshot& start,
                              double support) {
  constexpr double separation = 2 - 1e-6;  // spacings; bodies that start farther apart separate
  std::optional<std::pair<int, int>> first;
  double nearest = std::min(support, separation * scene.spacing);
  for_each_meeting_pair(start, nearest, [&](int i, int j) {
    const std::pair bodies(start.body[static_cast<std::size_t>(i)], start.body[static_cast<std::size_t>(j)]);
    const Point a = start.position(static_cast<std::size_t>(i)),
                b = start.position(static_cast<std::size_t>(j));
    const double r = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    if (first && (bodies > *first || (bodies == *first && r >= nearest))) return;
    first = bodies, nearest = r;
  });
  if (!first) return;
  const auto body = [&](int b) { return scene.bodies[static_cast<std::size_t>(b)].name; };
  warnings.push_back(
      fmt::format("bodies '{}' and '{}' start {:.4g} spacings apart, within the kernel support of {:.4g}: "
                  "contact = \"sph\" may join them into one body; "
                  "start them farther apart, or use another contact law, such as \"penalty\"",
                  body(first->first), body(first->second), nearest / scene.spacing, support / scene.spacing));
}

struct LatticeCells {
  std::array<int, 3> sides{1, 1, 1};
  std::vector<char> filled;

  std::size_t at(const std::array<int, 3>& cell) const {
    return (static_cast<std::size_t>(cell[2]) * static_cast<std::size_t>(sides[1]) +
            static_cast<std::size_t>(cell[1])) *
               static_cast<std::size_t>(sides[0]) +
           static_cast<std::size_t>(cell[0]);
  }
};

/// Fills a cell if any cell up to `reach` away along the axis is filled; with `all`, only if all are.
LatticeCells along_axis(const LatticeCells& cells, std::size_t axis, int reach, bool all) {
  LatticeCells result = cells;
  std::array<int, 3> cell{};
  for (cell[2] = 0; cell[2] < cells.sides[2]; ++cell[2])
    for (cell[1] = 0; cell[1] < cells.sides[1]; ++cell[1])
      for (cell[0] = 0; cell[0] < cells.sides[0]; ++cell[0]) {
        int number = 0;
        for (int by = -reach; by <= reach; ++by) {
          std::array<int, 3> beside = cell;
          beside[axis] += by;
          const bool within = beside[axis] >= 0 && beside[axis] < cells.sides[axis];
          number += within && cells.filled[cells.at(beside)];
        }
        result.filled[cells.at(cell)] = all ? number == 2 * reach + 1 : number > 0;
      }
  return result;
}

struct LatticeBody {
  LatticeCells cells;
  std::vector<std::array<int, 3>> places;
};

/// Returns nullopt if a particle is off the lattice or the lattice exceeds `most_cells`.
std::optional<LatticeBody> on_lattice(const Snapshot& start, std::span<const std::size_t> own, double dp) {
  constexpr double off_lattice = 1e-6;  // dp
  constexpr double most_cells = 5e7;
  const auto dim = static_cast<std::size_t>(start.dim);
  LatticeBody body;
  Point low{};
  double room = 1;
  for (std::size_t k = 0; k < dim; ++k) {
    const auto along = [&](std::size_t i) { return start.x0[dim * i + k]; };
    const auto [least, greatest] = std::ranges::minmax(own, {}, along);
    low[k] = along(least);
    const double side = std::round((along(greatest) - low[k]) / dp) + 1;
    if (!((room *= side) <= most_cells)) return std::nullopt;
    body.cells.sides[k] = static_cast<int>(side);
  }
  body.cells.filled.resize(static_cast<std::size_t>(room));
  for (const std::size_t i : own) {
    std::array<int, 3>& place = body.places.emplace_back();
    for (std::size_t k = 0; k < dim; ++k) {
      const double exact = (start.x0[dim * i + k] - low[k]) / dp;
      place[k] = static_cast<int>(std::lround(exact));
      if (std::abs(exact - place[k]) > off_lattice) return std::nullopt;
    }
    body.cells.filled[body.cells.at(place)] = 1;
  }
  return body;
}

/// Thin parts: particles neither in nor beside a block of 3 × 3 (× 3) particles.
void warn_about_thin_parts(std::vector<std::string>& warnings, const Scene& scene, const Snapshot& start) {
  constexpr int around = 2;  // from the middle of a block: 1 inside it, 1 for lattice steps of round faces
  const auto dim = static_cast<std::size_t>(start.dim);
  std::vector<std::vector<std::size_t>> particles(scene.bodies.size());
  for (std::size_t i = 0; i < start.size(); ++i)
    particles[static_cast<std::size_t>(start.body[i])].push_back(i);
  for (std::size_t b = 0; b < particles.size(); ++b) {
    if (particles[b].empty()) continue;
    std::optional<LatticeBody> body = on_lattice(start, particles[b], scene.spacing);
    if (!body) continue;
    for (std::size_t k = 0; k < dim; ++k) body->cells = along_axis(body->cells, k, 1, true);
    for (std::size_t k = 0; k < dim; ++k) body->cells = along_axis(body->cells, k, around, false);
    const auto is_thin = [&](const std::array<int, 3>& place) {
      return !body->cells.filled[body->cells.at(place)];
    };
    const auto first = std::ranges::find_if(body->places, is_thin);
    if (first == body->places.end()) continue;
    const Point at = start.position(particles[b][static_cast<std::size_t>(first - body->places.begin())]);
    const double share = static_cast<double>(std::ranges::count_if(body->places, is_thin)) /
                         static_cast<double>(body->places.size());
    warnings.push_back(fmt::format(
        "{:.3g} % of the particles of body '{}' are in parts one or two particles thick, such as at [{:.4g}, "
        "{:.4g}{}] m; such parts can zigzag and lose energy, so use a smaller spacing",
        100 * share, scene.bodies[b].name, at[0], at[1], dim == 3 ? fmt::format(", {:.4g}", at[2]) : ""));
  }
}

/// Reason why pair forces are not equal and opposite, or "".
std::string reason_for_unbalanced_forces(const MethodInfo& method, const Settings& settings) {
  const auto value = [&](const char* constant, double by_default) {
    const auto found = settings.constants.find(constant);
    return found == settings.constants.end() ? by_default : found->second;
  };
  const auto* cauchy = as<UlCauchyFormulation>(method.formulation);
  if (cauchy && cauchy->tensile_control)  // [Khayyer2024] §3.4
    return "tensile instability control does not conserve momentum: "
           "they are 0.63 to 0.98 of the load in a bent bar, 0.95 of the weight of a block on a wall (METHODS.md)";
  if (value("penalty_rotation", 0) != 0) return "penalty_rotation does not conserve momentum";
  if (value("internal_force", 0) != 0 && value("projection", 1) < 1)
    return "internal_force = \"one-sided\" without projection does not conserve momentum";
  return "";
}

}  // namespace

std::string warning_about_reactions(const Scene& scene, const MethodInfo& method, const Settings& settings) {
  const auto is_force = [](const Probe& probe) { return probe.kind.is_force; };
  const std::string reason = reason_for_unbalanced_forces(method, settings);
  if (reason.empty() || std::ranges::none_of(scene.probes, is_force)) return "";
  return fmt::format("reaction and contact forces of {} do not balance the loads, since {}", method.name,
                     reason);
}

std::vector<std::string> warnings_at_start(const Scene& scene, const MethodInfo& method,
                                           const Simulation& simulation) {
  const Snapshot& start = simulation.snapshot();
  std::vector<std::string> warnings;
  warn_about_masses(warnings, scene, start);
  warn_about_speeds(warnings, scene, start);
  warn_about_thin_parts(warnings, scene, start);
  warn_about_contacts(warnings, scene, start);
  if (scene.bodies.size() > 1 && contact_law(scene, method) == ContactLaw::sph)
    warn_about_joined_bodies(warnings, scene, start, simulation.support());
  return warnings;
}

}  // namespace taut
