#include "cli/system/machine.hpp"

#include <algorithm>
#include <fstream>
#include <sched.h>
#include <set>
#include <unistd.h>

namespace taut::cli {
namespace {

std::optional<double> used_time() {
  std::ifstream file("/proc/stat");
  std::string cpu;
  double user = 0, nice = 0, system = 0, idle = 0, waiting = 0, hard = 0, soft = 0, stolen = 0;
  if (!(file >> cpu >> user >> nice >> system >> idle >> waiting >> hard >> soft >> stolen))
    return std::nullopt;
  return (user + nice + system + hard + soft + stolen) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

}  // namespace

std::string machine_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t colon = line.find(':');
    const std::size_t start = colon == std::string::npos ? colon : line.find_first_not_of(" \t", colon + 1);
    if (start != std::string::npos) return line.substr(start);
  }
  return "unknown";
}

int physical_cores() {
  cpu_set_t mine;
  if (::sched_getaffinity(0, sizeof mine, &mine) != 0) return 1;
  std::set<std::string> siblings;  // "0,4": a core's hyperthreads
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
    if (!CPU_ISSET(cpu, &mine)) continue;
    const std::string folder = "/sys/devices/system/cpu/cpu" + std::to_string(cpu);
    std::string list;
    std::ifstream(folder + "/topology/thread_siblings_list") >> list;
    siblings.insert(list.empty() ? std::to_string(cpu) : list);
  }
  return std::max<int>(1, static_cast<int>(siblings.size()));
}

MachineLoad::MachineLoad() : at_start_(used_time()) {}

std::optional<double> MachineLoad::of_others() const {
  constexpr double least = 0.2;  // s
  const std::optional<double> now = used_time();
  const double wall = wall_.seconds();
  if (!now || !at_start_ || wall < least) return std::nullopt;
  return std::max(0.0, *now - *at_start_ - cpu_.seconds()) / wall;
}

}  // namespace taut::cli
