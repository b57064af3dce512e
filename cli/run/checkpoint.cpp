#include "cli/run/checkpoint.hpp"

#include <cstdint>
#include <cstring>
#include <fstream>
#include <string_view>
#include <unistd.h>
#include <zlib.h>

#include <fmt/core.h>

#include "cli/system/atomic_file.hpp"
#include "engine/core/archive.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

constexpr std::string_view kind = "taut checkpoint\n";

std::uint32_t checksum(std::string_view bytes) {
  return static_cast<std::uint32_t>(::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

/// Avoids reading large foreign files.
bool begins_otherwise(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::ifstream file(path, std::ios::binary);
  std::string beginning(kind.size(), '\0');
  return file.read(beginning.data(), static_cast<std::streamsize>(beginning.size())) && beginning != kind;
}

/// Half of the memory: file and state must both fit.
std::uint64_t most_bytes() {
  return static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) / 2;
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, Checkpoint checkpoint, CheckpointHeader header) {
  Saver saver;
  saver(header.version, header.format, checkpoint);
  std::string bytes = std::string(kind) + saver.take();
  const std::uint32_t sum = checksum(bytes);
  bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  write_atomically(path, bytes, Durability::on_disk);
}

Checkpoint read_checkpoint(const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& reason) {
    return UsageError(fmt::format("'{}' {}", path.string(), reason));
  };
  if (begins_otherwise(path)) throw refuse("is not a checkpoint of taut");
  const std::optional<std::string> bytes = read_whole(path, most_bytes());
  if (!bytes)
    throw UsageError(fmt::format("there is no checkpoint '{}', or it cannot be read", path.string()));
  std::string_view rest = *bytes;
  if (!rest.starts_with(kind)) throw refuse("is not a checkpoint of taut");
  std::uint32_t sum = 0;
  if (rest.size() < kind.size() + sizeof sum) throw refuse("is truncated");
  std::memcpy(&sum, rest.data() + rest.size() - sizeof sum, sizeof sum);
  rest.remove_suffix(sizeof sum);
  if (checksum(rest) != sum) throw refuse("is damaged or truncated: its checksum is wrong");
  Loader loader(rest.substr(kind.size()));
  const CheckpointHeader known;
  CheckpointHeader header;
  loader(header.version, header.format);
  if (header.format != known.format)
    throw refuse(
        fmt::format("has format {}, written by taut {}; taut {} reads format {} only; continue with taut {}, "
                    "or start again without this file",
                    header.format, header.version, known.version, known.format, header.version));
  Checkpoint checkpoint;
  try {
    loader(checkpoint);
    loader.finish();
  } catch (const UsageError& e) {
    throw refuse(fmt::format("cannot be used: {}", e.what()));
  }
  return checkpoint;
}

}  // namespace taut::cli
