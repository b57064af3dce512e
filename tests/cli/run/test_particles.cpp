#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>

#include <doctest/doctest.h>

#include "cli/run/particle_file.hpp"
#include "cli/run/zlib_blocks.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"
#include "tests/support/program_runner.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

/// Particles with numbers that have no short form.
Snapshot some_particles(int dim, std::size_t count) {
  Snapshot now;
  now.dim = dim;
  now.time = 1.0 / 3;
  for (std::size_t k = 0; k < count * static_cast<std::size_t>(dim); ++k) {
    now.x0.push_back(0);
    now.x.push_back(std::sin(static_cast<double>(k)));
    now.v.push_back(std::exp(-static_cast<double>(k)));
  }
  now.m.assign(count, 1.0);
  now.p.assign(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    now.rho.push_back(1000 + std::sqrt(static_cast<double>(i)));
    now.diameter.push_back(0.1 + static_cast<double>(i));
    now.body.push_back(static_cast<int>(i % 3));
    now.material.push_back(static_cast<int>(i % 2));
    now.held.push_back(i % 5 == 0);
  }
  return now;
}

fs::path write_particles(const TemporaryFolder& folder, const Snapshot& now,
                         const std::vector<const Field*>& fields) {
  std::ofstream(folder / "particles.vtp", std::ios::binary) << particle_file_text(now, fields);
  return folder / "particles.vtp";
}

std::string packed(const std::vector<double>& values) {
  return to_zlib_blocks(std::as_bytes(std::span(values)));
}

bool unpacks(std::string_view text, std::vector<double>& values) {
  return from_zlib_blocks(text, std::as_writable_bytes(std::span(values)));
}

/// The pictures of both folders have the same names and the same bytes.
void check_same_files(const fs::path& a, const fs::path& b) {
  REQUIRE(files_in(a) > 0);
  CHECK(files_in(a) == files_in(b));
  for (const auto& file : fs::directory_iterator(a)) {
    CAPTURE(file.path().string());
    const bool same = text_of(file.path()) == text_of(b / file.path().filename());
    CHECK(same);
  }
}

/// What tests/cli/run/read_vtp.py prints, by name; empty where there is no VTK.
std::map<std::string, double> read_with_vtk(const fs::path& file) {
  const std::string command =
      "/usr/bin/python3 " TAUT_SOURCE_DIR "/tests/cli/run/read_vtp.py " + file.string() + " 2>&1";
  std::map<std::string, double> values;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  REQUIRE(pipe);
  char name[64];
  double value = 0;
  while (std::fscanf(pipe, "%63s %lf", name, &value) == 2) values[name] = value;
  ::pclose(pipe);
  return values;
}

