#include "cli/run/particle_series.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include "cli/system/atomic_file.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"

namespace taut::cli {

ParticleSeries::ParticleSeries(std::vector<const Field*> fields, ParticleForm form, const RunFolder& folder,
                               Seconds& seconds)
    : fields_(std::move(fields)), form_(form), folder_(folder), seconds_(seconds) {}

void ParticleSeries::add(const Snapshot& snapshot) {
  const Timed timed(seconds_.write);
  if (times_.empty()) {
    std::error_code error;
    std::filesystem::create_directories(folder_.particles(), error);
    if (error)
      throw OutputError(folder_.particles().string(), "the folder cannot be created: " + error.message());
  }
  write_atomically(file(times_.size()), particle_text(snapshot, fields_, form_));
  times_.push_back(snapshot.time);
}

void ParticleSeries::save_index() {
  if (form_.format != ParticleFormat::vtp || indexed_ == times_.size()) return;
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (std::size_t k = 0; k < times_.size(); ++k)
    text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", exact(times_[k]),
                        file(k).filename().string());
  write_atomically(folder_.particle_index(), text + "</Collection>\n</VTKFile>\n", Durability::on_disk);
  indexed_ = times_.size();
}

void ParticleSeries::put_on_disk() {
  if (on_disk_ == times_.size()) return;
  while (on_disk_ < times_.size()) cli::put_on_disk(file(on_disk_++));
  cli::put_on_disk(folder_.particles());
}

}  // namespace taut::cli
