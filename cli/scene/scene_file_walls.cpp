#include <cmath>

#include "cli/scene/sections.hpp"

namespace taut::cli {
namespace {

Wall read_wall(TomlCursor& cursor, const Scene& scene) {
  Wall wall;
  wall.name = label(cursor, names_of(scene.walls));
  wall.at = cursor.point("at", scene.dim);
  wall.normal = cursor.point("normal", scene.dim);
  const double length = std::hypot(wall.normal[0], wall.normal[1], wall.normal[2]);
  if (!(length > 0))
    cursor.fail(cursor.need("normal"), "normal",
                "the normal has no length; it points to the side where the bodies are, e.g. [0, 1]");
  for (double& component : wall.normal) component /= length;
  cursor.finish();
  return wall;
}

}  // namespace

void read_walls(TomlCursor& root, Scene& scene) {
  read_each(root, "wall", [&](TomlCursor& cursor) { scene.walls.push_back(read_wall(cursor, scene)); });
}

}  // namespace taut::cli
