#include <array>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <map>
#include <random>
#include <set>

#include <doctest/doctest.h>

#include "cli/run/checkpoint.hpp"
#include "engine/error.hpp"
#include "tests/support/child_program.hpp"
#include "tests/support/program_runner.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

using Arguments = std::vector<std::string>;

const Arguments long_run = {"--until", "0.1", "--history", "1e-4"};
const Arguments with_checkpoints = {"--checkpoint-every", "0.001"};

Arguments operator+(Arguments a, const Arguments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Arguments resume(const TemporaryFolder& folder, const std::string& out, const Arguments& more = {}) {
  return Arguments{"run", "--resume", folder.str(out), "--threads", "1", "--quiet"} + more;
}

std::set<std::string> files_below(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code none;
  for (const auto& entry : fs::recursive_directory_iterator(folder, none))
    if (entry.is_regular_file()) names.insert(fs::relative(entry.path(), folder).string());
  return names;
}

/// Compares all files, except times, speed, threads and provenance in run.json.
void check_same_run(const fs::path& a, const fs::path& b) {
  REQUIRE(files_below(a) == files_below(b));
  for (const std::string& name : files_below(a)) {
    CAPTURE(name);
    if (name != "run.json") {
      CHECK(text_of(a / name) == text_of(b / name));
      continue;
    }
    auto first = json_of(a / name), second = json_of(b / name);
    for (auto* record : {&first, &second})
      for (const char* key : {"seconds", "particle_steps_per_second", "threads", "provenance"})
        record->erase(key);
    CHECK(first == second);
  }
}

/// Returns false if the program ended before `history` had `bytes`.
bool run_and_kill(const Arguments& arguments, const fs::path& history, std::uintmax_t bytes) {
  ChildProgram child(arguments);
  ChildProgram::wait([&] {
    std::error_code none;
    const std::uintmax_t size = fs::file_size(history, none);
    return child.has_ended() || (!none && size >= bytes);
  });
  child.send(SIGKILL);
  return child.ending_signal() == SIGKILL;
}

void leave_interrupted(const TemporaryFolder& folder, const Arguments& more = {}) {
  ChildProgram child(
      tiny_run(folder, "out", Arguments{"--until", "1000", "--no-render"} + with_checkpoints + more));
  ChildProgram::wait_for(folder / "out/checkpoint.bin");
  child.send(SIGINT);
  REQUIRE(child.exit_code() == 130);
}

/// Calls `look` at each write of a progress line.
class Watch : public std::stringbuf {
 public:
  explicit Watch(std::function<void()> look) : look_(std::move(look)) {}

 private:
  int sync() override {
    look_();
    return std::stringbuf::sync();
  }
  std::function<void()> look_;
};

void check_refused(const TemporaryFolder& folder, const std::string& reason, const Arguments& more = {}) {
  auto before = files_below(folder / "out");
  before.erase("run.lock");
  const std::string history = text_of(folder / "out/history.csv");
  const Outcome outcome = call(resume(folder, "out", more));
  CAPTURE(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, reason));
  CHECK(files_below(folder / "out") == before);
  CHECK(text_of(folder / "out/history.csv") == history);
}

}  // namespace

