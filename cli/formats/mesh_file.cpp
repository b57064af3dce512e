#include "cli/formats/mesh_file.hpp"

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cctype>
#include <cmath>
#include <map>
#include <string>

#include "cli/system/atomic_file.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

constexpr std::uint64_t most_bytes = 256 << 20;

std::string format_of_mesh(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == ".stl" || ending == ".obj") return ending.substr(1);
  throw UsageError("'" + file.string() + "' must be an STL or OBJ file, with the ending .stl or .obj");
}

}  // namespace

Triangles read_mesh(const std::filesystem::path& file) {
  const std::string format = format_of_mesh(file), name = "'" + file.string() + "'";
  const auto bytes = read_whole(file, most_bytes);
  if (!bytes) throw UsageError(name + " cannot be read");
  Assimp::Importer importer;
  // reading from memory ignores material files
  const aiScene* const scene =
      importer.ReadFileFromMemory(bytes->data(), bytes->size(), aiProcess_Triangulate, format.c_str());
  if (!scene) throw UsageError(name + " cannot be read as a mesh: " + importer.GetErrorString());
  Triangles mesh;
  std::map<Point, int> numbers;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;  // lines and points
      std::array<int, 3> corners{};
      for (unsigned k = 0; k < 3; ++k) {
        const aiVector3D& x = part.mVertices[face.mIndices[k]];
        const Point place{x.x, x.y, x.z};
        if (!std::ranges::all_of(place, [](double v) { return std::isfinite(v); }))
          throw UsageError(name + " has a corner whose coordinates are not finite");
        const auto [found, is_new] = numbers.try_emplace(place, static_cast<int>(mesh.points.size()));
        if (is_new) mesh.points.push_back(place);
        corners[k] = found->second;
      }
      if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
        mesh.corners.push_back(corners);
    }
  }
  if (mesh.corners.empty()) throw UsageError(name + " contains no triangles");
  const auto [open, turned] = faults_of(mesh);
  if (open > 0)
    throw UsageError(name + " is not closed: it has " + std::to_string(open) +
                     " open edges; close the mesh, for instance in Blender or MeshLab");
  if (turned > 0)
    throw UsageError(name + " has " + std::to_string(turned) +
                     " edges whose triangles face opposite sides; orient all faces outwards");
  return mesh;
}

}  // namespace taut::cli
