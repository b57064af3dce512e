#pragma once

#include <map>
#include <string>
#include <string_view>

namespace taut {

inline constexpr std::string_view default_method = "oenog";

/// [Zhang2024] §5: `dual` caches the pair geometry between advection steps.
enum class Stepping { dual, single };

/// Greatest instruction set to use; all produce identical bytes.
enum class InstructionSet { baseline, x86_64_v3, x86_64_v4 };

struct Settings {
  std::string method{default_method};
  std::map<std::string, double> constants;  // by name
  std::string law;                          // of MethodInfo::laws; empty = the first
  Stepping stepping = Stepping::dual;
  // CFL number, based on h (oenog: on dp; fe1, fe2: time step / stability limit); 0 = the method's default
  double cfl = 0;
  double step = 0;  // s; 0 = from cfl
  int threads = 0;  // 0 = all cores, fewer in small scenes
  InstructionSet instruction_set = InstructionSet::x86_64_v4;
};

}  // namespace taut