bool vtk_is_there() { return std::system("/usr/bin/python3 -c 'import vtk' 2>/dev/null") == 0; }

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("compressed blocks unpack to the same bytes and to nothing else") {
    for (const std::size_t count : {0, 1, 8191, 8192, 8193, 30000}) {  // a block holds 8192 doubles
      CAPTURE(count);
      std::vector<double> values(count), back(count), longer(count + 1);
      for (std::size_t k = 0; k < count; ++k) values[k] = std::sin(static_cast<double>(k));
      const std::string text = packed(values);
      CHECK(unpacks(text, back));
      CHECK(back == values);
      CHECK_FALSE(unpacks(text, longer));
      if (count > 0) CHECK_FALSE(unpacks(text.substr(0, text.size() - 1), back));
      std::string forged = text;
      forged[7] = '\x7f';  // 2^62 blocks
      CHECK_FALSE(unpacks(forged, back));
    }
  }

  TEST_CASE("particles are read back bit by bit") {
    const TemporaryFolder folder;
    for (const int dim : {2, 3}) {
      Snapshot now = some_particles(dim, 3000);
      now.rho[7] = std::numeric_limits<double>::quiet_NaN();
      const ParticleFile file(write_particles(folder, now, {find_field("density"), find_field("speed")}));
      CHECK(file.time() == now.time);
      CHECK(file.size() == 3000);
      CHECK(file.positions(dim) == now.x);
      CHECK(file.diameter() == now.diameter);
      CHECK(file.fields() == std::vector<std::string>{"density", "speed", "body", "material"});
      CHECK(file.field("speed") == evaluate(*find_field("speed"), now));
      CHECK(file.field("body") == evaluate(*find_field("body"), now));
      CHECK(file.field("material") == evaluate(*find_field("material"), now));
      const std::vector<double> density = file.field("density");
      CHECK(std::memcmp(density.data(), now.rho.data(), 8 * density.size()) == 0);
      CHECK_THROWS_WITH_AS(file.field("pressure"),
                           (folder.str("particles.vtp") +
                            " does not hold the field pressure; it holds density, speed, body, material")
                               .c_str(),
                           UsageError);
    }
  }

  TEST_CASE("a particle file with a head that does not fit what it holds is refused") {
    const TemporaryFolder folder;
    const fs::path path = write_particles(folder, some_particles(2, 50), {find_field("speed")});
    const std::string whole = text_of(path);
    for (const auto& [was, is] : std::initializer_list<std::pair<const char*, const char*>>{
             {"NumberOfPoints=\"50\"", "NumberOfPoints=\"51\""},
             {"NumberOfPoints=\"50\"", "NumberOfPoints=\"6148914691236517206\""},
             {"NumberOfPoints=\"50\"", "NumberOfPoints=\"-3\""},
             {"NumberOfPoints=\"50\"", "NumberOfPoints=\"0\""},
             {"Name=\"Points\" NumberOfComponents=\"3\"", "Name=\"Points\" NumberOfComponents=\"1\""},
             {"Name=\"Points\" NumberOfComponents=\"3\"", "Name=\"Points\" NumberOfComponents=\"9\""},
             {"offset=\"0\"", "offset=\"18446744073709551000\""},
             {"format=\"ascii\">", "format=\"ascii\">nan</DataArray><x>"},
             {"\"Float64\" Name=\"speed\"", "\"Float32\" Name=\"speed\""}}) {
      const auto& is_now = is;  // clang captures no bindings
      CAPTURE(is_now);
      std::string forged = whole;
      const std::size_t at = forged.find(was);
      REQUIRE(at != std::string::npos);
      std::ofstream(path, std::ios::binary) << forged.replace(at, std::strlen(was), is);
      const auto read_all = [&] {
        const ParticleFile file(path);
        file.field("speed");
        file.diameter();
        file.positions(2);
      };
      CHECK_THROWS_AS(read_all(), UsageError);
    }
  }

  TEST_CASE("a particle file that is cut short is refused wherever it ends") {
    const TemporaryFolder folder;
    const fs::path path = write_particles(folder, some_particles(2, 50), {find_field("speed")});
    const std::string whole = text_of(path);
    const std::size_t end = whole.find("\n</AppendedData>");
    const auto read_all = [&] {
      const ParticleFile file(path);
      file.field("speed");
      file.diameter();
      file.positions(2);
    };
    CHECK_NOTHROW(read_all());
    // the vertices, of some 150 bytes, come last and are for ParaView only
    for (std::size_t length = 0; length + 400 < end; length += 41) {
      std::ofstream(path, std::ios::binary) << whole.substr(0, length);
      CAPTURE(length);
      CHECK_THROWS_AS(read_all(), UsageError);
    }
  }
}

