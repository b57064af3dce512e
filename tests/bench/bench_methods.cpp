// Speed of every method, in 2D on the colliding rings, in 3D on the oscillating plate with three layers:
//   enog/2d/threads:1         particle-steps/s, and seconds per directed pair and step, including rebuilds
//   enog/2d/to_transcription  speed-up over the paper's transcription (tests/engine/methods/naive_*.hpp) on one
//                             thread, best of alternating runs; finite elements have no transcription
// The transcription of oenog uses explicit forces, not dual numbers.

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include <benchmark/benchmark.h>

#include "cli/scene/scene_file.hpp"
#include "cli/scene/shipped.hpp"
#include "engine/methods/catalogue.hpp"
#include "engine/simulation.hpp"
#include "tests/bench/benchmarks.hpp"
#include "tests/engine/methods/bonded/naive_oenog.hpp"
#include "tests/engine/methods/naive_runs.hpp"

namespace taut::bench {
namespace {

using namespace taut::cli;
using namespace taut::test;

/// Measured part of a scene's motion, in slices.
struct Motion {
  const char* scene;
  double from, slice;
  int slices;
  int transcribed;  // steps of the transcription per timing
};
// `rings` ends before the rings fracture
constexpr Motion rings{"colliding-rings", 7e-4, 1e-4, 7, 10};
constexpr Motion plate{"oscillating-plate-3d", 0, 3e-5, 20, 1};
const Motion& motion_of(int dim) { return dim == 2 ? rings : plate; }

struct Subject {
  std::string method;
  int dim;
};

SceneFile scene_of(const Subject& subject) {
  return read_scene(find_scene(motion_of(subject.dim).scene), {{"method", subject.method}});
}

class MeasuredPart {
 public:
  MeasuredPart(const Subject& subject, int threads) : motion_(motion_of(subject.dim)) {
    const SceneFile file = scene_of(subject);
    Settings settings = file.settings;
    settings.threads = threads;
    simulation_ = make_simulation(file.scene, settings);
    simulation_->advance_to(motion_.from);
    start_ = simulation_->save();
    particles_ = static_cast<double>(simulation_->snapshot().size());
  }
  double particles() const { return particles_; }
  long pairs() const { return simulation_->pairs(); }

  bool over() const { return done_ == motion_.slices; }
  void go_back() { simulation_->load(start_), done_ = 0; }
  long advance() {
    const long before = simulation_->steps();
    simulation_->advance_to(motion_.from + ++done_ * motion_.slice);
    return simulation_->steps() - before;
  }

 private:
  const Motion& motion_;
  std::unique_ptr<Simulation> simulation_;
  std::string start_;
  double particles_ = 0;
  int done_ = 0;
};

benchmark::Counter rate(double amount) { return {amount, benchmark::Counter::kIsRate}; }

void run_method(benchmark::State& state, const Subject& subject) {
  MeasuredPart part(subject, static_cast<int>(state.range(0)));
  long steps = 0, pair_steps = 0;
  for (auto _ : state) {
    if (part.over()) {
      state.PauseTiming();
      part.go_back();
      state.ResumeTiming();
    }
    const long made = part.advance();
    steps += made;
    pair_steps += made * part.pairs();
  }
  state.counters["particle_steps/s"] = rate(part.particles() * static_cast<double>(steps));
  state.counters["s/pair"] = benchmark::Counter(static_cast<double>(pair_steps),
                                                benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

using Step = std::function<void()>;

template <class Run>
Step steps_of(Run made) {
  const auto run = std::make_shared<Run>(after_steps(std::move(made), 0));
  return [run] { run->step(); };
}

/// Function that makes one step, empty for finite elements; keeps a reference to `scene`.
template <int Dim>
Step transcription(const Scene& scene, const Settings& settings) {
  const MethodInfo& method = *find_method(settings.method);
  switch (method.formulation.family) {
    case Family::ul_split:
      return steps_of(naive_split<Dim>(scene, settings));
    case Family::ul_cauchy:
      return steps_of(naive_current<Dim>(scene, settings));
    case Family::tl_displacement:
      return steps_of(naive_total_lagrangian<Dim>(scene, settings));
    case Family::tl_mixed:
      return steps_of(naive_mixed<Dim>(scene, settings));
    case Family::bonded: {
      const auto run = std::make_shared<NaiveOenogIn<Dim>>(scene, constant_of(settings, Dim, "h"));
      run->by_hand = true;
      const double damping = constant_of(settings, Dim, "damping");
      return [run, damping, cfl = method.cfl] { run->step(cfl, damping); };
    }
    case Family::finite_elements:
      break;
  }
  return {};
}

template <class Work>
double seconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void compare_with_transcription(benchmark::State& state, const Subject& subject) {
  const SceneFile file = scene_of(subject);
  const Step step = subject.dim == 2 ? transcription<2>(file.scene, file.settings)
                                     : transcription<3>(file.scene, file.settings);
  MeasuredPart part(subject, 1);
  double engine = std::numeric_limits<double>::max(), paper = engine;  // s per step
  for (auto _ : state) {
    const int steps = motion_of(subject.dim).transcribed;
    paper = std::min(paper, seconds([&] {
                              for (int k = 0; k < steps; ++k) step();
                            }) / steps);
    state.PauseTiming();
    for (part.go_back(); !part.over();) {
      long made = 0;
      const double took = seconds([&] { made = part.advance(); });
      engine = std::min(engine, took / static_cast<double>(made));
    }
    state.ResumeTiming();
  }
  state.counters["particle_steps/s"] = part.particles() / engine;
  state.counters["to_transcription"] = paper / engine;
}

}  // namespace

void register_methods() {
  for (const int dim : {2, 3}) {
    for (const MethodInfo& method : methods()) {
      const Subject subject{std::string(method.name), dim};
      const std::string name = subject.method + "/" + std::to_string(dim) + "d";
      benchmark::RegisterBenchmark(name.c_str(), run_method, subject)
          ->ArgName("threads")
          ->Arg(1)
          ->Arg(2)
          ->UseRealTime()
          ->Unit(benchmark::kMillisecond);
      if (method.formulation.family != Family::finite_elements)
        benchmark::RegisterBenchmark((name + "/to_transcription").c_str(), compare_with_transcription,
                                     subject)
            ->Iterations(dim == 2 ? 5 : 3)
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
    }
  }
}

}  // namespace taut::bench
