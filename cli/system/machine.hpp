#pragma once

#include <optional>
#include <string>

#include "cli/system/stopwatch.hpp"

namespace taut::cli {

/// Name of the processor, or "unknown".
std::string machine_name();

/// Cores without hyperthreads, among those that this process may use.
int physical_cores();

/// Load of the machine since construction.
class MachineLoad {
 public:
  MachineLoad();
  /// Mean number of cores that other processes and the hypervisor (steal) used, from /proc/stat. Returns nullopt
  /// for less than 0.2 s, in which the ticks of the kernel, 10 ms, are too coarse.
  std::optional<double> of_others() const;

 private:
  std::optional<double> at_start_;  // s, of all cores
  Stopwatch wall_;
  CpuStopwatch cpu_;
};

}  // namespace taut::cli
