// Speed of every method on the colliding rings: particle-steps per second, and nanoseconds per directed
// neighbour pair and step, all passes and rebuilds together.
//   taut_bench --benchmark_filter=enog --benchmark_repetitions=5

#include <string>

#include <benchmark/benchmark.h>

#include "cli/scene/scene_file.hpp"
#include "cli/scene/shipped.hpp"
#include "engine/families/catalogue.hpp"
#include "engine/simulation.hpp"

namespace {

using namespace taut;
using namespace taut::cli;

void run_method(benchmark::State& state, const std::string& method, Stepping stepping) {
  const SceneFile file = read_scene(find_scene("colliding-rings"), {{"method", method}});
  Settings settings = file.settings;
  settings.threads = static_cast<int>(state.range(0));
  settings.stepping = stepping;
  constexpr double first_contact = 0.0007, slice = 0.0001;  // s; a slice is about 24 steps
  std::unique_ptr<Simulation> simulation;
  long steps = 0, pair_steps = 0;
  for (auto _ : state) {
    if (!simulation || simulation->time() > 2 * first_contact) {
      state.PauseTiming();  // always the same stretch of the motion: before fragments of a torn ring differ
      simulation = make_simulation(file.scene, settings);
      simulation->advance_to(first_contact);
      state.ResumeTiming();
    }
    const long before = simulation->steps();
    simulation->advance_to(simulation->time() + slice);
    steps += simulation->steps() - before;
    pair_steps += (simulation->steps() - before) * simulation->pairs();
  }
  const auto particles = static_cast<double>(simulation->snapshot().size());
  state.counters["particle_steps/s"] =
      benchmark::Counter(particles * static_cast<double>(steps), benchmark::Counter::kIsRate);
  state.counters["s/pair"] = benchmark::Counter(static_cast<double>(pair_steps),
                                                benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

}  // namespace

int main(int argc, char** argv) {
  for (const MethodInfo& method : methods()) {
    for (const auto& [name, stepping] :
         {std::pair{"dual", Stepping::dual}, std::pair{"single", Stepping::single}}) {
      const std::string method_name(method.name);
      benchmark::RegisterBenchmark((method_name + "/" + name).c_str(), run_method, method_name, stepping)
          ->ArgName("threads")
          ->Arg(1)
          ->Arg(2)
          ->UseRealTime()
          ->Unit(benchmark::kMillisecond);
    }
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
