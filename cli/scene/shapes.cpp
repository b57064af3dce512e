#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "cli/scene/shape_readers.hpp"
#include "cli/text/format.hpp"
#include "engine/scene/shapes/box.hpp"
#include "engine/scene/shapes/combined.hpp"
#include "engine/scene/shapes/round_shapes.hpp"
#include "engine/scene/shapes/turned.hpp"

namespace taut::cli {
namespace {

Shape read_box(TomlCursor& shape, const ShapeSetting& setting) {
  return read_low_and_high(shape, setting.dim);
}

/// Hexagonal and relaxed bodies allow only "lattice".
RoundLayout read_layout(TomlCursor& shape, std::vector<RoundLayout> allowed, RoundLayout otherwise,
                        Layers layers) {
  if (layers == Layers::of_lattice) allowed = {RoundLayout::lattice}, otherwise = RoundLayout::lattice;
  std::vector<std::string> names;
  for (const RoundLayout layout : allowed) names.emplace_back(name(layout));
  if (!shape.find("layout")) shape.table().set("layout", TomlValue(std::string(name(otherwise))));
  const std::string chosen = shape.choice("layout", names);
  return allowed[static_cast<std::size_t>(std::ranges::find(names, chosen) - names.begin())];
}

RoundLayout read_layout_of_hollow(TomlCursor& shape, const std::vector<RoundLayout>& allowed,
                                  RoundLayout otherwise, bool can_be_aligned, Layers layers) {
  const RoundLayout layout = read_layout(shape, allowed, otherwise, layers);
  const std::string needed =
      allowed.size() == 3 ? "inner >= outer/3; for a smaller hole, use \"spaced\""
                          : "a hole of at least a third of the radius; for a smaller hole, use \"lattice\"";
  if (layout == RoundLayout::aligned && !can_be_aligned)
    shape.fail(shape.need("layout"), "layout", "layout = \"aligned\" needs " + needed);
  return layout;
}

Shape read_ring(TomlCursor& shape, const ShapeSetting& setting) {
  const int dim = setting.dim;
  const Layers layers = setting.layers;
  Ring ring{shape.point("centre", dim), shape.number("inner"), shape.number("outer"), RoundLayout::lattice};
  if (!(ring.inner < ring.outer))
    shape.fail(shape.need("inner"), "inner",
               fmt::format("inner = {} must be less than outer = {}", exact(ring.inner), exact(ring.outer)));
  if (layers == Layers::none) return ring;
  std::vector<RoundLayout> allowed = {RoundLayout::aligned, RoundLayout::spaced, RoundLayout::lattice};
  if (dim == 3) allowed.erase(allowed.begin() + 1);
  ring.layout = read_layout_of_hollow(shape, allowed,
                                      ring.default_layout(dim, layers == Layers::for_initial_neighbours),
                                      can_be_aligned(ring.inner, ring.outer), layers);
  return ring;
}

Shape read_disc(TomlCursor& shape, const ShapeSetting& setting) {
  Disc disc{shape.point("centre", setting.dim), shape.number("radius")};
  if (setting.dim == 2 && setting.layers != Layers::none)
    disc.layout =
        read_layout(shape, {RoundLayout::spaced, RoundLayout::lattice},
                    Disc::default_layout(setting.layers == Layers::for_initial_neighbours), setting.layers);
  return disc;
}

Shape read_cylinder(TomlCursor& shape, const ShapeSetting& setting) {
  Cylinder cylinder{shape.point("from", setting.dim), shape.point("to", setting.dim), shape.number("radius")};
  if (!(cylinder.length() > 0))
    shape.fail(shape.need("to"), "to",
               "from and to are the same point; they must be the centres of the two ends");
  if (!shape.find("inner")) {
    if (shape.find("layout"))
      shape.fail(shape.need("layout"), "layout",
                 "layout needs a hollow cylinder, one with inner; "
                 "remove layout, because a solid cylinder is cut from a cubic lattice");
    return cylinder;
  }
  cylinder.inner = shape.number("inner");
  if (!(cylinder.inner < cylinder.radius))
    shape.fail(shape.need("inner"), "inner",
               fmt::format("inner = {} must be less than radius = {}", exact(cylinder.inner),
                           exact(cylinder.radius)));
  if (setting.layers != Layers::none)
    cylinder.layout =
        read_layout_of_hollow(shape, {RoundLayout::aligned, RoundLayout::lattice},
                              cylinder.default_layout(setting.layers == Layers::for_initial_neighbours),
                              can_be_aligned(cylinder.inner, cylinder.radius), setting.layers);
  return cylinder;
}

std::vector<Shape> read_list(TomlCursor& owner, std::string_view key, const std::string& what,
                             const ShapeSetting& setting);

Shape read_combined(TomlCursor& shape, ShapeSetting setting, Combination how) {
  constexpr int most_levels = 8;
  if (++setting.level > most_levels)
    shape.fail(shape.need("shapes"), "shapes",
               fmt::format("unions, intersections and differences are nested more than {} levels deep; "
                           "use fewer levels, such as one union of all its shapes",
                           most_levels));
  setting.alone = false;
  setting.layers = Layers::none;
  Combined combined{how, read_list(shape, "shapes", "the shapes of " + shape.what(), setting)};
  if (combined.shapes.size() < 2)
    shape.fail(shape.need("shapes"), "shapes", "shapes must be an array of at least two shapes");
  return combined;
}

Shape read_union(TomlCursor& shape, const ShapeSetting& setting) {
  return read_combined(shape, setting, Combination::together);
}
Shape read_intersection(TomlCursor& shape, const ShapeSetting& setting) {
  return read_combined(shape, setting, Combination::common);
}
Shape read_difference(TomlCursor& shape, const ShapeSetting& setting) {
  return read_combined(shape, setting, Combination::difference);
}

constexpr KeyInfo corner_keys[] = {
    {"low", types::vector("[x, y]", "m"), "", "corner with the smallest coordinates"},
    {"high", types::vector("[x, y]", "m"), "", "corner with the largest coordinates"},
};
constexpr KeyInfo ball_keys[] = {
    {"centre", types::vector("[x, y]", "m"), "", "centre"},
    {"radius", types::number("m", above(0)), "", "radius"},
};
constexpr KeyInfo disc_keys[] = {
    ball_keys[0],
    ball_keys[1],
    {"layout", types::word("spaced", "lattice"), "depends on the method",
     "spaced: a central particle and layers of 6, 12, 18 … particles; lattice: cut from a lattice"},
};
constexpr KeyInfo shell_keys[] = {
    {"centre", types::vector("[x, y]", "m"), "", "centre"},
    {"inner", types::number("m", above(0)), "", "radius of the hole"},
    {"outer", types::number("m", above(0)), "", "outer radius"},
    {"layout", types::word("aligned", "lattice"), "depends on the method",
     "aligned: layers with the same number of particles, arranged like the six faces of a rounded cube; "
     "lattice: cut from a cubic lattice. Layers have the exact mass"},
};
constexpr KeyInfo ring_keys[] = {
    shell_keys[0],
    shell_keys[1],
    shell_keys[2],
    {"layout", types::word("aligned", "spaced", "lattice"), "depends on the method",
     "aligned: layers with the same number of particles; spaced: layers with particles about dp apart; "
     "lattice: cut from a lattice. Layers have the exact mass"},
};
constexpr KeyInfo ellipse_keys[] = {
    {"centre", types::vector("[x, y]", "m"), "", "centre"},
    {"semi_axes", types::vector("[a, b]", "m", above(0)), "",
     "semi-axes along x and y, in 3D also z; `rotate` rotates them"},
};
constexpr KeyInfo polygon_keys[] = {
    {"points", types::vector("[x, y]", "m").list(3), "or contours",
     "corners of one closed contour, at least three"},
    {"contours", types::vector("[x, y]", "m").list(3).nested(), "or points",
     "closed contours that do not cross. A point is inside the polygon if an odd number of contours surround it"},
    {"centre", types::vector("[x, y]", "m"), "none",
     "origin of the points, and centre of rotation and reflection. The lattice is symmetric about it"},
};
constexpr KeyInfo file_key = {"file", types::text("path"), "", "path relative to the scene's folder"};
constexpr KeyInfo height_key = {"height", types::number("m", above(0)), "or width",
                                "height of the whole picture"};
constexpr KeyInfo width_key = {"width", types::number("m", above(0)), "or height",
                               "width of the whole picture"};
constexpr KeyInfo middle_key = {"centre", types::vector("[x, y]", "m"), "or low",
                                "centre of the whole picture; the lattice is symmetric about it"};
constexpr KeyInfo low_key = {"low", types::vector("[x, y]", "m"), "or centre",
                             "lower left corner of the whole picture"};
constexpr KeyInfo svg_keys[] = {file_key, height_key, width_key, middle_key, low_key};
constexpr KeyInfo mask_keys[] = {
    file_key,
    height_key,
    width_key,
    middle_key,
    low_key,
    {"threshold", types::number("", {0, 1, true, true}), "0.5",
     "darkness at the face, between 0 (white) and 1 (black)"},
    {"inside", types::word("dark", "light"), "dark",
     "solid part of the picture; transparent pixels count as white"},
};
constexpr KeyInfo mesh_keys[] = {
    file_key,
    {"scale", types::number("m", above(0)), "1", "length of the file's unit: 0.001 for a file in mm"},
    {"centre", types::vector("[x, y, z]", "m"), "as in the file", "centre of the box around the mesh"},
};
constexpr KeyInfo expression_keys[] = {
    {"inside", types::expression("expression of the place"), "",
     "expression that is not 0 inside the shape: \"x^2 + y^2 < r^2\""},
    {"low", types::vector("[x, y]", "m"), "", "corner with the smallest coordinates of the box to search"},
    {"high", types::vector("[x, y]", "m"), "", "corner with the largest coordinates"},
};
constexpr KeyInfo particles_keys[] = {
    {"file", types::text("path"), "",
     "CSV file with columns x, y, in 3D also z, and optionally volume in m² or m³. "
     "Without volumes, particles must be about dp apart, and each has the volume dp² or dp³. "
     "A .vtp file of a run gives its particles at their saved positions, "
     "with their initial volumes and without strain"},
    {"of_body", types::whole(0, 1e6), "all",
     "for a .vtp file of several bodies: number of the body to use, from 0"},
};
constexpr KeyInfo combined_keys[] = {
    {"shapes", types::table("shape", "SHAPE").list(2), "",
     "two or more shapes of any type except particles, on the lattice of the first"},
};
constexpr KeyInfo cylinder_keys[] = {
    {"from", types::vector("[x, y, z]", "m"), "", "centre of one end"},
    {"to", types::vector("[x, y, z]", "m"), "", "centre of the other end"},
    {"radius", types::number("m", above(0)), "", "radius of the outer face"},
    {"inner", types::number("m", above(0)), "none", "radius of the hole of a hollow cylinder"},
    {"layout", types::word("aligned", "lattice"), "depends on the method",
     "of a hollow cylinder. aligned: layers with the same number of particles and the exact mass; lattice: "
     "cut from a cubic lattice"},
};

constexpr std::array kinds = {
    ShapeKind{"rectangle", 2, "sides along the axes, on a lattice", corner_keys, "box", read_box},
    ShapeKind{"disc", 2, "a solid circle", disc_keys, "ball", read_disc},
    ShapeKind{"ring", 2, "a circle with a concentric round hole", ring_keys, "shell", read_ring},
    ShapeKind{"ellipse", 2, "an ellipse along the axes, cut from a lattice", ellipse_keys, "ellipsoid",
              read_ellipse},
    ShapeKind{"polygon", 2, "straight sides and any number of holes, cut from a lattice", polygon_keys, "box",
              read_polygon},
    ShapeKind{"svg", 2, "the painted area of an SVG file, by its fill rules, y up, cut from a lattice",
              svg_keys, "particles", read_svg},
    ShapeKind{"mask", 2, "the dark or light area of a PNG picture, cut from a lattice", mask_keys,
              "particles", read_mask_file},
    ShapeKind{"box", 3, "sides along the axes, on a cubic lattice", corner_keys, "rectangle", read_box},
    ShapeKind{"ball", 3, "a solid sphere, cut from a cubic lattice", ball_keys, "disc", read_disc},
    ShapeKind{"shell", 3, "a hollow sphere", shell_keys, "ring", read_ring},
    ShapeKind{
        "cylinder", 3,
        "solid or hollow; a solid one is cut from a cubic lattice, so lay it along an axis and use `rotate`",
        cylinder_keys, "disc or rectangle", read_cylinder},
    ShapeKind{"ellipsoid", 3, "an ellipsoid along the axes, cut from a cubic lattice", ellipse_keys,
              "ellipse", read_ellipse},
    ShapeKind{
        "mesh", 3,
        "a closed mesh of an STL or OBJ file, cut from a cubic lattice; "
        "where parts of the mesh overlap, relaxed layouts and the warning about the mass count the volume twice",
        mesh_keys, "polygon or svg", read_mesh_file},
    ShapeKind{"expression", 0, "the region where an expression is not 0, cut from a lattice", expression_keys,
              "", read_expression},
    ShapeKind{"particles", 0, "particles from a file, as the only shape of a body", particles_keys, "",
              read_particles},
    ShapeKind{"union", 0, "the union of several shapes", combined_keys, "", read_union},
    ShapeKind{"intersection", 0, "the intersection of several shapes", combined_keys, "", read_intersection},
    ShapeKind{"difference", 0, "the first of several shapes without the others", combined_keys, "",
              read_difference},
};

std::vector<std::string> names_of_shapes(int dim) {
  std::vector<std::string> names;
  for (const ShapeKind& kind : kinds)
    if (kind.dim == dim || kind.dim == 0) names.emplace_back(kind.name);
  return names;
}

Shape read_shape(TomlCursor shape, const ShapeSetting& setting) {
  const std::string given = shape.text("type");
  const std::size_t k = index_of(kinds, given);
  if (k < kinds.size() && kinds[k].dim != setting.dim && kinds[k].dim != 0)
    shape.fail(shape.need("type"), "type",
               fmt::format("{} is a shape with dim = {}, but the scene has dim = {}; use {}", given,
                           kinds[k].dim, setting.dim, kinds[k].otherwise));
  const ShapeKind& kind = kinds[index_of(kinds, shape.choice("type", names_of_shapes(setting.dim)))];
  shape.also_takes(kind.keys);
  Shape result = kind.read(shape, setting);
  if (const auto rotation = read_rotation(shape, setting.dim, result->middle()))
    result = Turned{std::move(result), *rotation};
  shape.finish();
  return result;
}

std::vector<Shape> read_list(TomlCursor& owner, std::string_view key, const std::string& what,
                             const ShapeSetting& setting) {
  TomlValue& value = owner.need(key);
  if (value.kind != TomlValue::Kind::array)
    return {read_shape(owner.enter(value, key, what, keys_of("shape")), setting)};
  ShapeSetting of_each = setting;
  of_each.alone = setting.alone && value.items.size() == 1;
  std::vector<Shape> shapes;
  for (TomlValue& item : value.items)
    shapes.push_back(read_shape(owner.enter(item, key, what, keys_of("shape")), of_each));
  if (shapes.empty())
    owner.fail(value, key,
               fmt::format("{} is empty; it must have at least one {}", what,
                           join_with_or(names_of_shapes(setting.dim))));
  return shapes;
}

}  // namespace

std::span<const ShapeKind> shape_kinds() { return kinds; }

Box read_low_and_high(TomlCursor& shape, int dim) {
  const Box box{shape.point("low", dim), shape.point("high", dim)};
  for (std::size_t k = 0; k < static_cast<std::size_t>(dim); ++k)
    if (!(box.low[k] < box.high[k]))
      shape.fail(shape.need("low"), "low",
                 fmt::format("low.{0} = {1} must be less than high.{0} = {2}", axis_names[k],
                             exact(box.low[k]), exact(box.high[k])));
  return box;
}

std::optional<Rotation> read_rotation(TomlCursor& cursor, int dim, const Point& middle) {
  TomlValue* value = cursor.find("rotate");
  if (!value) return {};
  Rotation rotation{.about = middle};
  if (dim == 2 && value->kind != TomlValue::Kind::table) {
    rotation.angle = cursor.number("rotate");
    return rotation;
  }
  TomlCursor entry = cursor.enter(*value, "rotate", "the rotation of " + cursor.what(), keys_of("rotate"));
  if (dim == 3) {
    rotation.axis = entry.point("axis", dim);
    const double length = std::hypot(rotation.axis[0], rotation.axis[1], rotation.axis[2]);
    if (!(length > 0))
      entry.fail(entry.need("axis"), "axis",
                 "the axis has no length; it must be a direction, e.g. [0, 0, 1]");
    for (double& component : rotation.axis) component /= length;
  }
  rotation.angle = entry.number("angle");
  if (entry.find("about")) rotation.about = entry.point("about", dim);
  entry.finish();
  return rotation;
}

std::vector<Shape> read_shapes(TomlCursor& body, std::string_view key, const ShapeSetting& setting) {
  return read_list(body, key, fmt::format("the {} of {}", key, body.what()), setting);
}

}  // namespace taut::cli
