#include <algorithm>
#include <cstdlib>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "cli/sweep/emit.hpp"
#include "engine/core/machine.hpp"
#include "tests/support/sweep_folder.hpp"

using namespace taut::cli;
using namespace taut::test;

namespace {

int shell(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()); }

const std::string strange =
    "-a b {} {#} {= `touch ran`; =} $(touch ran) `touch ran` 'q' \"r\" \\ %d @x # ;[y]\n"
    "#SBATCH -z\ntouch ran";

/// Writes a substitute for GNU parallel that replaces {} and {#}. A word with {= runs `touch ran`.
void write_parallel(const TemporaryFolder& folder) {
  fs::create_directories(folder / "bin");
  std::ofstream(folder / "bin/parallel") << R"(#!/bin/sh
printf '%s\n' "$@" >>)" + folder.str("calls") + R"(
while [ "$1" != -q ]; do shift; done
shift
while read -r n; do (
  for word; do
    shift
    case $word in *'{='*) touch ran ;; esac
    for gap in '{}' '{#}'; do
      while case $word in *"$gap"*) ;; *) false ;; esac; do word=${word%%"$gap"*}$n${word#*"$gap"}; done
    done
    set -- "$@" "$word"
  done
  exec "$@"
); done
)";
  fs::permissions(folder / "bin/parallel", fs::perms::owner_all);
}

