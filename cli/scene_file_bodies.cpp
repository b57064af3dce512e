#include <algorithm>
#include <utility>

#include "cli/scene_file_parts.hpp"
#include "cli/text.hpp"

namespace taut {
namespace {

using Kind = TomlValue::Kind;

const std::vector<std::string> axis_names = {"x", "y", "z"};

Shape read_box(TomlCursor& shape, int dim) {
  const Box box{shape.point("low", dim), shape.point("high", dim)};
  for (std::size_t k = 0; k < static_cast<std::size_t>(dim); ++k)
    if (!(box.low[k] < box.high[k]))
      shape.fail(shape.need("low"), "low",
                 "low." + axis_names[k] + " = " + exact(box.low[k]) + " must be less than high." +
                     axis_names[k] + " = " + exact(box.high[k]));
  return box;
}

Shape read_ring(TomlCursor& shape, int dim) {
  const Ring ring{shape.point("centre", dim), shape.positive("inner"), shape.positive("outer")};
  if (!(ring.inner < ring.outer))
    shape.fail(shape.need("inner"), "inner",
               "inner = " + exact(ring.inner) + " must be less than outer = " + exact(ring.outer));
  return ring;
}

Shape read_shape(TomlCursor shape, int dim) {
  const std::string type = shape.choice("type", {"rectangle", "disc", "ring"});
  Shape result;
  if (type == "rectangle")
    result = read_box(shape, dim);
  else if (type == "disc")
    result = Disc{shape.point("centre", dim), shape.positive("radius")};
  else
    result = read_ring(shape, dim);
  shape.finish();
  return result;
}

/// One table, or an array of tables: their union.
std::vector<Shape> read_shapes(TomlCursor& body, int dim) {
  TomlValue& value = body.need("shape");
  const std::string what = "the shape of " + body.what();
  if (value.kind != Kind::array) return {read_shape(body.enter(value, "shape", what), dim)};
  std::vector<Shape> shapes;
  for (TomlValue& item : value.items) shapes.push_back(read_shape(body.enter(item, "shape", what), dim));
  if (shapes.empty())
    body.fail(value, "shape", what + " is empty: it needs at least one rectangle, disc or ring");
  return shapes;
}

void read_velocity(TomlCursor& cursor, int dim, Body& body) {
  const std::size_t components = static_cast<std::size_t>(dim);
  if (!cursor.find("velocity")) {
    TomlValue rest;
    rest.kind = Kind::array;
    rest.items.assign(components, TomlValue(0.0));
    cursor.table().set("velocity", std::move(rest));
  }
  const TomlValue& value = *cursor.find("velocity");
  if (value.kind != Kind::array || value.items.size() != components)
    cursor.fail(value, "velocity",
                "velocity must be an array of " + std::to_string(components) +
                    " numbers or expressions, one per axis");
  for (std::size_t k = 0; k < components; ++k)
    body.velocity[k] = cursor.function_of(value.items[k], "velocity");
}

void read_mirror(TomlCursor& cursor, int dim, Body& body) {
  if (!cursor.find("mirror")) {
    TomlValue none;
    none.kind = Kind::array;
    cursor.table().set("mirror", std::move(none));
  }
  const std::vector<std::string> allowed(axis_names.begin(), axis_names.begin() + dim);
  const auto add = [&](const TomlValue& axis) {
    const std::size_t k = static_cast<std::size_t>(
        std::find(allowed.begin(), allowed.end(), cursor.text_of(axis, "mirror")) - allowed.begin());
    if (k == allowed.size()) cursor.fail_unknown(axis, "mirror", "axis", axis.text, allowed);
    body.mirror[k] = true;
  };
  const TomlValue& value = *cursor.find("mirror");
  if (value.kind != Kind::array) return add(value);
  std::for_each(value.items.begin(), value.items.end(), add);
}

Body read_body(TomlCursor& cursor, const Scene& scene) {
  Body body;
  body.name = label(cursor, names_of(scene.bodies));
  const std::size_t material = index_of(scene.materials, cursor.text("material"));
  if (material == scene.materials.size())
    cursor.fail_unknown(cursor.need("material"), "material", "material", cursor.text("material"),
                        names_of(scene.materials));
  body.material = static_cast<int>(material);
  add_names(cursor.names(), scene.materials[material]);
  body.shapes = read_shapes(cursor, scene.dim);
  read_velocity(cursor, scene.dim, body);
  if (!cursor.find("held")) cursor.table().set("held", TomlValue(0.0));
  body.held = cursor.function_of(cursor.need("held"), "held");
  read_mirror(cursor, scene.dim, body);
  cursor.finish();
  return body;
}

Material read_material(TomlCursor cursor, const std::string& name) {
  Material material{.name = name,
                    .density = cursor.positive("density"),
                    .youngs_modulus = cursor.positive("youngs_modulus"),
                    .poisson_ratio = cursor.number("poisson_ratio")};
  if (!(material.poisson_ratio > -1 && material.poisson_ratio < 0.5))
    cursor.fail(
        cursor.need("poisson_ratio"), "poisson_ratio",
        "poisson_ratio = " + exact(material.poisson_ratio) +
            " must lie between -1 and 0.5, without both ends" +
            (material.poisson_ratio == 0.5 ? ": at 0.5 the bulk modulus would be infinite; 0.49 is rubber"
                                           : ""));
  cursor.finish();
  return material;
}

}  // namespace

std::string label(TomlCursor& entry, const std::vector<std::string>& taken) {
  const std::string name = entry.text("name");
  const auto fits = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
  if (name.empty() || !std::all_of(name.begin(), name.end(), fits))
    entry.fail(entry.need("name"), "name",
               "'" + name + "' is no name: letters, digits, '_' and '-' are allowed");
  if (std::find(taken.begin(), taken.end(), name) != taken.end())
    entry.fail(entry.need("name"), "name",
               "the name '" + name + "' stands for another one already; taken: " + join(taken));
  return name;
}

void add_names(Names& names, const Material& material) {
  names["c0"] = material.sound_speed();
  names["E"] = material.youngs_modulus;
  names["nu"] = material.poisson_ratio;
  names["rho"] = material.density;
  names["K"] = material.bulk_modulus();
  names["G"] = material.shear_modulus();
}

void read_materials(TomlCursor& root, Scene& scene) {
  TomlCursor materials = root.enter(root.need("material"), "material", "[material]");
  for (TomlEntry& entry : materials.table().entries) {
    materials.find(entry.key);
    scene.materials.push_back(
        read_material(materials.enter(entry.value, entry.key, "material '" + entry.key + "'"), entry.key));
  }
}

void read_bodies(TomlCursor& root, Scene& scene) {
  for (TomlValue& value : root.list("body")) {
    const TomlEntry* name = value.find("name");
    const std::string known_as = name ? name->value.text : std::to_string(scene.bodies.size() + 1);
    TomlCursor cursor = root.enter(value, "body." + known_as, "body '" + known_as + "'");
    scene.bodies.push_back(read_body(cursor, scene));
  }
  if (scene.bodies.empty())
    root.fail(FilePlace{1, 1}, "body",
              "the scene has no bodies: write at least one [[body]] with name, shape and material");
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const std::string& name = scene.materials[i].name;
    const bool used = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                  [&](const Body& body) { return body.material == static_cast<int>(i); });
    if (!used)
      root.fail(root.need("material").find(name)->place, "material." + name,
                "the material '" + name + "' is unused: no body is made of it; remove it or use it");
  }
}

}  // namespace taut
