#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace taut::cli {

/// Where scenes with names lie, in the order in which they are searched: the folders of the environment
/// variable TAUT_SCENES (with ':' between them), then the one that comes with taut: `scenes` beside the
/// program, or share/taut/scenes of where it is installed. Of a name that is in several the first counts.
/// Throws UsageError for a folder of TAUT_SCENES that is not there.
std::vector<std::filesystem::path> scene_folders();
/// Names of the scenes there, sorted; those of gallery/ after the others, as "gallery/NAME". Throws
/// UsageError if there is no folder of scenes.
std::vector<std::string> scene_names();
/// `scene` is a path or a name; throws UsageError with the nearest names.
std::filesystem::path find_scene(const std::string& scene);

/// Names of the sweep files in studies/ there, sorted.
std::vector<std::string> study_names();
/// `sweep` is a path or the name of one of them; throws UsageError with the nearest names.
std::filesystem::path find_sweep(const std::string& sweep);

}  // namespace taut::cli
