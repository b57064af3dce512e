#pragma once

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/system/build_info.hpp"
#include "cli/system/provenance.hpp"

namespace taut::cli {

/// A run at one moment, with all that it takes to go on with it.
struct Checkpoint {
  std::string method;
  std::string scene;                    // the text of scene.toml
  std::vector<std::string> fields;      // of the particles saved; none: particles are not
  std::optional<double> spacing_asked;  // m
  double every = 0;                     // s of the simulation between checkpoints
  bool draws = true;                    // there are frames
  std::string state;                    // bytes for whoever saved them; empty: nothing has happened yet

  template <class Archive>
  void serialize(Archive& archive) {
    archive(method, scene, fields, spacing_asked, every, draws, state);
    archive.check("an interval or a spacing", [&] {
      return std::isfinite(every) && every >= 0 &&
             (!spacing_asked || (std::isfinite(*spacing_asked) && *spacing_asked > 0));
    });
  }
};

/// Beginning of a checkpoint. The version is for messages only.
struct CheckpointHeader {
  std::string version{build_info.version};
  int format = format_of("checkpoint.bin");
};

/// Replaces the file when all is written, so that a crash leaves the one before. It begins with its kind,
/// the version of the program and the format number, and ends with a checksum of everything. Throws OutputError.
void write_checkpoint(const std::filesystem::path& path, Checkpoint checkpoint, CheckpointHeader header = {});

/// Throws UsageError, with the reason, for a file that is no checkpoint of this format or is not whole.
Checkpoint read_checkpoint(const std::filesystem::path& path);

}  // namespace taut::cli
