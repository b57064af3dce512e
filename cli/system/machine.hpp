#pragma once

#include <optional>
#include <string>

#include "cli/system/stopwatch.hpp"

namespace taut::cli {

/// Model of the processor, or "unknown".
std::string machine_name();

/// Number of cores that this process may use, without hyperthreads.
int physical_cores();

class MachineLoad {
 public:
  MachineLoad();
  /// Mean number of cores that other processes and the hypervisor (steal) have used since construction, from
  /// /proc/stat. Nullopt below 0.2 s: kernel ticks of 10 ms are too coarse.
  std::optional<double> of_others() const;

 private:
  std::optional<double> at_start_;  // s, all cores
  Stopwatch wall_;
  CpuStopwatch cpu_;
};

}  // namespace taut::cli
