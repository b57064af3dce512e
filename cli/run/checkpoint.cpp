#include "cli/run/checkpoint.hpp"

#include <cstdint>
#include <cstring>
#include <string_view>
#include <zlib.h>

#include "cli/system/atomic_file.hpp"
#include "engine/core/archive.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

constexpr std::string_view kind = "taut checkpoint\n";
constexpr int format = 13;  // to be raised when a `serialize` changes

std::uint32_t checksum(std::string_view bytes) {
  return static_cast<std::uint32_t>(::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace

std::string program_version() { return TAUT_VERSION; }

void write_checkpoint(const std::filesystem::path& path, Checkpoint checkpoint, std::string version) {
  Saver saver;
  int number = format;
  saver(version, number, checkpoint);
  std::string bytes = std::string(kind) + saver.take();
  const std::uint32_t sum = checksum(bytes);
  bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  write_atomically(path, bytes, Kept::on_disk);
}

Checkpoint read_checkpoint(const std::filesystem::path& path) {
  const std::optional<std::string> bytes = read_whole(path);
  if (!bytes) throw UsageError("there is no checkpoint '" + path.string() + "', or it cannot be read");
  const auto refuse = [&](const std::string& reason) {
    return UsageError("'" + path.string() + "' " + reason);
  };
  std::string_view rest = *bytes;
  if (!rest.starts_with(kind)) throw refuse("is not a checkpoint of taut");
  std::uint32_t sum = 0;
  if (rest.size() < kind.size() + sizeof sum) throw refuse("is truncated");
  std::memcpy(&sum, rest.data() + rest.size() - sizeof sum, sizeof sum);
  rest.remove_suffix(sizeof sum);
  if (checksum(rest) != sum) throw refuse("is damaged or truncated: its checksum is wrong");
  Loader loader(rest.substr(kind.size()));
  std::string version;
  int number = 0;
  loader(version, number);
  if (version != TAUT_VERSION || number != format)
    throw refuse("was written by taut " + version + " (format " + std::to_string(number) +
                 "); this is taut " + TAUT_VERSION + " (format " + std::to_string(format) +
                 "); the versions must be the same");
  Checkpoint checkpoint;
  try {
    loader(checkpoint);
    loader.finish();
  } catch (const UsageError& e) {
    throw refuse(std::string("cannot be used: ") + e.what());
  }
  return checkpoint;
}

}  // namespace taut::cli
