#pragma once

#include <vector>

#include "cli/run/folder.hpp"
#include "cli/system/stopwatch.hpp"
#include "engine/diagnostics/fields.hpp"

namespace taut::cli {

class ParticleSeries {
 public:
  ParticleSeries(std::vector<const Field*> fields, ParticleForm form, const RunFolder& folder,
                 Seconds& seconds);

  void add(const Snapshot& snapshot);
  /// Writes particles.pvd for .vtp files. Throws OutputError, as `add` does.
  void save_index();
  int written() const { return static_cast<int>(times_.size()); }
  void put_on_disk();

  template <class Archive>
  void serialize(Archive& archive) {
    archive(times_);
    on_disk_ = times_.size();
  }

 private:
  std::filesystem::path file(std::size_t number) const {
    return folder_.particle_file(static_cast<int>(number), form_.format);
  }

  std::vector<const Field*> fields_;
  ParticleForm form_;
  RunFolder folder_;
  Seconds& seconds_;
  std::vector<double> times_;  // s
  std::size_t on_disk_ = 0;
  std::size_t indexed_ = 0;
};

}  // namespace taut::cli
