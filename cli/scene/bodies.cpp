#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "cli/scene/sections.hpp"
#include "cli/text/format.hpp"
#include "engine/scene/shapes/box.hpp"
#include "engine/scene/shapes/given_particles.hpp"

namespace taut::cli {
namespace {

using Kind = TomlValue::Kind;

TomlValue array_of(std::vector<TomlValue> items) {
  TomlValue array;
  array.kind = Kind::array;
  array.items = std::move(items);
  return array;
}

const std::vector<TomlValue>& components(TomlCursor& cursor, std::string_view key, int dim) {
  const std::size_t number = static_cast<std::size_t>(dim);
  const TomlValue& value = cursor.need(key);
  if (value.kind != Kind::array || value.items.size() != number)
    cursor.fail(value, key,
                fmt::format("{} must be an array of {} numbers or expressions, one per axis", key, number));
  return value.items;
}

TomlValue zeros(int dim) { return array_of({static_cast<std::size_t>(dim), TomlValue(0.0)}); }

void read_velocity(TomlCursor& cursor, int dim, Body& body) {
  if (!cursor.find("velocity")) cursor.table().set("velocity", zeros(dim));
  std::size_t axis = 0;
  for (const TomlValue& component : components(cursor, "velocity", dim))
    body.velocity[axis++] = cursor.function_of(component, "velocity");
}

void read_displacement(TomlCursor& cursor, int dim, Body& body) {
  if (!cursor.find("displacement")) return;
  std::size_t axis = 0;
  for (const TomlValue& component : components(cursor, "displacement", dim))
    body.displacement[axis++] = cursor.function_of(component, "displacement");
}

void read_on_boundary(TomlCursor& cursor, Body& body) {
  body.on_boundary = cursor.flag("on_boundary");
  const bool one_box = body.shapes.size() == 1 && body.shapes.front().as<Box>();
  if (body.on_boundary && !(one_box && body.without.empty()))
    cursor.fail(cursor.need("on_boundary"), "on_boundary",
                "on_boundary = true needs a body of one rectangle or box without cut-outs; "
                "to rotate it, use the key 'rotate' of the body, not of the shape");
}

void read_lattice(TomlCursor& cursor, int dim, Body& body) {
  if (cursor.choice("lattice") != name(Lattice::hexagonal)) return;
  body.lattice = Lattice::hexagonal;
  const TomlValue& value = cursor.need("lattice");
  if (dim == 3)
    cursor.fail(
        value, "lattice",
        "lattice = \"hexagonal\" needs dim = 2, but this scene has dim = 3; remove it to get a cubic lattice");
  if (body.on_boundary)
    cursor.fail(
        value, "lattice",
        "lattice = \"hexagonal\" cannot be used with on_boundary = true, which needs a square lattice; "
        "remove one of them");
}

void read_body_layout(TomlCursor& cursor, Body& body) {
  body.relaxed = cursor.choice("layout") == "relaxed";
  const auto refuse = [&](const std::string& reason) {
    cursor.fail(cursor.need("layout"), "layout", "layout = \"relaxed\" " + reason);
  };
  if (!body.relaxed) return;
  if (body.lattice == Lattice::hexagonal)
    refuse("starts from a square lattice; remove lattice = \"hexagonal\"");
  if (body.on_boundary) refuse("cannot be used with on_boundary = true; remove one of them");
  if (body.shapes.front().as<GivenParticles>())
    refuse("cannot be used with the shape 'particles', whose particles are given; remove it");
}

/// An empty component leaves its axis free.
void read_clamped(TomlCursor& cursor, int dim, Body& body) {
  if (!cursor.find("held")) cursor.table().set("held", TomlValue(0.0));
  const TomlValue& value = cursor.need("held");
  if (value.kind != Kind::array) {
    body.clamped = cursor.function_of(value, "held");
    return;
  }
  std::size_t axis = 0;
  for (const TomlValue& component : components(cursor, "held", dim)) {
    const bool free = component.kind == Kind::text && component.text.empty();
    body.guided[axis++] = free ? Expression() : cursor.function_of(component, "held");
  }
  const std::vector<Expression> all(body.guided.begin(), body.guided.begin() + dim);
  if (std::ranges::any_of(all, [](const Expression& along) { return !along; })) return;
  body.clamped = [all](const Point& x) {
    return std::ranges::all_of(all, [&](const Expression& along) { return along(x) != 0; });
  };
}

std::vector<TomlCursor> tables(TomlCursor& body, std::string_view key, const std::string& what) {
  if (!body.find(key)) body.table().set(std::string(key), array_of({}));
  TomlValue& value = *body.find(key);
  if (value.kind != Kind::array)
    body.fail(value, key, fmt::format("{0} must be an array of tables: {0} = [{{ ... }}]", key));
  std::vector<TomlCursor> cursors;
  for (TomlValue& item : value.items)
    cursors.push_back(body.enter(item, key, fmt::format("{} of {}", what, body.what()), keys_of(key)));
  return cursors;
}

int read_material_of(TomlCursor& cursor, const Scene& scene) {
  const std::string name = cursor.text("material");
  const std::size_t material = index_of(scene.materials, name);
  if (material == scene.materials.size())
    cursor.fail_unknown(cursor.need("material"), "material", "material", name, names_of(scene.materials));
  return static_cast<int>(material);
}

void read_parts(TomlCursor& cursor, const Scene& scene, Body& body) {
  for (TomlCursor& entry : tables(cursor, "parts", "a part")) {
    Part part;
    part.material = read_material_of(entry, scene);
    part.where = entry.function_of(entry.need("where"), "where");
    entry.finish();
    body.parts.push_back(std::move(part));
  }
}

void read_drives(TomlCursor& cursor, const Scene& scene, Body& body) {
  for (TomlCursor& entry : tables(cursor, "driven", "a driven region")) {
    Drive drive;
    drive.where = entry.function_of(entry.need("where"), "where");
    std::size_t axis = 0;
    for (const TomlValue& component : components(entry, "velocity", scene.dim))
      drive.velocity[axis++] = entry.function_of_time(component, "velocity");
    if (entry.find("until")) drive.until = entry.number("until");
    entry.finish();
    body.drives.push_back(std::move(drive));
  }
}

constexpr std::array load_kinds = {Load::Kind::force, Load::Kind::force_density, Load::Kind::traction};

[[noreturn]] void fail_without_load(TomlCursor& entry) {
  entry.refuse_unknown_keys();  // most likely one is misspelt
  std::vector<std::string> keys;
  for (const Load::Kind kind : load_kinds) keys.push_back(fmt::format("'{}'", name(kind)));
  entry.fail(entry.table().place, "force",
             fmt::format("{} is missing in {}", join_with_or(keys), entry.what()));
}

void read_loads(TomlCursor& cursor, const Scene& scene, Body& body) {
  for (TomlCursor& entry : tables(cursor, "loaded", "a loaded region")) {
    Load load;
    load.where = entry.function_of(entry.need("where"), "where");
    std::string key;
    for (const Load::Kind kind : load_kinds) {
      const TomlValue* value = entry.find(name(kind));
      if (value == nullptr) continue;
      if (!key.empty())
        entry.fail(
            *value, name(kind),
            fmt::format("{} and {} are both given; a load must have only one of them", name(kind), key));
      key = name(kind);
      load.kind = kind;
    }
    if (key.empty()) fail_without_load(entry);
    std::size_t axis = 0;
    for (const TomlValue& component : components(entry, key, scene.dim))
      load.value[axis++] = entry.function_of(component, key);
    const TomlValue& ramp = entry.need("ramp");
    load.ramp = entry.function_of_time(ramp, "ramp");
    if (!load.ramp)
      entry.fail(ramp, "ramp", "ramp is 0, so the load never acts; remove the load or change the ramp");
    entry.finish();
    body.loads.push_back(std::move(load));
  }
}

void read_mirror(TomlCursor& cursor, int dim, Body& body) {
  if (!cursor.find("mirror")) cursor.table().set("mirror", array_of({}));
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

Layers layers_of(TomlCursor& cursor, bool keeps_neighbors) {
  const auto is = [&](std::string_view key, std::string_view text) {
    const TomlValue* value = cursor.find(key);
    return value && value->text == text;
  };
  if (is("lattice", name(Lattice::hexagonal)) || is("layout", "relaxed")) return Layers::of_lattice;
  return keeps_neighbors ? Layers::for_initial_neighbours : Layers::for_searched_neighbours;
}

Body read_body(TomlCursor& cursor, const SceneFile& file, bool keeps_neighbors) {
  const Scene& scene = file.scene;
  Body body;
  body.name = label(cursor, names_of(scene.bodies));
  body.material = read_material_of(cursor, scene);
  add_names(cursor.names(), scene.materials[static_cast<std::size_t>(body.material)]);
  ShapeSetting setting{.dim = scene.dim,
                       .dp = scene.spacing,
                       .folder = std::filesystem::absolute(file.path).parent_path(),
                       .layers = layers_of(cursor, keeps_neighbors),
                       .alone = cursor.find("without") == nullptr};
  body.shapes = read_shapes(cursor, "shape", setting);
  setting.alone = false;
  setting.layers = Layers::none;
  if (cursor.find("without")) body.without = read_shapes(cursor, "without", setting);
  read_on_boundary(cursor, body);
  read_lattice(cursor, scene.dim, body);
  read_body_layout(cursor, body);
  body.rotation = read_rotation(cursor, scene.dim, body.shapes.front()->middle());
  read_velocity(cursor, scene.dim, body);
  read_clamped(cursor, scene.dim, body);
  read_displacement(cursor, scene.dim, body);
  read_mirror(cursor, scene.dim, body);
  read_parts(cursor, scene, body);
  read_drives(cursor, scene, body);
  read_loads(cursor, scene, body);
  cursor.finish();
  return body;
}

Wall read_wall(TomlCursor& cursor, const Scene& scene) {
  Wall wall;
  wall.name = label(cursor, names_of(scene.walls));
  wall.at = cursor.point("at", scene.dim);
  wall.normal = cursor.point("normal", scene.dim);
  const double length = std::hypot(wall.normal[0], wall.normal[1], wall.normal[2]);
  if (!(length > 0))
    cursor.fail(cursor.need("normal"), "normal",
                "the normal has no length; it must point from the wall to the bodies, e.g. [0, 1] in 2D");
  for (double& component : wall.normal) component /= length;
  cursor.finish();
  return wall;
}

}  // namespace

std::string label(TomlCursor& entry, const std::vector<std::string>& taken) {
  const std::string name = entry.text("name");
  const auto fits = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
  check_name_length(entry, entry.need("name").place, "name", name);
  if (name.empty() || !std::all_of(name.begin(), name.end(), fits))
    entry.fail(entry.need("name"), "name",
               fmt::format("'{}' is not a valid name; use letters, digits, '_' and '-'", name));
  if (std::find(taken.begin(), taken.end(), name) != taken.end())
    entry.fail(
        entry.need("name"), "name",
        fmt::format("the name '{}' is already in use; choose a name other than: {}", name, join(taken)));
  return name;
}

void read_gravity_and_damping(TomlCursor& root, Scene& scene) {
  if (!root.find("gravity")) root.table().set("gravity", zeros(scene.dim));
  std::size_t axis = 0;
  for (const TomlValue& component : components(root, "gravity", scene.dim))
    scene.gravity[axis++] = root.function_of_time(component, "gravity");
  scene.damping = root.number("damping");
}

void read_bodies(TomlCursor& root, bool keeps_neighbors, SceneFile& file) {
  Scene& scene = file.scene;
  for (TomlValue& value : root.list("body")) {
    const TomlEntry* name = value.find("name");
    const std::string label = name ? name->value.text : std::to_string(scene.bodies.size() + 1);
    TomlCursor cursor = root.enter(value, "body." + label, fmt::format("body '{}'", label), keys_of("body"));
    scene.bodies.push_back(read_body(cursor, file, keeps_neighbors));
  }
  if (scene.bodies.empty())
    root.fail(FilePlace{1, 1}, "body",
              "the scene has no bodies; add at least one [[body]] with name, shape and material");
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const std::string& name = scene.materials[i].name;
    const auto is_it = [&](const auto& region) { return region.material == static_cast<int>(i); };
    const auto holds_it = [&](const Body& body) {
      return is_it(body) || std::ranges::any_of(body.parts, is_it);
    };
    if (std::ranges::none_of(scene.bodies, holds_it))
      root.fail(root.need("material").find(name)->place, "material." + name,
                fmt::format("the material '{}' is unused; remove it or use it in a body", name));
  }
}

void read_walls(TomlCursor& root, Scene& scene) {
  read_each(root, "wall", [&](TomlCursor& cursor) { scene.walls.push_back(read_wall(cursor, scene)); });
}

}  // namespace taut::cli
