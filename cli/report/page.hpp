#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/text/json.hpp"

namespace taut::cli {

/// The data of a page, written as scripts with assignments: a page opened from a file cannot read other files.
struct PageData {
  Json report;                  // kind of the page, and everything but the runs
  std::vector<Json> runs;       // null: this run has no data
  std::vector<Json> particles;  // of these runs, may be shorter
};

/// Scripts relative to the page: `runs/K.js`, `runs/K-particles.js`.
std::string run_script_name(std::size_t run);
std::string particle_script_name(std::size_t run);

/// Throws UsageError if `path` exists and is not a page of taut: a folder with other files, or another file.
void check_page(const std::filesystem::path& path);

/// Writes the page with its scripts and data into `folder`. Throws OutputError.
void write_page(const std::filesystem::path& folder, const PageData& data);

/// Writes the page as one file. Throws OutputError.
void write_embedded_page(const std::filesystem::path& file, const PageData& data);

}  // namespace taut::cli