std::string emitted(const TemporaryFolder& folder, const std::string& kind, const Texts& grid) {
  Texts arguments = tiny_sweep(folder, "out", grid);
  arguments.insert(arguments.end(), {"--emit", kind});
  REQUIRE(program(arguments).code == 0);
  return folder.str("out/sweep." + kind);
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a Slurm array does the runs in any order, and a sweep after it collects the results") {
    const TemporaryFolder folder;
    const Texts grid{"--grid", "speed=1,2",   "--grid",  "cfl=0.5,20",
                     "--grid", "pull=0*pi,1", "--until", "0.02"};
    const std::string script = emitted(folder, "slurm", grid);
    CHECK(contains(text_of(script), "\n#SBATCH --array=0-7\n"));
    const auto task = [&](int index) {
      return shell("cd / && SLURM_ARRAY_TASK_ID=" + std::to_string(index) + " sh " + script);
    };
    for (const int index : {5, 0, 7, 2, 6, 1, 3}) CHECK(task(index) == 0);
    CHECK(task(8) != 0);
    CHECK_FALSE(fs::exists(folder / "out/results.csv"));
    const auto before = ends(folder / "out");
    CHECK(before.size() == 4 - 1);
    REQUIRE(program(tiny_sweep(folder, "out", grid)).code == 0);
    for (const auto& [run, time] : before) CHECK(ends(folder / "out").at(run) == time);
    REQUIRE(program(tiny_sweep(folder, "direct", grid)).code == 0);
    CHECK(results(folder / "out") == results(folder / "direct"));
    CHECK(statuses(folder / "out")[2] == "failed");
  }

  TEST_CASE("an emitted script saves particles in the requested format") {
    const TemporaryFolder folder;
    const Texts grid{"--grid", "speed=1", "--until", "1e-5", "--frames", "1", "--save-particles"};
    REQUIRE(shell("SLURM_ARRAY_TASK_ID=0 sh " + emitted(folder, "slurm", grid)) == 0);
    CHECK(fs::exists(folder / "out/speed=1/particles/particles.pvd"));
    Texts in_columns = grid;
    in_columns.emplace_back("csv");
    REQUIRE(shell("SLURM_ARRAY_TASK_ID=0 sh " + emitted(folder, "slurm", in_columns)) == 0);
    CHECK(fs::exists(folder / "out/speed=1/particles/particles_00001.csv"));
  }

  TEST_CASE("the script for GNU parallel does the runs and collects the results") {
    const TemporaryFolder folder;
    const Texts grid{"--grid", "speed=max(1,2),3", "--threads", "2"};
    const std::string script = emitted(folder, "parallel", grid);
    write_parallel(folder);
    CHECK(shell("cd / && PATH=" + folder.str("bin") + ":$PATH sh " + script + " --bar") == 0);
    CHECK(contains(text_of(folder / "calls"), "\n--bar\n-q\n"));
    CHECK(statuses(folder / "out") == Texts{"finished", "finished"});
    CHECK(json_of(folder / "out/results.json")["runs"][1]["threads"] == 2);
  }

  TEST_CASE("scripts for a sweep with repetitions use at most one thread per physical core") {
    const TemporaryFolder folder;
    write_parallel(folder);
    const auto write = [&](const char* name, const char* output) {
      std::ofstream(folder / "bin" / name) << "#!/bin/sh\nprintf '" << output << "'\n";
      fs::permissions(folder / "bin" / name, fs::perms::owner_all);
    };
    const auto write_cores = [&](int cpus_of_core) {
      std::string list = "# CPU,Core,Socket\\n";
      for (int cpu = 0; cpu < 2048; ++cpu) list += fmt::format("{},{},0\\n", cpu, cpu / cpus_of_core);
      write("lscpu", list.c_str());
    };
    write_cores(1024);
    Texts grid{"--grid", "speed=1", "--until", "1e-5"};
    const auto jobs = [&](const char* allowed) {
      write("nproc", allowed);
      fs::remove(folder / "calls");
      REQUIRE(shell("PATH=" + folder.str("bin") + ":$PATH sh " + emitted(folder, "parallel", grid)) == 0);
      return text_of(folder / "calls").substr(0, std::string("--jobs\n4\n").size());
    };
    CHECK(jobs("4\\n") == "--jobs\n4\n");
    CHECK_FALSE(contains(text_of(emitted(folder, "slurm", grid)), "--hint"));
    grid.insert(grid.end(), {"--repeat", "2"});
    CHECK(jobs("4\\n") == "--jobs\n1\n");
    write_cores(1);
    CHECK(jobs("4\\n") == fmt::format("--jobs\n{}\n", std::min(4, taut::cores())));
    CHECK(jobs("1\\n") == "--jobs\n1\n");
    CHECK(contains(text_of(emitted(folder, "slurm", grid)), "\n#SBATCH --hint=nomultithread\n# "));
  }

  TEST_CASE("emitted scripts start only their runs, also if names contain special characters") {
    const TemporaryFolder folder;
    write_parallel(folder);
    const fs::path here = folder / strange, sweep = here / strange;
    fs::create_directories(here);
    fs::copy_file(write_tiny_scene(folder), here / "-x {}.toml");
    const auto emitted_and_run = [&](const std::string& kind, const std::string& environment) {
      fs::remove_all(sweep);
      const Outcome outcome = program(
          {"sweep", "--grid=speed=1,2", "--out=" + strange, "--emit=" + kind, "--", "-x {}.toml"}, here);
      CAPTURE(outcome.err);
      REQUIRE(outcome.code == 0);
      const std::string script = shell_word((sweep / ("sweep." + kind)).string());
      CHECK(shell("cd " + shell_word(folder.path().string()) + " && " + environment + " sh " + script) == 0);
      for (const fs::path& place : {folder.path(), here, sweep}) CHECK_FALSE(fs::exists(place / "ran"));
    };
    emitted_and_run("slurm", "SLURM_ARRAY_TASK_ID=1");
    CHECK(ends(sweep).count("speed=2") == 1);
    emitted_and_run("parallel", "PATH=\"$PWD/bin:$PATH\"");
    CHECK(statuses(sweep) == Texts{"finished", "finished"});
    CHECK_FALSE(contains(text_of(folder / "calls"), strange));
    if (shell("parallel --version") != 0) {
      MESSAGE(
          "skipped: only a substitute ran the script; there is no GNU parallel (Debian's package parallel)");
      return;
    }
    emitted_and_run("parallel", "");
    CHECK(statuses(sweep) == Texts{"finished", "finished"});
  }

  TEST_CASE("without --out a script goes to stdout, and nothing runs") {
    const TemporaryFolder folder;
    const Outcome outcome =
        program({"sweep", write_tiny_scene(folder), "--grid", "speed=1,2,3", "--emit", "slurm", "--quiet"});
    CHECK(outcome.code == 0);
    CHECK(outcome.out.starts_with("#!/bin/sh\n"));
    CHECK(contains(outcome.out, " --grid=speed=1,2,3 "));
    CHECK_FALSE(contains(outcome.out, "--emit"));
    CHECK_FALSE(fs::exists("out/discs-sweep"));
  }
}

TEST_SUITE("unit") {
  TEST_CASE("a script quotes special characters of the shell") {
    const std::string script = taut::cli::emit_script(taut::cli::find_emit_form("slurm"), "two\nlines", 3, 4,
                                                      false, {"taut", "a b", "it's", "x=1,2:3"});
    CHECK(contains(script, "exec taut 'a b' 'it'\\''s' x=1,2:3 --index"));
    CHECK(contains(script, "# two lines: 3 runs"));
    CHECK(contains(script, "--cpus-per-task=4\n"));
    CHECK_FALSE(contains(script, "@"));
  }
}
