#include "tests/structure/files.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace taut::test {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

Texts files_below(const fs::path& folder, const std::set<std::string>& extensions) {
  Texts files;
  for (fs::recursive_directory_iterator entry(folder), end; entry != end; ++entry) {
    const std::string name = entry->path().filename().string();
    const bool built = entry->is_directory() && fs::exists(entry->path() / "CMakeCache.txt");
    if (name.starts_with('.') || built)
      entry.disable_recursion_pending();
    else if (extensions.contains(entry->path().extension().string()))
      files.push_back(entry->path().lexically_relative(folder).string());
  }
  std::ranges::sort(files);
  return files;
}

Texts sources_below(const fs::path& folder) { return files_below(folder, {".cpp", ".hpp"}); }

std::size_t columns_of(std::string_view line) {
  const auto begins = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; };
  return static_cast<std::size_t>(std::ranges::count_if(line, begins));
}

}  // namespace taut::test