TEST_SUITE("cli") {
  TEST_CASE("a run saves its particles at the times of the frames, with an index") {
    const TemporaryFolder folder;
    const Outcome outcome = call(tiny_run(folder, "out", {"--save-particles", "--no-render"}));
    REQUIRE(outcome.code == 0);
    CHECK(contains(outcome.out, "particles.pvd"));
    CHECK(files_in(folder / "out/particles") == 6);
    const std::string index = text_of(folder / "out/particles/particles.pvd");
    for (int k = 0; k <= 4; ++k) {
      const std::string name = "particles_0000" + std::to_string(k) + ".vtp";
      const ParticleFile file(folder / ("out/particles/" + name));
      CHECK(file.time() == 0.002 * k / 4);
      CHECK(contains(index, "timestep=\"" + exact(file.time()) + "\" part=\"0\" file=\"" + name + "\""));
      CHECK(static_cast<long>(file.fields().size()) == static_cast<long>(fields(2).size()));
    }
    CHECK(json_of(folder / "out/run.json")["reached"].get<double>() > 0.002);  // a whole step past the end
    REQUIRE(call(tiny_run(folder, "out", {"--no-render"})).code == 0);
    CHECK_FALSE(fs::exists(folder / "out/particles"));  // those of the older run
  }

  TEST_CASE("particles that are saved more often than there are steps are each at a time of their own") {
    const TemporaryFolder folder;
    const std::vector<std::string> all{"--save-particles", "--no-render", "--fields", "speed",
                                       "--until",          "1e-4"};
    const auto run = [&](const std::string& name, int frames) {
      std::vector<std::string> more = all;
      more.insert(more.end(), {"--frames", std::to_string(frames)});
      REQUIRE(call(tiny_run(folder, name, more)).code == 0);
      return text_of(folder / (name + "/history.csv"));
    };
    CHECK(run("often", 100) == run("seldom", 1));
    CHECK(json_of(folder / "often/run.json")["steps"].get<int>() < 50);
    const auto leftmost = [&](const ParticleFile& file) {  // flies on undisturbed at 2 m/s
      return std::ranges::min(file.positions(2));
    };
    const auto saved = [&](int k) {
      return ParticleFile(folder / ("often/particles/" + numbered("particles", k, "vtp")));
    };
    for (int k = 0; k <= 100; ++k) {
      CHECK(saved(k).time() == 1e-4 * k / 100);
      CHECK(leftmost(saved(k)) - leftmost(saved(0)) == doctest::Approx(2e-6 * k).epsilon(1e-9));
    }
  }

  TEST_CASE("saving particles does not alter a run, and only the fields asked for are saved") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "with", {"--save-particles", "--fields", "speed,pressure"})).code == 0);
    REQUIRE(call(tiny_run(folder, "without")).code == 0);
    CHECK(text_of(folder / "with/history.csv") == text_of(folder / "without/history.csv"));
    check_same_files(folder / "with/frames", folder / "without/frames");
    CHECK(ParticleFile(folder / "with/particles/particles_00000.vtp").fields() ==
          std::vector<std::string>{"speed", "pressure", "body", "material"});
    const Outcome outcome = call({"render", folder.str("with"), "--color", "density", "--quiet"});
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "speed, pressure"));
    check_same_files(folder / "with/frames", folder / "without/frames");  // the old frames are still there
  }

  TEST_CASE("particles can be drawn without the frames of the run, and not without particles") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "plain")).code == 0);
    const Outcome outcome = call({"render", folder.str("plain")});
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "--save-particles"));
    CHECK(call({"render", folder.path()}).code == 2);

    REQUIRE(call(tiny_run(folder, "saved", {"--no-render", "--save-particles"})).code == 0);
    REQUIRE(call({"render", folder.str("saved"), "--out", folder.str("pictures"), "--quiet"}).code == 0);
    check_same_files(folder / "plain/frames", folder / "pictures");
    CHECK(files_in(folder / "saved/frames") == 0);
    std::ofstream(folder / "pictures/mine.png") << "mine";
    CHECK(call({"render", folder.str("saved"), "--out", folder.str("pictures"), "--quiet"}).code == 2);
    CHECK(files_in(folder / "pictures") == 6);
  }

  TEST_CASE("a view of one's own is what the frames show") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "whole")).code == 0);
    REQUIRE(call(tiny_run(folder, "close", {"--view", "-0.02:0:-0.01:0.01"})).code == 0);
    CHECK(contains(text_of(folder / "close/scene.toml"), "view = [-0.02, 0.0, -0.01, 0.01]"));
    CHECK(call({"diff", folder.str("whole"), folder.str("close")}).code == 1);
  }

  TEST_CASE("colours by body and by an expression are the same drawn at once and from the saved particles") {
    const TemporaryFolder folder;
    for (const std::string color : {"body", "J", "=speed^2/2 + 1e3*(x - X) + t/dp"}) {
      CAPTURE(color);
      REQUIRE(call(tiny_run(folder, "out", {"--save-particles", "--color", color})).code == 0);
      REQUIRE(call({"render", folder.str("out"), "--out", folder.str("again"), "--quiet"}).code == 0);
      check_same_files(folder / "out/frames", folder / "again");
      CHECK(contains(text_of(folder / "out/scene.toml"), "color = \"" + color + "\""));
      REQUIRE(call({"run", folder.str("out/scene.toml"), "--out", folder.str("third"), "--quiet"}).code == 0);
      check_same_files(folder / "out/frames", folder / "third/frames");
    }
    const Outcome unknown = call(tiny_run(folder, "out", {"--color", "=sped + 1"}));
    CHECK(unknown.code == 2);
    CHECK(contains(unknown.err, "unknown name 'sped' in 'sped + 1' (did you mean 'speed'?)"));
    REQUIRE(call(tiny_run(folder, "out", {"--save-particles", "--fields", "speed", "--no-render"})).code ==
            0);
    const Outcome missing = call({"render", folder.str("out"), "--color", "=density"});
    CHECK(missing.code == 2);
    CHECK(contains(missing.err, "does not hold the field density; it holds speed, body, material"));
    const Outcome both = call(tiny_run(folder, "out", {"--color", "body", "--range", "0:1"}));
    CHECK(both.code == 2);
    CHECK(contains(both.err, "color = \"body\" has a colour for each"));
    CHECK(call(tiny_run(folder, "out", {"--style", "cells", "--glyph", "0.5"})).code == 2);
  }

  TEST_CASE("VTK reads a particle file as it was written") {
    if (!vtk_is_there()) {
      MESSAGE("skipped: there is no VTK for Python (Debian's package python3-vtk9)");
      return;
    }
    const TemporaryFolder folder;
    const Snapshot now = some_particles(2, 9000);  // more than a block
    const fs::path path = write_particles(folder, now, {find_field("density"), find_field("speed")});
    const auto sum = [](const std::vector<double>& values, std::size_t from = 0, std::size_t step = 1) {
      double total = 0;
      for (std::size_t k = from; k < values.size(); k += step) total += values[k];
      return total;
    };
    std::map<std::string, double> read = read_with_vtk(path);
    CHECK(read["points"] == 9000);
    CHECK(read["vertices"] == 9000);
    CHECK(read["last_vertex"] == 8999);
    CHECK(read["time"] == now.time);
    CHECK(read["x"] == doctest::Approx(sum(now.x, 0, 2)));
    CHECK(read["y"] == doctest::Approx(sum(now.x, 1, 2)));
    CHECK(read.at("z") == 0);
    CHECK(read["density"] == doctest::Approx(sum(now.rho)));
    CHECK(read["speed"] == doctest::Approx(sum(evaluate(*find_field("speed"), now))));
    CHECK(read["diameter"] == doctest::Approx(sum(now.diameter)));
    CHECK(read["body"] == 9000);
    CHECK(read["material"] == 4500);
    CHECK(read["held"] == 1800);
    CHECK(read["vectors"] == doctest::Approx(sum(now.v)));
  }
}

TEST_SUITE("determinism") {
  TEST_CASE("drawn again a run leaves the bytes that it would have left with those options") {
    const std::vector<std::vector<std::string>> cases{
        {},
        {"--color", "pressure"},  // range over the whole sequence
        {"--color", "displacement_x", "--range", "-1e-3:1e-3", "--colormap", "rainbow"},
        {"--view", "-0.02:0:-0.01:0.01", "--size", "300x200"},
        {"--view", "auto", "--range", "auto"},
    };
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "saved", {"--save-particles"})).code == 0);
    for (const std::vector<std::string>& options : cases) {
      CAPTURE(options.size());
      fs::remove_all(folder / "again");
      fs::copy(folder / "saved", folder / "again", fs::copy_options::recursive);
      std::vector<std::string> render{"render", folder.str("again"), "--quiet"};
      render.insert(render.end(), options.begin(), options.end());
      REQUIRE(call(render).code == 0);
      REQUIRE(call(tiny_run(folder, "direct", options)).code == 0);
      check_same_files(folder / "again/frames", folder / "direct/frames");
      CHECK(text_of(folder / "again/scene.toml") == text_of(folder / "direct/scene.toml"));
    }
  }
}
