#pragma once

#include <map>
#include <string>

namespace taut {

enum class Stepping { dual, single };  // [Zhang2024] §5: pair geometry held between advection steps, or not

/// Which build of the solver runs: the best that this machine has and that goes no further than this. The
/// results are the same to the last bit.
enum class InstructionSet { baseline, x86_64_v3, x86_64_v4 };

/// How a scene is run; what is left out takes the method's published default.
struct Settings {
  std::string method = "enog";
  std::map<std::string, double> constants;  // a method's own constants by name, e.g. {"zeta", 4.0}
  std::string law;  // of elasticity, for a method that leaves it open (MethodInfo::laws); empty = its first
  Stepping stepping = Stepping::dual;
  double cfl =
      0;  // step over h (oenog: dp) by the fastest wave, and particle where the paper has it so; 0 = the
          // method's default
  double step = 0;  // s, of every step; 0 = by cfl
  int threads = 0;  // 0 = all cores, fewer in small scenes
  InstructionSet instruction_set = InstructionSet::x86_64_v4;
};

}  // namespace taut
