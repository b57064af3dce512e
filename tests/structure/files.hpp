#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace taut::test {

using Texts = std::vector<std::string>;

inline const std::filesystem::path top = TAUT_SOURCE_DIR;

std::string text_of(const std::filesystem::path& path);
/// Sorted relative paths, without hidden files and build folders.
Texts files_below(const std::filesystem::path& folder, const std::set<std::string>& extensions);
Texts sources_below(const std::filesystem::path& folder);
/// Width in characters, not bytes.
std::size_t columns_of(std::string_view line);

}  // namespace taut::test
