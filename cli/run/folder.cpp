#include "cli/run/folder.hpp"

#include <set>
#include <string>

#include "cli/drawing/frames.hpp"
#include "cli/run/record.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

/// Names that only `RunFolder::particle_file` and `particle_index` give, whole or in the making.
bool is_particle_file(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.starts_with("particles") &&
         (name.find(".vtp") != std::string::npos || name.find(".pvd") != std::string::npos);
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

template <class Ours>
void remove_those(const fs::path& folder, const Ours& ours) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (ours(entry.path())) remove_file(entry.path());
}

}  // namespace

void RunFolder::check() const {
  std::error_code error;
  if (!fs::exists(path_, error)) return;
  if (!fs::is_directory(path_, error))
    throw UsageError("'" + path_.string() + "' is not a folder; name another with --out");
  if (fs::is_empty(path_, error) || error) return;
  if (!read_record(record()) && !was_killed_in_the_making())
    throw UsageError("'" + path_.string() +
                     "' holds files that are not a run of taut, which would be mixed " +
                     "up with its own; empty it or name another folder with --out");
}

/// There is nothing but the first file, half written.
bool RunFolder::was_killed_in_the_making() const {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_, error))
    if (entry.path() != record().string() + ".tmp") return false;
  return !error;
}

void RunFolder::claim(std::string_view record_text) const {
  make_folder(path_);
  write_atomically(record(), record_text);
}

void RunFolder::clear() const {
  make_folder(frames());
  clear_frames();
  remove_those(particles(), is_particle_file);
  std::error_code not_empty;
  fs::remove(particles(), not_empty);
  remove_file(history());
  remove_file(lines());
}

void RunFolder::keep_frames(int number) const {
  std::set<fs::path> kept;
  for (int k = 0; k < number; ++k) kept.insert(frame(k));
  remove_those(frames(), [&](const fs::path& path) { return is_frame(path) && !kept.contains(path); });
}

void RunFolder::keep_particle_files(int number) const {
  std::set<fs::path> kept{particle_index()};
  for (int k = 0; k < number; ++k) kept.insert(particle_file(k));
  remove_those(particles(),
               [&](const fs::path& path) { return is_particle_file(path) && !kept.contains(path); });
}

void RunFolder::clear_checkpoint() const {
  remove_file(checkpoint());
  remove_file(checkpoint().string() + ".tmp");
}

void RunFolder::clear_frames() const {
  remove_those(frames(), is_frame);
  remove_file(difference());
}

fs::path RunFolder::particle_file(int number) const {
  return particles() / numbered("particles", number, "vtp");
}

}  // namespace taut::cli
