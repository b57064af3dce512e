#pragma once

#include <optional>
#include <string>

#include "cli/system/stopwatch.hpp"

namespace taut::cli {

/// Model of the processor, or "unknown".
std::string machine_name();

/// Cores that this process may use, without hyperthreads.
int physical_cores();

class MachineLoad {
 public:
  MachineLoad();
  /// Mean number of cores used by other processes and the hypervisor since construction. Nullopt without /proc/stat,
  /// and in the first 0.2 s, since kernel ticks are coarse.
  std::optional<double> of_others() const;

 private:
  std::optional<double> at_start_;  // s, all cores
  Stopwatch wall_;
  CpuStopwatch cpu_;
};

}  // namespace taut::cli
