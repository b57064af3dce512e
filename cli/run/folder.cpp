#include "cli/run/folder.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iostream>
#include <set>
#include <string>
#include <unistd.h>

#include <fmt/core.h>

#include "cli/drawing/frames.hpp"
#include "cli/run/record.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

constexpr std::string_view head_of_record = "{\n  \"taut\": \"";  // as in `to_json`

/// Includes temporary files.
bool is_particle_file(const fs::path& path) {
  const std::string name = path.filename().string();
  const auto has = [&name](std::string_view extension) {
    return name.find("." + std::string(extension)) != std::string::npos;
  };
  return name.starts_with("particles") && (has("pvd") || std::ranges::any_of(particle_formats, has));
}

void remove_file(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) throw OutputError(path.string(), "cannot be removed: " + error.message());
}

template <class Ours>
void remove_files_if(const fs::path& folder, const Ours& ours) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (ours(entry.path())) remove_file(entry.path());
  if (error && error != std::errc::no_such_file_or_directory)
    throw OutputError(folder.string(), "cannot be listed: " + error.message());
}

template <class Name>
void refuse_missing(int number, const Name& name) {
  std::error_code error;
  for (int k = 0; k < number; ++k)
    if (!fs::exists(name(k), error))
      throw UsageError(fmt::format(
          "'{}' is missing, and --resume does not write it again; put it back, or start again without --resume",
          name(k).string()));
}

void check_writable(const fs::path& folder) {
  if (::access(folder.c_str(), R_OK | W_OK | X_OK) != 0 && errno != ENOENT)
    throw OutputError(folder.string(), fmt::format("cannot be written: {}", std::strerror(errno)));
}

}  // namespace

void RunFolder::check() const {
  std::error_code error;
  if (!named_ && fs::is_symlink(path_, error))
    throw UsageError(fmt::format(
        "'{}' is a link; the run would be written into its target. Remove the link, or name a folder with --out",
        path_.string()));
  if (!fs::exists(path_, error)) return;
  if (!fs::is_directory(path_, error))
    throw UsageError(fmt::format("'{}' is not a folder; name another with --out", path_.string()));
  if (fs::is_empty(path_, error) || error) return;
  for (const fs::path& inner : {frames(), particles()})
    if (fs::is_symlink(inner, error))
      throw UsageError(
          fmt::format("'{}' is a link; files would be written and removed in its target; "
                      "remove the link or name another folder with --out",
                      inner.string()));
  // left by a killed run
  const bool begun = holds_only({run_lock_name, record().filename().string() + ".tmp"});
  if (!read_record(record()) && !begun && !is_damaged())
    throw UsageError(fmt::format(
        "'{}' contains files that are not from a run of taut; empty it or name another folder with --out",
        path_.string()));
}

bool RunFolder::is_damaged() const {
  const std::optional<std::string> text = read_whole(record());
  if (!text || read_record(record())) return false;
  std::error_code error;
  if (fs::exists(scene(), error) && fs::exists(history(), error)) return true;
  const std::size_t known = std::min(text->size(), head_of_record.size());
  if (text->substr(0, known) != head_of_record.substr(0, known)) return false;
  std::set<std::string> names{run_lock_name};
  for (const fs::path& each :
       {record(), scene(), history(), lines(), checkpoint(), look(), difference(), frames(), particles()})
    names.insert({each.filename().string(), each.filename().string() + ".tmp"});
  return holds_only(names);
}

bool RunFolder::holds_only(const std::set<std::string>& names) const {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_, error))
    if (!names.contains(entry.path().filename().string())) return false;
  return !error;
}

void RunFolder::claim(std::string_view record_text) const {
  for (const fs::path& inner : {frames(), particles()}) check_writable(inner);
  make_folders(path_);
  write_atomically(record(), record_text, Durability::on_disk);
}

void RunFolder::clear() const {
  make_folders(frames());
  clear_frames();
  remove_files_if(particles(), is_particle_file);
  std::error_code not_empty;
  fs::remove(particles(), not_empty);
  remove_file(history());
  remove_file(lines());
}

void RunFolder::check_frames(int number) const {
  refuse_missing(number, [this](int k) { return frame(k); });
}

void RunFolder::check_particle_files(int number, ParticleFormat format) const {
  refuse_missing(number, [this, format](int k) { return particle_file(k, format); });
}

void RunFolder::keep_frames(int number) const {
  std::set<fs::path> kept;
  for (int k = 0; k < number; ++k) kept.insert(frame(k));
  remove_files_if(frames(), [&](const fs::path& path) { return is_frame(path) && !kept.contains(path); });
}

void RunFolder::keep_particle_files(int number, ParticleFormat format) const {
  std::set<fs::path> kept{particle_index()};
  for (int k = 0; k < number; ++k) kept.insert(particle_file(k, format));
  remove_files_if(particles(),
                  [&](const fs::path& path) { return is_particle_file(path) && !kept.contains(path); });
}

void RunFolder::clear_checkpoint() const {
  remove_file(checkpoint());
  remove_file(checkpoint().string() + ".tmp");
}

void RunFolder::clear_frames() const {
  remove_files_if(frames(), is_frame);
  remove_file(look());
  remove_file(difference());
}

fs::path RunFolder::particle_file(int number, ParticleFormat format) const {
  return particles() / numbered("particles", number, name(format).data());
}

std::optional<fs::path> run_around(const fs::path& path) {
  std::error_code error;
  fs::path folder = fs::absolute(path, error).parent_path();
  for (int k = 0; k < 2; ++k, folder = folder.parent_path())
    if (read_record(RunFolder(folder).record())) return folder;
  return std::nullopt;
}

std::unique_ptr<const FolderLock> lock_around(const fs::path& path, std::string_view command) {
  const std::optional<fs::path> run = run_around(path);
  return run ? std::make_unique<const FolderLock>(*run, FolderLock::Of::run, command, std::cerr) : nullptr;
}

}  // namespace taut::cli
