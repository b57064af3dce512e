#include "tests/references/cases.hpp"

#include <iostream>

#include "tests/references/solid.hpp"

namespace references {
namespace {

/// `value` is called once per row, in order, since `twist` keeps its last value.
template <int d>
struct Column {
  std::string name;
  std::function<double(const Solid<d>&)> value;
};

template <int d>
using Columns = std::vector<Column<d>>;

template <int d>
std::function<double(const Solid<d>&)> displacement(const Solid<d>& solid, const Vector<d>& x,
                                                    int component) {
  return [node = solid.node_at(x), component](const Solid<d>& s) { return s.displacement(node)[component]; };
}

template <int d>
std::function<double(const Solid<d>&)> position(const Solid<d>& solid, const Vector<d>& x, int component) {
  return [node = solid.node_at(x), component](const Solid<d>& s) { return s.position(node)[component]; };
}

/// Angle about y of the point `x`, rad, right-handed, 0 at the start and without jumps.
std::function<double(const Solid<3>&)> twist(const Solid<3>& solid, const Vector<3>& x) {
  return [node = solid.node_at(x), start = std::atan2(x[0], x[2]), last = 0.](const Solid<3>& s) mutable {
    const Vector<3> now = s.position(node);
    last += std::remainder(std::atan2(now[0], now[2]) - start - last, 2 * M_PI);
    return last;
  };
}

/// Writes a row every `interval`, in s.
template <int d>
void run(Solid<d>& solid, const Settings& settings, double interval, double until, const Columns<d>& columns,
         std::ostream& table) {
  table.precision(9);
  table << "t";
  for (const auto& column : columns) table << "," << column.name;
  const double before = solid.energy();
  const long rows = std::lround(std::min(until, settings.until) / interval);
  for (long row = 0; row <= rows; ++row) {
    solid.advance(static_cast<double>(row) * interval, settings.courant);
    table << "\n" << solid.time();
    for (const auto& column : columns) table << "," << column.value(solid);
  }
  table << "\n";
  std::cerr << "energy " << before << " J at the start, " << solid.energy() / before - 1
            << " of it gained by the end\n";
}

/// [Zhang2024] §6.1, first mode. Elements are halved `at_clamp` times towards the clamp and `at_faces` times towards the
/// faces, because stress is singular at the edges of the clamp.
Case oscillating_plate(Law law, double vf, int along, int at_clamp, int at_faces) {
  return [=](const Settings& settings, std::ostream& table) {
    constexpr double length = 0.2, height = 0.02, kl = 1.875;
    const Material material = Material::of(law, 1000, 2e6, 0.3975);
    const auto shape = [](double x) {
      return (std::sin(kl) + std::sinh(kl)) * (std::cos(kl * x / length) - std::cosh(kl * x / length)) -
             (std::cos(kl) + std::cosh(kl)) * (std::sin(kl * x / length) - std::sinh(kl * x / length));
    };
    Solid<2> solid(
        grid<2>({axis(0, length, along * settings.refine, at_clamp),
                 axis(-height / 2, height / 2, 2 * settings.refine, at_faces, at_faces)}),
        material,
        [&](const Vector<2>& x) -> Vector<2> {
          return {0, vf * material.c0() * shape(x[0]) / shape(length)};
        },
        [](const Vector<2>& x) -> Vector<2> {
          return {x[0] == 0. ? 1. : 0., x[0] == 0. ? 1. : 0.};
        });
    run<2>(solid, settings, 1e-3, 1, {{"tip_uy", displacement<2>(solid, {length, 0}, 1)}}, table);
  };
}

/// Free square [Khayyer2024] §4.2.
Case rotating_plate(Law law) {
  return [=](const Settings& settings, std::ostream& table) {
    const auto side = axis(-0.5, 0.5, 32 * settings.refine);
    Solid<2> solid(
        grid<2>({side, side}), Material::of(law, 1100, 17e6, 0.45),
        [](const Vector<2>& x) -> Vector<2> {
          return {-105 * x[1], 105 * x[0]};
        },
        [](const Vector<2>&) -> Vector<2> { return {}; });
    run<2>(solid, settings, 5e-4, 0.2,
           {{"corner_x", position<2>(solid, {0.5, 0.5}, 0)}, {"corner_y", position<2>(solid, {0.5, 0.5}, 1)}},
           table);
  };
}

/// Upper half of the left ring of [Zhang2024] §6.3; the plane x = 0 stands for the right ring.
Case rings(Law law) {
  return [=](const Settings& settings, std::ostream& table) {
    constexpr double inner = 0.03, outer = 0.04, centre = -0.045;
    const Material material = Material::of(law, 1200, 1e7, 0.4);
    Solid<2> solid(
        grid<2>({axis(0, 1, 48 * settings.refine), axis(inner, outer, 8 * settings.refine)},
                [](const Vector<2>& place) -> Vector<2> {
                  const double angle = M_PI * (1 - place[0]);
                  return {centre + place[1] * std::cos(angle),
                          place[0] == 0. || place[0] == 1. ? 0 : place[1] * std::sin(angle)};
                }),
        material,
        [&](const Vector<2>&) -> Vector<2> {
          return {0.06 * material.c0(), 0};
        },
        [](const Vector<2>& x) -> Vector<2> {
          return {0, x[1] == 0. ? 1. : 0.};
        });
    std::vector<int> face;
    for (std::size_t node = 0; node < solid.nodes().size(); ++node)
      if (std::hypot(solid.nodes()[node][0] - centre, solid.nodes()[node][1]) > outer - 1e-9)
        face.push_back(static_cast<int>(node));
    solid.add_contact(face);
    const int front = solid.node_at({centre + outer, 0}), back = solid.node_at({centre - outer, 0});
    run<2>(solid, settings, 2e-5, 0.01,
           {{"diameter", [=](const Solid<2>& s) { return s.position(front)[0] - s.position(back)[0]; }},
            {"speed", [](const Solid<2>& s) { return s.mean_velocity()[0]; }}},
           table);
  };
}

Vector<3> foot(const Vector<3>& x) {
  const double held = x[1] == 0. ? 1 : 0;
  return {held, held, held};
}

/// [Lee2016] §8.9.
void twisting_column(const Settings& settings, std::ostream& table) {
  const auto across = axis(-0.5, 0.5, 6 * settings.refine);
  Solid<3> solid(
      grid<3>({across, axis(0, 6, 36 * settings.refine), across}),
      Material::of(Law::neo_hookean, 1100, 17e6, 0.45),
      [](const Vector<3>& x) -> Vector<3> {
        const double omega = 105 * std::sin(M_PI * x[1] / 12);
        return {omega * x[2], 0, -omega * x[0]};
      },
      foot);
  run<3>(solid, settings, 1e-3, 0.5,
         {{"twist", twist(solid, {0.5, 6, 0.5})},
          {"mid_twist", twist(solid, {0.5, 3, 0.5})},
          {"top_uy", displacement<3>(solid, {0, 6, 0}, 1)}},
         table);
}

/// Upper half of the free cube [Lee2016] §8.3.
void spinning_cube(const Settings& settings, std::ostream& table) {
  const auto across = axis(-0.5, 0.5, 12 * settings.refine);
  Solid<3> solid(
      grid<3>({across, across, axis(0, 0.5, 6 * settings.refine)}),
      Material::of(Law::neo_hookean, 1100, 17e6, 0.3),
      [](const Vector<3>& x) -> Vector<3> {
        return {-105 * x[1], 105 * x[0], 0};
      },
      [](const Vector<3>& x) -> Vector<3> {
        return {0, 0, x[2] == 0. ? 1. : 0.};
      });
  run<3>(solid, settings, 5e-4, 0.3,
         {{"corner_x", position<3>(solid, {0.5, 0.5, 0.5}, 0)},
          {"corner_y", position<3>(solid, {0.5, 0.5, 0.5}, 1)},
          {"corner_z", position<3>(solid, {0.5, 0.5, 0.5}, 2)},
          {"top_z", position<3>(solid, {0, 0, 0.5}, 2)}},
         table);
}

/// Quarter of the clamped cube [Lee2016] §8.4.
void tensile_cube(const Settings& settings, std::ostream& table) {
  const auto across = axis(0.5, 1, 4 * settings.refine);
  Solid<3> solid(
      grid<3>({across, axis(0, 1, 8 * settings.refine), across}),
      Material::of(Law::neo_hookean, 7000, 21e9, 0.3),
      [](const Vector<3>& x) -> Vector<3> {
        return {0, 800 * x[1], 0};
      },
      [](const Vector<3>& x) -> Vector<3> {
        const double held = x[1] == 0. ? 1 : 0;
        return {x[0] == 0.5 ? 1 : held, held, x[2] == 0.5 ? 1 : held};
      });
  run<3>(solid, settings, 5e-6, 3e-3,
         {{"top_uy", displacement<3>(solid, {0.5, 1, 0.5}, 1)},
          {"waist_ux", displacement<3>(solid, {1, 0.5, 0.5}, 0)}},
         table);
}

/// [Zhang2024] §6.2 in the mode (p, q); the middle line of the edges is held along z.
Case oscillating_plate_3d(int p, int q, double until) {
  return [=](const Settings& settings, std::ostream& table) {
    constexpr double side = 0.4, thickness = 0.01;
    const auto across = axis(0, side, 12 * settings.refine, 1, 1);
    Solid<3> solid(
        grid<3>({across, across, axis(-thickness / 2, thickness / 2, settings.refine)}),
        Material::of(Law::neo_hookean, 1000, 1e8, 0.3),
        [=](const Vector<3>& x) -> Vector<3> {
          return {0, 0, std::sin(p * M_PI * x[0] / side) * std::sin(q * M_PI * x[1] / side)};
        },
        [](const Vector<3>& x) -> Vector<3> {
          const bool edge = std::min(x[0], x[1]) == 0. || std::max(x[0], x[1]) == side;
          return {0, 0, edge && std::abs(x[2]) < 1e-9 ? 1. : 0.};
        });
    const Vector<3> antinode = {side / 2 / p, side / 2 / q, 0};
    run<3>(solid, settings, 2e-4, until, {{"antinode_uz", displacement<3>(solid, antinode, 2)}}, table);
  };
}

/// Quarter of the block [Lee2016] §8.5. The face z = 5 mm slides in its plane unless `free_face`.
Case coining(int per_centimetre, bool free_face) {
  return [=](const Settings& settings, std::ostream& table) {
    constexpr double depth = 0.005;
    const int count = per_centimetre * settings.refine;
    const auto punch = [](const Vector<3>& x) { return x[1] == 0.01 && x[0] < 0.01 + 1e-9; };
    Solid<3> solid(
        grid<3>({axis(0, 0.03, 3 * count), axis(0, 0.01, count), axis(0, depth, (count + 1) / 2)}),
        Material::of(Law::neo_hookean, 1000, 1e6, 0.495),
        [=](const Vector<3>& x) -> Vector<3> {
          return {0, punch(x) ? -10. : 0., 0};
        },
        [=](const Vector<3>& x) -> Vector<3> {
          const double driven = punch(x) ? 1 : 0;
          return {x[0] == 0. ? 1 : driven, x[1] == 0. ? 1 : driven,
                  x[2] == 0. || (x[2] == depth && !free_face) ? 1 : driven};
        });
    run<3>(solid, settings, 2e-6, 5.4e-4,
           {{"side_ux", displacement<3>(solid, {0.03, 0, 0}, 0)},
            {"shoulder_ux", displacement<3>(solid, {0.02, 0.01, 0}, 0)},
            {"shoulder_uy", displacement<3>(solid, {0.02, 0.01, 0}, 1)}},
           table);
  };
}

}  // namespace

const std::map<std::string, Case>& cases() {
  static const std::map<std::string, Case> all = {
      {"oscillating_plate_neo_hookean_vf0.001", oscillating_plate(Law::neo_hookean, 0.001, 20, 1, 1)},
      {"oscillating_plate_neo_hookean_vf0.01", oscillating_plate(Law::neo_hookean, 0.01, 10, 4, 3)},
      {"oscillating_plate_neo_hookean_vf0.05", oscillating_plate(Law::neo_hookean, 0.05, 10, 4, 3)},
      {"oscillating_plate_2d_deviator_vf0.01", oscillating_plate(Law::deviator_2d, 0.01, 20, 1, 1)},
      {"oscillating_plate_2d_deviator_vf0.05", oscillating_plate(Law::deviator_2d, 0.05, 20, 1, 1)},
      {"rotating_plate_neo_hookean", rotating_plate(Law::neo_hookean)},
      {"rotating_plate_2d_deviator", rotating_plate(Law::deviator_2d)},
      {"rings_neo_hookean", rings(Law::neo_hookean)},
      {"rings_2d_deviator", rings(Law::deviator_2d)},
      {"twisting_column", twisting_column},
      {"spinning_cube", spinning_cube},
      {"tensile_cube", tensile_cube},
      {"oscillating_plate_3d_11", oscillating_plate_3d(1, 1, 0.06)},
      {"oscillating_plate_3d_21", oscillating_plate_3d(2, 1, 0.06)},
      {"oscillating_plate_3d_22", oscillating_plate_3d(2, 2, 0.03)},
      {"coining", coining(2, false)},
      {"coining_free_z", coining(6, true)},
  };
  return all;
}

}  // namespace references
