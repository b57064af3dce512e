#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace taut::cli {

/// Scene folders in search order: the folders in the variable TAUT_SCENES (separated by ':'), then `scenes`
/// beside the program, or share/taut/scenes if it is installed. The first folder that contains a name is used. Throws
/// UsageError for a missing folder of TAUT_SCENES.
std::vector<std::filesystem::path> scene_folders();
/// Sorted names of scenes; names in gallery/ come last, as "gallery/NAME". Throws UsageError without scene folders.
std::vector<std::string> scene_names();
/// `scene` is a path or a name. Throws UsageError with the nearest names.
std::filesystem::path find_scene(const std::string& scene);

/// Sorted names of the sweep files in studies/ of the scene folders.
std::vector<std::string> study_names();
/// `sweep` is a path or a name. Throws UsageError with the nearest names.
std::filesystem::path find_sweep(const std::string& sweep);

/// Sorted names of the suite files in suites/ of the scene folders.
std::vector<std::string> suite_names();
/// Suite file of this name, if any.
std::optional<std::filesystem::path> shipped_suite(const std::string& name);

/// Sorted names of the claim files in papers/ of the scene folders, such as "Zhang2024".
std::vector<std::string> paper_names();
/// `paper` is a path or a name. Throws UsageError with the nearest names.
std::filesystem::path find_paper(const std::string& paper);

}  // namespace taut::cli
