#include <algorithm>
#include <array>

#include "cli/scene/sections.hpp"
#include "cli/text/format.hpp"

namespace taut::cli {
namespace {

Shape read_box(TomlCursor& shape, int dim, Layers) {
  const Box box{shape.point("low", dim), shape.point("high", dim)};
  for (std::size_t k = 0; k < static_cast<std::size_t>(dim); ++k)
    if (!(box.low[k] < box.high[k]))
      shape.fail(shape.need("low"), "low",
                 "low." + axis_names[k] + " = " + exact(box.low[k]) + " must be less than high." +
                     axis_names[k] + " = " + exact(box.high[k]));
  return box;
}

/// The key `layout`, one of `allowed`, or `otherwise` where it is not there.
RoundLayout read_layout(TomlCursor& shape, const std::vector<RoundLayout>& allowed, RoundLayout otherwise) {
  std::vector<std::string> names;
  for (const RoundLayout layout : allowed) names.emplace_back(name(layout));
  if (!shape.find("layout")) shape.table().set("layout", TomlValue(std::string(name(otherwise))));
  const std::string chosen = shape.choice("layout", names);
  return allowed[static_cast<std::size_t>(std::ranges::find(names, chosen) - names.begin())];
}

/// Aligned only where particles on the inner face are at least a third as far apart as on the outer one.
Shape read_ring(TomlCursor& shape, int dim, Layers layers) {
  Ring ring{shape.point("centre", dim), shape.positive("inner"), shape.positive("outer"),
            RoundLayout::lattice};
  if (!(ring.inner < ring.outer))
    shape.fail(shape.need("inner"), "inner",
               "inner = " + exact(ring.inner) + " must be less than outer = " + exact(ring.outer));
  if (dim == 3 || layers == Layers::none) return ring;
  const bool thin = 3 * ring.inner >= ring.outer;
  ring.layout =
      read_layout(shape, {RoundLayout::aligned, RoundLayout::spaced, RoundLayout::lattice},
                  layers == Layers::that_fit_faces && thin ? RoundLayout::aligned : RoundLayout::spaced);
  if (ring.layout == RoundLayout::aligned && !thin)
    shape.fail(
        shape.need("layout"), "layout",
        "layout = \"aligned\" would put the particles of the inner face less than a third as far apart as "
        "those of the outer one; it needs inner >= outer/3, take \"spaced\"");
  return ring;
}

Shape read_disc(TomlCursor& shape, int dim, Layers layers) {
  Disc disc{shape.point("centre", dim), shape.positive("radius")};
  if (dim == 2 && layers != Layers::none)
    disc.layout = read_layout(shape, {RoundLayout::spaced, RoundLayout::lattice},
                              layers == Layers::that_fit_faces ? RoundLayout::spaced : RoundLayout::lattice);
  return disc;
}

/// `inner` only where it is hollow.
Shape read_cylinder(TomlCursor& shape, int dim, Layers) {
  Cylinder cylinder{shape.point("from", dim), shape.point("to", dim), shape.positive("radius")};
  if (!(cylinder.length() > 0))
    shape.fail(shape.need("to"), "to",
               "from and to are the same point: they are the middles of the two ends");
  if (!shape.find("inner")) return cylinder;
  cylinder.inner = shape.positive("inner");
  if (!(cylinder.inner < cylinder.radius))
    shape.fail(shape.need("inner"), "inner",
               "inner = " + exact(cylinder.inner) + " must be less than radius = " + exact(cylinder.radius));
  return cylinder;
}

constexpr KeyInfo corner_keys[] = {
    {"low", "[x, y], m", "", "the corner of least coordinates"},
    {"high", "[x, y], m", "", "the corner of greatest coordinates"},
};
constexpr KeyInfo ball_keys[] = {
    {"centre", "[x, y], m", "", "its middle"},
    {"radius", "number, m", "", "to its face"},
};
constexpr KeyInfo disc_keys[] = {
    ball_keys[0],
    ball_keys[1],
    {"layout", "spaced or lattice", "by the method",
     "of particles: a centre and layers of 6, 12, 18 …, or cut from a square lattice"},
};
constexpr KeyInfo shell_keys[] = {
    {"centre", "[x, y], m", "", "its middle"},
    {"inner", "number, m", "", "radius of the hole"},
    {"outer", "number, m", "", "radius"},
};
constexpr KeyInfo ring_keys[] = {
    shell_keys[0],
    shell_keys[1],
    shell_keys[2],
    {"layout", "aligned, spaced or lattice", "by the method",
     "of particles: layers with the same number of particles on each, about a spacing apart on each, or cut "
     "from a square lattice; layers have the exact mass"},
};
constexpr KeyInfo cylinder_keys[] = {
    {"from", "[x, y, z], m", "", "middle of one end"},
    {"to", "[x, y, z], m", "", "middle of the other"},
    {"radius", "number, m", "", "of its outer face"},
    {"inner", "number, m", "none", "radius of the hole of a hollow one"},
};

/// Every shape as scene files of one dimension name it.
constexpr std::array kinds = {
    ShapeKind{"rectangle", 2, "along the axes, on a square lattice", corner_keys, "box", read_box},
    ShapeKind{"disc", 2, "a full circle", disc_keys, "ball", read_disc},
    ShapeKind{"ring", 2, "a circle with a round hole in its middle", ring_keys, "shell", read_ring},
    ShapeKind{"box", 3, "along the axes, on a cubic lattice", corner_keys, "rectangle", read_box},
    ShapeKind{"ball", 3, "a full sphere, cut from a cubic lattice", ball_keys, "disc", read_disc},
    ShapeKind{"shell", 3, "a hollow ball, cut from a cubic lattice", shell_keys, "ring", read_ring},
    ShapeKind{"cylinder", 3, "full or hollow, cut from a cubic lattice; lay it along an axis and `rotate` it",
              cylinder_keys, "disc or rectangle", read_cylinder},
};

std::vector<std::string> names_of_shapes(int dim) {
  std::vector<std::string> names;
  for (const ShapeKind& kind : kinds)
    if (kind.dim == dim) names.emplace_back(kind.name);
  return names;
}

Shape read_shape(TomlCursor shape, int dim, Layers layers) {
  const std::string given = shape.text("type");
  const std::size_t k = index_of(kinds, given);
  if (k < kinds.size() && kinds[k].dim != dim)
    shape.fail(shape.need("type"), "type",
               given + " is a shape of " + std::to_string(kinds[k].dim) +
                   " dimensions and the scene has dim = " + std::to_string(dim) + "; take " +
                   std::string(kinds[k].otherwise));
  const ShapeKind& kind = kinds[index_of(kinds, shape.choice("type", names_of_shapes(dim)))];
  shape.also_takes(kind.keys);
  const Shape result = kind.read(shape, dim, layers);
  shape.finish();
  return result;
}

}  // namespace

std::span<const ShapeKind> shape_kinds() { return kinds; }

std::vector<Shape> read_shapes(TomlCursor& body, std::string_view key, int dim, Layers layers) {
  TomlValue& value = body.need(key);
  const std::string what = "the " + std::string(key) + " of " + body.what();
  if (value.kind != TomlValue::Kind::array)
    return {read_shape(body.enter(value, key, what, keys_of("shape")), dim, layers)};
  std::vector<Shape> shapes;
  for (TomlValue& item : value.items)
    shapes.push_back(read_shape(body.enter(item, key, what, keys_of("shape")), dim, layers));
  if (shapes.empty())
    body.fail(value, key, what + " is empty: it needs at least one " + join_with_or(names_of_shapes(dim)));
  return shapes;
}

}  // namespace taut::cli
