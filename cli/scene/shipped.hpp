#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace taut::cli {

/// Folders of TAUT_SCENES, then the shipped scenes. Throws UsageError if TAUT_SCENES contains a missing folder.
std::vector<std::filesystem::path> scene_folders();
/// Sorted; the gallery comes last, as "gallery/NAME". Throws UsageError without scene folders.
std::vector<std::string> scene_names();
/// `scene`: path or name. Throws UsageError.
std::filesystem::path find_scene(const std::string& scene);

std::vector<std::string> study_names();
/// Like find_scene().
std::filesystem::path find_sweep(const std::string& sweep);

std::vector<std::string> suite_names();
std::optional<std::filesystem::path> shipped_suite(const std::string& name);

/// Sorted.
std::vector<std::string> paper_names();
/// Like find_scene().
std::filesystem::path find_paper(const std::string& paper);

}  // namespace taut::cli
