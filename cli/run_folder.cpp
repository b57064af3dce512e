#include "cli/run_folder.hpp"

#include <array>
#include <cstdio>
#include <fstream>
#include <string>

#include <nlohmann/json.hpp>

#include "cli/whole_file.hpp"
#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut {
namespace {

bool is_run_record(const fs::path& path) {
  std::ifstream file(path);
  const auto record = nlohmann::json::parse(file, nullptr, /*allow_exceptions=*/false);
  return record.is_object() && record.contains("taut");
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw OutputError(path.string(), "the folder cannot be made: " + error.message());
}

void remove_file(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) throw OutputError(path.string(), "cannot be removed: " + error.message());
}

}  // namespace

bool is_frame(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.starts_with("frame_") &&
         (name.ends_with(".png") || name.find(".png.part") != std::string::npos);
}

void RunFolder::check() const {
  std::error_code error;
  if (!fs::exists(path_, error)) return;
  if (!fs::is_directory(path_, error))
    throw UsageError("'" + path_.string() + "' is not a folder; name another with --out");
  if (fs::is_empty(path_, error) || error) return;
  if (!is_run_record(record()))
    throw UsageError("'" + path_.string() +
                     "' holds files that are not a run of taut, which would be mixed " +
                     "up with its own; empty it or name another folder with --out");
}

void RunFolder::claim(std::string_view record_text) const {
  make_folder(path_);
  write_whole(record(), record_text);
  make_folder(frames());
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(frames(), error))
    if (is_frame(entry.path())) remove_file(entry.path());
  remove_file(history());
  remove_file(scene());
  remove_file(difference());
}

fs::path RunFolder::frame(int number) const {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "frame_%05d.png", number);
  return frames() / name.data();
}

}  // namespace taut
