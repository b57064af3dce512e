#pragma once

#include <filesystem>
#include <vector>

namespace taut::cli {

/// Makes a folder of copies of `files`, or puts them in place of all that is in it. Others see the folder
/// either in its old or in its new state, never half. Throws OutputError and leaves the old state.
void write_whole_folder(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files);

}  // namespace taut::cli
