#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/text/json.hpp"

namespace taut::cli {

/// Written as scripts, since a page opened from a file cannot load JSON.
struct PageData {
  Json report;                  // without runs and particles
  std::vector<Json> runs;       // null: no data
  std::vector<Json> particles;  // may be shorter than `runs`
};

std::string run_script_name(std::size_t run);
std::string particle_script_name(std::size_t run);

/// Throws UsageError unless `path` is missing, an empty folder or a page of taut.
void check_page(const std::filesystem::path& path);

/// Marks a new page before its other files exist, so that an interrupted page can be replaced. Throws OutputError.
void begin_page(const std::filesystem::path& folder);

/// Throws OutputError.
void write_page(const std::filesystem::path& folder, const PageData& data);

/// Throws OutputError.
void write_embedded_page(const std::filesystem::path& file, const PageData& data);

}  // namespace taut::cli
