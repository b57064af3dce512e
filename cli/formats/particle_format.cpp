#include "cli/formats/particle_format.hpp"

#include "cli/formats/particle_columns.hpp"
#include "cli/formats/particle_file.hpp"

namespace taut::cli {

std::string particle_text(const Snapshot& snapshot, std::span<const Field* const> fields, ParticleForm form) {
  switch (form.format) {
    case ParticleFormat::xyz:
      return extended_xyz_text(snapshot, fields, form.single_precision);
    case ParticleFormat::csv:
      return particle_csv_text(snapshot, fields, form.single_precision);
    case ParticleFormat::vtp:
      break;
  }
  return particle_file_text(snapshot, fields, form.single_precision);
}

}  // namespace taut::cli
