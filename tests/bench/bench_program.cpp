// Times of the program outside the solver:
//   frames/2d         frames/s of `taut render` with 4 400 particles at 1280 × 720, including start and input
//   start/list        `taut list methods`
//   start/one-step    a run of one step without pictures

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <spawn.h>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include <benchmark/benchmark.h>

#include "tests/bench/benchmarks.hpp"

namespace taut::bench {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

void run_taut(Arguments arguments) {
  arguments.insert(arguments.begin(), TAUT_PROGRAM);
  std::vector<char*> raw;
  for (std::string& argument : arguments) raw.push_back(argument.data());
  raw.push_back(nullptr);
  posix_spawn_file_actions_t quiet;
  ::posix_spawn_file_actions_init(&quiet);
  ::posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t process = 0;
  const int error = ::posix_spawn(&process, raw[0], &quiet, nullptr, raw.data(), environ);
  ::posix_spawn_file_actions_destroy(&quiet);
  if (error != 0) throw std::runtime_error(arguments[0] + ": " + std::strerror(error));
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error(arguments[0] + " " + arguments[1] + " has failed");
}

class Scratch {
 public:
  Scratch() { fs::create_directories(folder_); }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("taut-bench-" + std::to_string(::getpid()));
};

void time_program(benchmark::State& state, const Arguments& arguments) {
  try {
    for (auto _ : state) run_taut(arguments);
  } catch (const std::exception& error) {
    state.SkipWithError(error.what());
  }
}

void time_render(benchmark::State& state) {
  constexpr int frames = 121;
  try {
    const Scratch scratch;
    run_taut({"run", "colliding-rings", "--method", "oenog", "--until", "0.003", "--frames",
              std::to_string(frames), "--no-render", "--save-particles", "--quiet", "--out",
              scratch.path("run")});
    for (auto _ : state)
      run_taut(
          {"render", scratch.path("run"), "--size", "1280x720", "--quiet", "--out", scratch.path("frames")});
  } catch (const std::exception& error) {
    return state.SkipWithError(error.what());
  }
  state.counters["frames/s"] = benchmark::Counter(frames, benchmark::Counter::kIsIterationInvariantRate);
}

void time_one_step(benchmark::State& state) {
  const Scratch scratch;
  time_program(state, {"run", "colliding-rings", "--until", "1e-7", "--no-render", "--quiet", "--out",
                       scratch.path("run")});
}

}  // namespace

void register_program() {
  benchmark::RegisterBenchmark("frames/2d", time_render)->UseRealTime()->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("start/list", time_program, Arguments{"list", "methods"})
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("start/one-step", time_one_step)->UseRealTime()->Unit(benchmark::kMillisecond);
}

}  // namespace taut::bench
