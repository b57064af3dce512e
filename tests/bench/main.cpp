#include <cstdlib>

#include <benchmark/benchmark.h>

#include "tests/bench/benchmarks.hpp"

int main(int argc, char** argv) {
  setenv("TAUT_SCENES", TAUT_SCENE_FOLDER, /*overwrite*/ 0);
  taut::bench::register_methods();
  taut::bench::register_program();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
