#include "cli/system/whole_folder.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <unistd.h>

#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

/// A folder beside the one to be written, on the same file system; gone when done, with whatever is in it.
class Beside {
 public:
  Beside(const fs::path& folder, const char* what)
      : path_(folder.string() + "." + what + std::to_string(::getpid())) {
    remove();
  }
  ~Beside() { remove(); }
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;
  const fs::path& path() const { return path_; }

 private:
  void remove() const {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  fs::path path_;
};

/// 0 or an errno.
int rename_folder(const fs::path& from, const fs::path& to) {
  return std::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

/// 0 or an errno. In one step where the file system can; else `folder` is missing for a moment.
int put_in_place(const fs::path& fresh, const fs::path& folder) {
  if (!fs::exists(folder)) return rename_folder(fresh, folder);
  if (::renameat2(AT_FDCWD, fresh.c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS) return errno;
  const Beside old(folder, "old");
  if (const int error = rename_folder(folder, old.path())) return error;
  const int error = rename_folder(fresh, folder);
  if (error != 0) rename_folder(old.path(), folder);
  return error;
}

}  // namespace

void write_whole_folder(const fs::path& folder, const std::vector<fs::path>& files) {
  // "a/b/" and "a/b" are the same folder, but not with something behind
  const fs::path target = (fs::absolute(folder) / "").lexically_normal().parent_path();
  const Beside fresh(target, "tmp");
  std::error_code error;
  fs::create_directories(fresh.path(), error);
  for (const fs::path& file : files)
    if (!error) fs::copy_file(file, fresh.path() / file.filename(), error);
  if (!error) error.assign(put_in_place(fresh.path(), target), std::generic_category());
  if (error) throw OutputError(folder.string(), "cannot be written: " + error.message());
}

}  // namespace taut::cli
