#include <doctest/doctest.h>

#include "cli/formats/particle_file.hpp"
#include "tests/support/program_runner.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

using Arguments = std::vector<std::string>;

Outcome run_with(const TemporaryFolder& folder, const std::string& out, Arguments more) {
  more.insert(more.end(), {"--no-render", "--frames", "2"});
  return call(tiny_run(folder, out, more));
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("particles are saved as vtp by default, else in the requested format") {
    const TemporaryFolder folder;
    for (const Arguments& vtp : {Arguments{"--save-particles"}, {"--save-particles", "vtp"}}) {
      const Outcome outcome = run_with(folder, "out", vtp);
      CHECK(outcome.code == 0);
      CHECK(contains(outcome.out, "particles/particles.pvd"));
      CHECK(files_in(folder / "out/particles") == 4);
    }
    for (const std::string format : {"xyz", "csv"})
      for (const Arguments& words : {Arguments{"--save-particles", format}, {"--save-particles=" + format}}) {
        CAPTURE(format);
        const Outcome outcome = run_with(folder, "out", words);
        CHECK(outcome.code == 0);
        CHECK(contains(outcome.out, "particles/particles_00000." + format));
        CHECK(files_in(folder / "out/particles") == 3);
        CHECK(fs::exists(folder / ("out/particles/particles_00002." + format)));
      }
    const std::string scene = write_tiny_scene(folder);
    CHECK(call({"run", "--save-particles", scene, "--out", folder.str("first"), "--until", "1e-5", "--quiet"})
              .code == 0);
    CHECK(fs::exists(folder / "first/particles/particles.pvd"));
  }

  TEST_CASE("render and compare refuse particles in a format that taut does not read") {
    const TemporaryFolder folder;
    for (const std::string format : {"xyz", "csv"}) {
      REQUIRE(run_with(folder, "out", {"--save-particles", format}).code == 0);
      for (const Arguments& command : {Arguments{"render", folder.str("out")},
                                       {"compare", folder.str("out"), "--out", folder.str("a.png")}}) {
        const Outcome outcome = call(command);
        CAPTURE(outcome.err);
        CHECK(outcome.code == 2);
        CHECK(contains(outcome.err, "contains particles as ." + format +
                                        " files, which other programs read and taut does not"));
        CHECK(contains(outcome.err, "--save-particles --out"));
      }
    }
  }

  TEST_CASE("an unknown format or precision of particles is refused with the nearest name") {
    const TemporaryFolder folder;
    const auto check = [&](const Arguments& words, const std::string& message) {
      const Outcome outcome = run_with(folder, "out", words);
      CAPTURE(outcome.err);
      CHECK(outcome.code == 2);
      CHECK(contains(outcome.err, message));
      CHECK_FALSE(fs::exists(folder / "out"));
    };
    check({"--save-particles", "xzy"}, "unknown value of --save-particles 'xzy' (did you mean 'xyz'?)");
    check({"--save-particles=vtk"}, "unknown value of --save-particles 'vtk' (did you mean 'vtp'?)");
    check({"--save-particles", "--particle-precision", "singel"},
          "unknown --particle-precision 'singel' (did you mean 'single'?)");
    check({"--particle-precision", "single"}, "--save-particles");
  }

  TEST_CASE("particles of single precision take less than two thirds of the bytes and can be drawn") {
    const TemporaryFolder folder;
    REQUIRE(run_with(folder, "double", {"--save-particles", "--particle-precision", "double"}).code == 0);
    REQUIRE(run_with(folder, "single", {"--save-particles", "--particle-precision", "single"}).code == 0);
    const auto bytes = [&](const char* out) {
      return static_cast<double>(fs::file_size(folder / out / "particles/particles_00002.vtp"));
    };
    CHECK(bytes("single") < 0.65 * bytes("double"));
    CHECK(text_of(folder / "single/history.csv") == text_of(folder / "double/history.csv"));
    CHECK(call({"render", folder.str("single"), "--quiet"}).code == 0);
    CHECK(files_in(folder / "single/frames") == 3);
  }

  TEST_CASE("a resumed run keeps the format and precision of its particles") {
    const TemporaryFolder folder;
    const Arguments form{"--save-particles", "csv", "--particle-precision", "single", "--no-render"};
    const auto with = [&](Arguments more) {
      more.insert(more.end(), form.begin(), form.end());
      return more;
    };
    REQUIRE(call(tiny_run(folder, "straight", with({"--until", "0.004", "--frames", "8"}))).code == 0);
    REQUIRE(call(tiny_run(folder, "out", with({"--frames", "4", "--keep-checkpoint"}))).code == 0);
    const Arguments on{"run", "--resume", folder.str("out"), "--until", "0.004", "--quiet"};
    Arguments other_format = on;
    other_format.insert(other_format.end(), {"--save-particles", "xyz"});
    const Outcome other = call(other_format);
    CHECK(other.code == 2);
    CHECK(contains(other.err, "--save-particles would change it"));
    const Outcome outcome = call(on);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(files_in(folder / "out/particles") == 9);
    for (const char* file : {"particles/particles_00003.csv", "particles/particles_00008.csv"})
      CHECK(text_of(folder / "out" / file) == text_of(folder / "straight" / file));
    fs::remove(folder / "out/particles/particles_00001.csv");
    const Outcome lost = call({"run", "--resume", folder.str("out"), "--until", "0.005", "--quiet"});
    CHECK(lost.code == 2);
    CHECK(contains(lost.err, "particles_00001.csv' is missing"));
  }
}
