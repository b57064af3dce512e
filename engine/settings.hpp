#pragma once

#include <map>
#include <string>
#include <string_view>

namespace taut {

/// Method of a scene that names none.
inline constexpr std::string_view default_method = "oenog";

enum class Stepping { dual, single };  // [Zhang2024] §5: pair geometry held between advection steps, or not

/// Upper bound for the build of the solver: the best one that this machine supports runs. All builds give the same
/// bytes.
enum class InstructionSet { baseline, x86_64_v3, x86_64_v4 };

/// How a scene is run. Members left at their defaults take the published default of the method.
struct Settings {
  std::string method{default_method};
  std::map<std::string, double> constants;  // a method's own constants by name, e.g. {"zeta", 4.0}
  std::string law;  // of elasticity, for a method that leaves it open (MethodInfo::laws); empty = its first
  Stepping stepping = Stepping::dual;
  double cfl = 0;   // CFL number: time step × fastest wave speed / h (oenog: / dp); 0 = the method's default
  double step = 0;  // s, of every step; 0 = by cfl
  int threads = 0;  // 0 = all cores, fewer in small scenes
  InstructionSet instruction_set = InstructionSet::x86_64_v4;
};

}  // namespace taut
