#include "tests/fuzz/fuzz_target.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>
#include <unistd.h>

#include "engine/error.hpp"
#include "tests/fuzz/readers.hpp"

namespace taut::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr Target table[] = {
    {"toml", read_toml},
    {"scene", read_scene_file},
    {"sweep", read_sweep_file},
    {"expression", read_expression},
    {"outline", read_outline},
    {"svg", read_svg_file},
    {"session", read_session_lines},
    {"arguments", read_arguments},
    {"completion", read_completion},
    {"values", read_values},
    {"text", read_text},
    {"vtp", read_particle_file},
    {"png", read_picture},
    {"results", read_results_files},
    {"record", read_records},
    {"table", read_tables},
    {"checkpoint", read_checkpoint_file},
    {"state", read_state},
    {"resume", read_resumed},
};

class OwnFolder {
 public:
  OwnFolder() : before_(fs::current_path()) {
    std::string name = (fs::temp_directory_path() / "taut-fuzz-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
    fs::current_path(path_);
    ::setenv("TAUT_SCENES", path_.c_str(), 1);
  }
  ~OwnFolder() {
    ::unsetenv("TAUT_SCENES");
    std::error_code ignored;
    fs::current_path(before_, ignored);
    fs::remove_all(path_, ignored);
  }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;

 private:
  fs::path before_, path_;
};

struct Change {
  std::uint32_t place = 0;
  std::uint8_t kind = 0;
  std::uint64_t value = 0;
};
constexpr std::size_t change_size = 13;  // bytes

Change change_at(std::string_view bytes) {
  Change change;
  std::memcpy(&change.place, bytes.data(), 4);
  std::memcpy(&change.kind, bytes.data() + 4, 1);
  std::memcpy(&change.value, bytes.data() + 5, 8);
  return change;
}

void overwrite(std::string& bytes, std::size_t place, const void* with, std::size_t size) {
  if (place < bytes.size()) std::memcpy(bytes.data() + place, with, std::min(size, bytes.size() - place));
}

void make(const Change& change, std::string& bytes) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   inf = std::numeric_limits<double>::infinity();
  constexpr std::array<double, 8> numbers = {nan, inf, -inf, 0, -1, 1e300, -1e300, 1e-300};
  if (bytes.empty()) return;
  const std::size_t place = change.place % bytes.size();
  switch (change.kind % 6) {
    case 0:
      return overwrite(bytes, place, &change.value, 1);
    case 1:
      return overwrite(bytes, place, &change.value, 4);
    case 2:
      return overwrite(bytes, place / 8 * 8, &change.value, 8);
    case 3:
      return overwrite(bytes, place, &numbers[change.value % numbers.size()], sizeof(double));
    case 4:
      return void(bytes.erase(place, change.value % 64));
    default:
      return void(bytes.insert(place, change.value % 64, '\0'));
  }
}

template <class Work>
void allowing_errors(const Work& work) {
  try {
    work();
  } catch (const UsageError&) {
  } catch (const SceneError&) {
  } catch (const NumericalError&) {
  } catch (const OutputError&) {
  }
}

}  // namespace

std::span<const Target> targets() { return table; }

void feed(const Target& target, std::string_view bytes) {
  const OwnFolder here;
  allowing_errors([&] { target.read(bytes); });
}

void expect(bool holds, const std::string& what) {
  if (!holds) throw Finding(what);
}

void attempt(const std::function<void()>& reading) { allowing_errors(reading); }

std::vector<std::string> parts_of(std::string_view bytes, std::size_t count) {
  constexpr std::string_view between = "%%%%\n";
  std::vector<std::string> parts(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t end = k + 1 < count ? bytes.find(between) : std::string_view::npos;
    parts[k] = bytes.substr(0, end);
    bytes = end == std::string_view::npos ? "" : bytes.substr(end + between.size());
  }
  return parts;
}

std::vector<std::string> lines_of(std::string_view bytes) {
  std::istringstream text{std::string(bytes)};
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

fs::path folder() { return fs::current_path(); }

fs::path write(const std::string& name, std::string_view bytes) {
  const fs::path path = folder() / name;
  if (path.has_parent_path()) fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

std::string changed(std::string bytes, std::string_view changes) {
  for (; changes.size() >= change_size; changes.remove_prefix(change_size)) make(change_at(changes), bytes);
  return bytes;
}

}  // namespace taut::fuzz