TEST_SUITE("restart") {
  TEST_CASE("runs killed at random moments resume to the same bytes with methods of four families") {
    std::mt19937 random(1);
    int kills = 0;
    for (const char* method : {"enog", "og", "oenog", "d-ulsph-r-tic", "tl"}) {
      CAPTURE(method);
      const TemporaryFolder folder;
      const Arguments all = long_run + Arguments{"--method", method};
      const int code = call(tiny_run(folder, "straight", all)).code;
      const auto length = fs::file_size(folder / "straight/history.csv");
      const auto somewhere = [&](double from) {
        return static_cast<std::uintmax_t>(std::uniform_real_distribution(from, 0.8)(random) *
                                           static_cast<double>(length));
      };
      const fs::path history = folder / "out/history.csv";
      kills += run_and_kill(tiny_run(folder, "out", all + with_checkpoints), history, somewhere(0.1));
      if (!fs::exists(folder / "out/checkpoint.bin")) continue;
      kills += run_and_kill(resume(folder, "out"), history, somewhere(0.3));
      if (fs::exists(folder / "out/checkpoint.bin")) CHECK(call(resume(folder, "out")).code == code);
      check_same_run(folder / "straight", folder / "out");
    }
    CHECK(kills >= 5);
  }

  TEST_CASE("an interrupted run resumes to the same bytes, with kept frames and saved particles") {
    const TemporaryFolder folder;
    const Arguments all =
        long_run +
        Arguments{"--range", "auto", "--save-particles", "--fields", "pressure", "--spacing", "0.0021"};
    REQUIRE(call(tiny_run(folder, "straight", all)).code == 0);
    ChildProgram child(tiny_run(folder, "out", all + with_checkpoints));
    ChildProgram::wait_for(folder / "out/particles/particles_00001.vtp");
    child.send(SIGINT);
    REQUIRE(child.exit_code() == 130);
    REQUIRE(json_of(folder / "out/run.json")["status"] == "interrupted");
    REQUIRE(fs::exists(folder / "out/checkpoint.bin"));
    const fs::path first = folder / "out/particles/particles_00000.vtp";
    fs::rename(first, folder / "elsewhere");
    check_refused(folder, "particles_00000.vtp' is missing");
    fs::rename(folder / "elsewhere", first);
    REQUIRE(call(resume(folder, "out")).code == 0);
    check_same_run(folder / "straight", folder / "out");
  }

  TEST_CASE("walls in kept frames of a resumed run move past a followed body") {
    const TemporaryFolder folder;
    const std::string scene = folder.str("walled.toml");
    std::ofstream(scene) << text_of(write_tiny_scene(folder)) << R"(
[[wall]]
name = "floor"
at = [0, -0.015]
normal = [0, 1]
)";
    const auto walled = [&](const std::string& out, const Arguments& more) {
      return Arguments{"run", scene, "--out", folder.str(out), "--threads", "1", "--quiet"} + long_run +
             Arguments{"--range", "auto", "--follow", "left", "--view", "-0.02:0.02:-0.02:0.01"} + more;
    };
    REQUIRE(call(walled("straight", {})).code == 0);
    ChildProgram child(walled("out", {"--checkpoint-every", "0.001", "--save-particles"}));
    ChildProgram::wait_for(folder / "out/particles/particles_00001.vtp");
    child.send(SIGINT);
    REQUIRE(child.exit_code() == 130);
    REQUIRE(call(resume(folder, "out")).code == 0);
    for (const char* frame : {"frames/frame_00000.png", "frames/frame_00002.png", "frames/frame_00004.png"})
      CHECK(text_of(folder / "straight" / frame) == text_of(folder / "out" / frame));
  }

  TEST_CASE("outputs between two steps have the same bytes wherever the checkpoint is") {
    const TemporaryFolder folder;
    const Arguments all{"--until",          "0.01",     "--frames", "1500",
                        "--save-particles", "--fields", "speed",    "--no-render"};
    REQUIRE(call(tiny_run(folder, "straight", all)).code == 0);
    const auto some = fs::file_size(folder / "straight/history.csv") / 3;
    const Arguments often{"--checkpoint-every", "1e-9"};
    REQUIRE(run_and_kill(tiny_run(folder, "out", all + often), folder / "out/history.csv", some));
    REQUIRE(call(resume(folder, "out")).code == 0);
    check_same_run(folder / "straight", folder / "out");
  }

  TEST_CASE("checkpoints do not alter a run, and are removed when it has finished or diverged") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "without", {"--until", "0.01"})).code == 0);
    REQUIRE(call(tiny_run(folder, "with", Arguments{"--until", "0.01"} + with_checkpoints)).code == 0);
    check_same_run(folder / "without", folder / "with");
    const Outcome outcome = call(resume(folder, "with"));
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "is finished"));
    const Arguments wild{"--set", "cfl=20", "--until", "0.01"};
    REQUIRE(call(tiny_run(folder, "without", wild)).code == 3);
    REQUIRE(call(tiny_run(folder, "with", wild + Arguments{"--checkpoint-every", "1e-5"})).code == 3);
    check_same_run(folder / "without", folder / "with");
    CHECK(contains(call(resume(folder, "with")).err, "has failed"));
  }

  TEST_CASE("a run stopped before its first saved state restarts to the same bytes") {
    const TemporaryFolder folder;
    const Arguments all = long_run + Arguments{"--no-render", "--spacing", "0.0021"};
    REQUIRE(call(tiny_run(folder, "straight", all)).code == 0);
    const auto some = fs::file_size(folder / "straight/history.csv") / 10;
    const Arguments later{"--checkpoint-every", "1"};
    REQUIRE(run_and_kill(tiny_run(folder, "out", all + later), folder / "out/history.csv", some));
    REQUIRE(run_and_kill(tiny_run(folder, "bare", all), folder / "bare/history.csv", some));
    const std::map<std::string, Arguments> given{{"out", {}}, {"bare", {"--no-render"}}};
    for (const auto& [name, more] : given) {
      const Outcome outcome = call(resume(folder, name, more));
      CAPTURE(outcome.err);
      CHECK(outcome.code == 0);
      CHECK(contains(outcome.err, "starts from the beginning"));
      check_same_run(folder / "straight", folder / name);
    }
  }

  TEST_CASE("a folder without a run cannot be resumed") {
    const TemporaryFolder folder;
    check_refused(folder, "is not a run folder");
    fs::create_directories(folder / "out");
    check_refused(folder, "is not a run folder");
    fs::copy_file(write_tiny_scene(folder), folder / "out/scene.toml");
    check_refused(folder, "is not a run folder");
  }

  TEST_CASE("a checkpoint that is damaged, cut short, or of another method or scene is refused") {
    const TemporaryFolder folder;
    leave_interrupted(folder);
    const fs::path path = folder / "out/checkpoint.bin";
    const std::string whole = text_of(path), scene = text_of(folder / "out/scene.toml");
    const auto write = [](const fs::path& to, const std::string& text) {
      std::ofstream(to, std::ios::binary) << text;
    };
    const auto put = [&](const std::string& bytes) { write(path, bytes); };
    for (const std::size_t at : {std::size_t{20}, whole.size() / 2, whole.size() - 1}) {
      std::string flipped = whole;
      flipped[at] = static_cast<char>(flipped[at] ^ 1);
      put(flipped);
      check_refused(folder, "damaged");
      put(whole.substr(0, at));
      check_refused(folder, "truncated");
    }
    put("");
    check_refused(folder, "is not a checkpoint");
    put(whole + "x");
    check_refused(folder, "damaged");

    taut::cli::Checkpoint checkpoint = (put(whole), taut::cli::read_checkpoint(path));
    checkpoint.method = "og";
    taut::cli::write_checkpoint(path, checkpoint);
    check_refused(folder, "method 'og'");
    put(whole);
    write(folder / "out/scene.toml", scene + "\n# mine\n");
    check_refused(folder, "another scene");
    write(folder / "out/scene.toml", scene);
    write(folder / "out/history.csv", "t\n");
    check_refused(folder, "has lost lines");
    fs::remove(folder / "out/history.csv");
    check_refused(folder, "history.csv' is missing");
  }

  TEST_CASE(
      "a checkpoint with wrong contents and a correct checksum is refused, with history.csv unchanged, or resumes") {
    const TemporaryFolder folder;
    const Arguments all{"--until",          "0.01",     "--frames", "20", "--range", "auto",
                        "--save-particles", "--fields", "speed"};
    REQUIRE(call(tiny_run(folder, "straight", all)).code == 0);
    const auto some = fs::file_size(folder / "straight/history.csv") * 2 / 3;
    REQUIRE(run_and_kill(tiny_run(folder, "kept", all + Arguments{"--checkpoint-every", "0.004"}),
                         folder / "kept/history.csv", some));
    const Checkpoint whole = read_checkpoint(folder / "kept/checkpoint.bin");
    const auto leave = [&](const auto& damage) {
      fs::remove_all(folder / "out");
      fs::copy(folder / "kept", folder / "out", fs::copy_options::recursive);
      Checkpoint checkpoint = whole;
      damage(checkpoint.state);
      write_checkpoint(folder / "out/checkpoint.bin", checkpoint);
    };
    leave([](std::string& state) { state[sizeof(std::uint64_t)] ^= 1; });  // number of particles
    check_refused(folder, "checkpoint.bin' cannot be used: the saved state is damaged");
    std::uint64_t simulation = 0;  // size of the simulation's state
    std::memcpy(&simulation, whole.state.data(), sizeof simulation);
    std::mt19937 random(18);
    int refused = 0;
    for (int k = 0; k < 24; ++k) {
      const std::size_t from = k % 2 == 0 ? 0 : simulation + sizeof simulation;
      const std::size_t at = from + random() % (whole.state.size() - from - 8);
      const int fill = std::array{0xff, 0x7f, 0x02, 0x40}[random() % 4], length = random() % 2 == 0 ? 4 : 8;
      leave([&](std::string& state) {
        std::fill_n(state.begin() + static_cast<std::ptrdiff_t>(at), length, static_cast<char>(fill));
      });
      CAPTURE(at);
      CAPTURE(fill);
      const std::string history = text_of(folder / "out/history.csv");
      const Outcome outcome = call(resume(folder, "out"));
      CAPTURE(outcome.err);
      CHECK((outcome.code == 0 || outcome.code == 2 || outcome.code == 3));
      if (outcome.code != 2) continue;
      ++refused;
      CHECK(contains(outcome.err, "cannot be used"));
      CHECK(text_of(folder / "out/history.csv") == history);
    }
    CHECK(refused > 0);
    CHECK(refused < 24);
  }

  TEST_CASE("a run with a checkpoint can be drawn with other options only in another folder, and resumes") {
    const TemporaryFolder folder;
    const Arguments all = long_run + Arguments{"--save-particles"};
    REQUIRE(call(tiny_run(folder, "straight", all)).code == 0);
    {
      ChildProgram child(tiny_run(folder, "out", all + with_checkpoints));
      ChildProgram::wait_for(folder / "out/particles/particles_00000.vtp");
      child.send(SIGINT);
      REQUIRE(child.exit_code() == 130);
    }
    const Outcome refused = call({"render", folder.str("out"), "--color", "pressure", "--quiet"});
    CHECK(refused.code == 2);
    CHECK(contains(refused.err, "has a checkpoint, so its frames cannot change"));
    CHECK(call({"render", folder.str("out"), "--color", "pressure", "--quiet", "--out", folder.str("other")})
              .code == 0);
    CHECK(call({"render", folder.str("out"), "--quiet"}).code == 0);
    CHECK(call(resume(folder, "out")).code == 0);
    check_same_run(folder / "straight", folder / "out");
  }

  TEST_CASE("a link in place of history.csv is refused, and its target stays untouched") {
    const TemporaryFolder folder;
    leave_interrupted(folder);
    fs::rename(folder / "out/history.csv", folder / "elsewhere");
    fs::create_symlink(folder / "elsewhere", folder / "out/history.csv");
    const std::string before = text_of(folder / "elsewhere");
    const Outcome outcome = call(resume(folder, "out"));
    CHECK(outcome.code == 4);
    CHECK(contains(outcome.err, "out/history.csv"));
    CHECK(text_of(folder / "elsewhere") == before);
  }

  TEST_CASE("a checkpoint is refused by its format, not by the version that wrote it") {
    const TemporaryFolder folder;
    leave_interrupted(folder);
    const fs::path path = folder / "out/checkpoint.bin";
    const Checkpoint checkpoint = read_checkpoint(path);
    const taut::cli::CheckpointHeader header;
    write_checkpoint(path, checkpoint, {"0.0.1", header.format + 1});
    check_refused(folder, "has format " + std::to_string(header.format + 1) +
                              ", written by taut 0.0.1; taut " + header.version + " reads format " +
                              std::to_string(header.format) +
                              " only; continue with taut 0.0.1, or start again without this file");
    write_checkpoint(path, checkpoint, {"0.0.1", header.format});
    CHECK(read_checkpoint(path).state == checkpoint.state);
    CHECK_FALSE(checkpoint.state.empty());
  }

  TEST_CASE("options beside --resume must equal those of the folder") {
    const TemporaryFolder folder;
    const Arguments all =
        long_run + Arguments{"--save-particles", "--fields", "pressure", "--spacing", "0.0021"};
    REQUIRE(call(tiny_run(folder, "straight", all)).code == 0);
    const auto some = fs::file_size(folder / "straight/history.csv") / 3;
    REQUIRE(run_and_kill(tiny_run(folder, "out", all + with_checkpoints), folder / "out/history.csv", some));
    const std::map<Arguments, std::string> others{{{"--method", "og"}, "method=og"},
                                                  {{"--until", "0.05"}, "until=0.05"},
                                                  {{"--set", "speed=3"}, "speed=3"},
                                                  {{"--out", "x"}, "--out x"},
                                                  {{"--no-render"}, "--no-render"},
                                                  {{"--save-particles"}, "--save-particles"},
                                                  {{"--frames", "3"}, "--frames"},
                                                  {{"--every", "1"}, "--every"},
                                                  {{"--history", "1"}, "--history"},
                                                  {{"--color", "pressure"}, "a drawing option"},
                                                  {{"--checkpoint-every", "1"}, "--checkpoint-every 1"},
                                                  {{write_tiny_scene(folder)}, "SCENE"}};
    for (const auto& [more, name] : others) check_refused(folder, "unchanged; " + name, more);
    const Arguments as_started = tiny_run(folder, "out", all + with_checkpoints);
    const Arguments words(as_started.begin() + 1, as_started.end());
    CHECK(call(Arguments{"run", "--resume", folder.str("out")} + words).code == 0);
    check_same_run(folder / "straight", folder / "out");
  }

  TEST_CASE("a checkpoint contains no state before the end of the first interval") {
    const TemporaryFolder folder;
    std::vector<std::size_t> sizes;
    Watch watch([&] {
      if (fs::exists(folder / "out/checkpoint.bin"))
        sizes.push_back(read_checkpoint(folder / "out/checkpoint.bin").state.size());
    });
    std::ostream err(&watch);
    std::ostringstream out;
    Arguments arguments =
        tiny_run(folder, "out", {"--no-render", "--checkpoint-every", "0.00098", "--set", "cfl=0.02"});
    std::erase(arguments, "--quiet");
    REQUIRE(run_program(commands(), arguments, {out, err}) == 0);
    REQUIRE(sizes.size() >= 3);
    CHECK(sizes[0] == 0);
    CHECK(sizes[1] == 0);
    CHECK(sizes[2] > 0);
  }

  TEST_CASE("a run needs a scene or a folder") {
    const Outcome outcome = call({"run"});
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "SCENE is required"));
  }
}
