#include <array>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <limits>
#include <map>
#include <ostream>
#include <streambuf>
#include <zlib.h>

#include "cli/run/checkpoint.hpp"
#include "cli/run/resume.hpp"
#include "cli/run/run.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/system/interrupts.hpp"
#include "cli/system/progress.hpp"
#include "engine/core/archive.hpp"
#include "engine/simulation.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/fuzz/readers.hpp"
#include "tests/fuzz/small_scenes.hpp"

namespace taut::fuzz {

using namespace cli;

namespace {

constexpr double later = std::numeric_limits<double>::infinity();

RunOptions options_of(const SmallScene& scene) {
  RunOptions options;
  options.scene = write("small.toml", scene.text).string();
  options.settings = {{"method", std::string(scene.method)}};
  options.threads = 1;
  return options;
}

std::unique_ptr<Simulation> started(const SmallScene& scene) {
  SceneFile file = scene_to_run(options_of(scene));
  file.settings.threads = 1;
  return start(file);
}

void step(Simulation& simulation, int steps) {
  for (int k = 0; k < steps; ++k) simulation.advance_to(std::nextafter(simulation.time(), later));
}

const std::string& state_of(std::size_t number) {
  static std::array<std::string, small_scenes.size()> known;
  if (known[number].empty()) {
    constexpr int some = 5;
    const std::unique_ptr<Simulation> simulation = started(small_scenes[number]);
    step(*simulation, some);
    known[number] = simulation->save();
  }
  return known[number];
}

/// Raises SIGTERM at the end of line number `lines`.
class InterruptAfterLines : public std::streambuf {
 public:
  explicit InterruptAfterLines(int lines) : lines_(lines) {}

 private:
  int overflow(int c) override {
    if (c == '\n' && --lines_ == 0) std::raise(SIGTERM);
    return c;
  }

  int lines_;
};

RunOptions run_options(const SmallScene& scene) {
  RunOptions options = options_of(scene);
  options.out = (folder() / "run").string();
  options.checkpoint_every = 1;  // s, longer than the run
  options.save_particles = "vtp";
  return options;
}

const std::map<std::string, std::string>& interrupted_run() {
  static std::map<std::string, std::string> files;
  if (!files.empty()) return files;
  InterruptAfterLines terminal(2);
  std::ostream err(&terminal);
  const Interrupts interrupts;
  Progress progress(err, Progress::Style::lines);
  run_scene(make_plan(run_options(small_scenes.front())), interrupts, progress, 0);
  for (const char* name : {"run.json", "scene.toml", "history.csv", "checkpoint.bin"})
    files[name] = read_whole(folder() / "run" / name).value_or("");
  expect(!files["checkpoint.bin"].empty(), "the run has left no checkpoint");
  std::filesystem::remove_all(folder() / "run");
  return files;
}

std::string header_of_checkpoint() {
  write_checkpoint(folder() / "empty.bin", {});
  Checkpoint empty;
  Saver saver;
  saver(empty);
  const std::size_t behind = saver.take().size() + sizeof(std::uint32_t);
  std::string file = read_whole(folder() / "empty.bin").value();
  file.resize(file.size() - behind);
  return file;
}

}  // namespace

/// `bytes`: a checkpoint without header and checksum.
void read_checkpoint_file(std::string_view bytes) {
  static const std::string header = header_of_checkpoint();
  std::string file = header + std::string(bytes);
  const auto sum =
      static_cast<std::uint32_t>(::crc32_z(0, reinterpret_cast<const Bytef*>(file.data()), file.size()));
  file.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  const Checkpoint checkpoint = cli::read_checkpoint(write("checkpoint.bin", file));
  write_checkpoint(folder() / "again.bin", checkpoint);
  expect(read_whole(folder() / "again.bin") == file,
         "a rewritten checkpoint differs from the one that was read");
}

void read_state(std::string_view bytes) {
  if (bytes.empty()) return;
  const std::size_t number = static_cast<unsigned char>(bytes[0]) % small_scenes.size();
  const std::string state = changed(state_of(number), bytes.substr(1));
  const std::unique_ptr<Simulation> simulation = started(small_scenes[number]);
  simulation->load(state);
  simulation->snapshot();
  simulation->save();
  step(*simulation, 2);
  simulation->snapshot();
}

void read_resumed(std::string_view bytes) {
  const auto& files = interrupted_run();
  for (const auto& [name, text] : files) write("run/" + name, text);
  const std::filesystem::path run = folder() / "run", path = run / "checkpoint.bin";
  Checkpoint checkpoint = cli::read_checkpoint(path);
  checkpoint.state = changed(checkpoint.state, bytes);
  write_checkpoint(path, checkpoint);
  RunOptions alone;
  alone.threads = 1;
  const RunPlan plan = resume_plan(run, alone);
  InterruptAfterLines terminal(1);
  std::ostream err(&terminal);
  const Interrupts interrupts;
  Progress progress(err, Progress::Style::lines);
  run_scene(plan, interrupts, progress, 0);
}

}  // namespace taut::fuzz
