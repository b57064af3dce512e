#pragma once

#include <map>
#include <string>
#include <string_view>

namespace taut {

/// Method of a scene that names none.
inline constexpr std::string_view default_method = "oenog";

/// Time stepping, [Zhang2024] §5: `dual` caches the pair geometry between advection steps, `single` does not.
enum class Stepping { dual, single };

/// Upper bound for the build of the solver. The best set that the machine supports up to it is used. All sets
/// produce identical bytes.
enum class InstructionSet { baseline, x86_64_v3, x86_64_v4 };

/// Settings of a run. Defaults select the method's published values.
struct Settings {
  std::string method{default_method};
  std::map<std::string, double> constants;  // method constants by name, e.g. {"zeta", 4.0}
  std::string law;  // elastic law, if the method allows a choice (MethodInfo::laws); empty = its first
  Stepping stepping = Stepping::dual;
  double cfl = 0;   // time step × fastest wave speed / h (oenog: / dp); 0 = the method's default
  double step = 0;  // length of every step, s; 0 = from cfl
  int threads = 0;  // 0 = all cores, fewer in small scenes
  InstructionSet instruction_set = InstructionSet::x86_64_v4;
};

}  // namespace taut
