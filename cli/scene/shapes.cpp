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

/// A shape as scene files of one dimension name it.
struct ShapeKind {
  std::string_view name;
  int dim;
  std::string_view otherwise;  // what comes nearest in the other dimension
  Shape (*read)(TomlCursor&, int dim, Layers);
};
constexpr std::array shape_kinds = {
    ShapeKind{"rectangle", 2, "box", read_box},
    ShapeKind{"disc", 2, "ball", read_disc},
    ShapeKind{"ring", 2, "shell", read_ring},
    ShapeKind{"box", 3, "rectangle", read_box},
    ShapeKind{"ball", 3, "disc", read_disc},
    ShapeKind{"shell", 3, "ring", read_ring},
    ShapeKind{"cylinder", 3, "disc or rectangle", read_cylinder},
};

std::vector<std::string> names_of_shapes(int dim) {
  std::vector<std::string> names;
  for (const ShapeKind& kind : shape_kinds)
    if (kind.dim == dim) names.emplace_back(kind.name);
  return names;
}

Shape read_shape(TomlCursor shape, int dim, Layers layers) {
  const std::string given = shape.text("type");
  const std::size_t k = index_of(shape_kinds, given);
  if (k < shape_kinds.size() && shape_kinds[k].dim != dim)
    shape.fail(shape.need("type"), "type",
               given + " is a shape of " + std::to_string(shape_kinds[k].dim) +
                   " dimensions and the scene has dim = " + std::to_string(dim) + "; take " +
                   std::string(shape_kinds[k].otherwise));
  const std::string type = shape.choice("type", names_of_shapes(dim));
  const Shape result = shape_kinds[index_of(shape_kinds, type)].read(shape, dim, layers);
  shape.finish();
  return result;
}

}  // namespace

std::vector<Shape> read_shapes(TomlCursor& body, std::string_view key, int dim, Layers layers) {
  TomlValue& value = body.need(key);
  const std::string what = "the " + std::string(key) + " of " + body.what();
  if (value.kind != TomlValue::Kind::array) return {read_shape(body.enter(value, key, what), dim, layers)};
  std::vector<Shape> shapes;
  for (TomlValue& item : value.items) shapes.push_back(read_shape(body.enter(item, key, what), dim, layers));
  if (shapes.empty())
    body.fail(value, key, what + " is empty: it needs at least one " + join_with_or(names_of_shapes(dim)));
  return shapes;
}

}  // namespace taut::cli
