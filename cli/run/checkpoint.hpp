#pragma once

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/formats/particle_format.hpp"
#include "cli/system/build_info.hpp"
#include "cli/system/provenance.hpp"

namespace taut::cli {

struct Checkpoint {
  std::string method;
  std::string scene;
  std::vector<std::string> fields;  // of saved particles; empty: not saved
  ParticleForm particle_form;
  std::optional<double> requested_spacing;  // m
  double every = 0;                         // simulated s; 0: no periodic checkpoints
  bool draws = true;
  std::string state;  // empty: start of the run

  template <class Archive>
  void serialize(Archive& archive) {
    archive(method, scene, fields, particle_form.format, particle_form.single_precision, requested_spacing,
            every, draws, state);
    archive.check("a format of particles",
                  [&] { return static_cast<std::size_t>(particle_form.format) < particle_formats.size(); });
    archive.check("an interval or a spacing", [&] {
      return std::isfinite(every) && every >= 0 &&
             (!requested_spacing || (std::isfinite(*requested_spacing) && *requested_spacing > 0));
    });
  }
};

/// `version` is for messages only.
struct CheckpointHeader {
  std::string version{build_info.version};
  int format = format_of("checkpoint.bin");
};

/// Atomic. A checksum ends the file. Throws OutputError.
void write_checkpoint(const std::filesystem::path& path, Checkpoint checkpoint, CheckpointHeader header = {});

/// Throws UsageError.
Checkpoint read_checkpoint(const std::filesystem::path& path);

}  // namespace taut::cli
