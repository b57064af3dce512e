#include <cmath>
#include <cstring>
#include <limits>
#include <sys/resource.h>

#include <doctest/doctest.h>

#include "cli/formats/particle_file.hpp"
#include "cli/formats/zlib_blocks.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"
#include "tests/support/files.hpp"
#include "tests/support/relative.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

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
    now.clamped.push_back(i % 5 == 0);
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

/// Limits the memory of the process.
class MemoryLimit {
 public:
  explicit MemoryLimit(std::size_t bytes) {
    ::getrlimit(RLIMIT_DATA, &old_);
    const rlimit less{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_DATA, &less);
  }
  ~MemoryLimit() { ::setrlimit(RLIMIT_DATA, &old_); }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  rlimit old_{};
};

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("compressed blocks unpack to the same bytes, and only to their own length") {
    for (const std::size_t count : {0, 1, 8191, 8192, 8193, 30000}) {  // 8192 doubles per block
      CAPTURE(count);
      std::vector<double> values(count), back(count), longer(count + 1);
      for (std::size_t k = 0; k < count; ++k) values[k] = std::sin(static_cast<double>(k));
      const std::string text = packed(values);
      CHECK(unpacks(text, back));
      CHECK(back == values);
      CHECK_FALSE(unpacks(text, longer));
      if (count > 0) CHECK_FALSE(unpacks(text.substr(0, text.size() - 1), back));
      std::string forged = text;
      forged[7] = '\x7f';  // about 2^63 blocks
      CHECK_FALSE(unpacks(forged, back));
    }
  }

  TEST_CASE("particles are read back bit for bit") {
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
      CHECK_THROWS_WITH_AS(
          file.field("pressure"),
          (folder.str("particles.vtp") +
           " does not contain the field pressure; it contains density, speed, body, material")
              .c_str(),
          UsageError);
    }
  }

  TEST_CASE("a particle file whose header contradicts its contents is refused") {
    const TemporaryFolder folder;
    const fs::path path = write_particles(folder, some_particles(2, 50), {find_field("speed")});
    const std::string whole = text_of(path);
    for (const auto& [was, is] : std::initializer_list<std::pair<const char*, const char*>>{
             {"NumberOfPoints=\"50\"", "NumberOfPoints=\"51\""},
             {"NumberOfPoints=\"50\"", "NumberOfPoints=\"6148914691236517206\""},
             {"NumberOfPoints=\"50\"", "NumberOfPoints=\"-3\""},
             {"NumberOfPoints=\"50\"", "NumberOfPoints=\"0\""},
             {"NumberOfPoints=\"50\"", "NumberOfPoints=\"20000001\""},
             {"Name=\"Points\" NumberOfComponents=\"3\"", "Name=\"Points\" NumberOfComponents=\"1\""},
             {"Name=\"Points\" NumberOfComponents=\"3\"", "Name=\"Points\" NumberOfComponents=\"9\""},
             {"offset=\"0\"", "offset=\"18446744073709551000\""},
             {"format=\"ascii\">", "format=\"ascii\">nan</DataArray><x>"},
             {"\"Float64\" Name=\"speed\"", "\"Float32\" Name=\"speed\""}}) {
      const auto& is_now = is;
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

  TEST_CASE(
      "a particle file that declares more particles than a scene allows or its bytes can hold is refused") {
    const TemporaryFolder folder;
    const fs::path path = write_particles(folder, some_particles(2, 50), {find_field("speed")});
    const auto claim = [&](const std::string& count) {
      std::string forged = text_of(path);
      forged.replace(forged.find("\"50\""), 4, "\"" + count + "\"");
      std::ofstream(folder / "forged.vtp", std::ios::binary) << forged << std::string(56000, '\0');
      return folder / "forged.vtp";
    };
    CHECK_THROWS_WITH_AS(
        ParticleFile(claim("20000001")),
        (folder.str("forged.vtp") + " declares 20000001 particles; at most 20 million are allowed").c_str(),
        UsageError);
    const ParticleFile file(claim("20000000"));
    const MemoryLimit limit(std::size_t{256} << 20);  // the positions alone would take 480 MB
    CHECK_THROWS_AS(file.positions(2), UsageError);
  }

  TEST_CASE("a particle file cut short within the data that taut reads is refused") {
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
    // the vertices at the end are for ParaView only
    for (std::size_t length = 0; length + 400 < end; length += 41) {
      std::ofstream(path, std::ios::binary) << whole.substr(0, length);
      CAPTURE(length);
      CHECK_THROWS_AS(read_all(), UsageError);
    }
  }

  TEST_CASE("a particle file of format 1 is still read") {
    const ParticleFile file(TAUT_SOURCE_DIR "/tests/cli/formats/format_1.vtp");
    CHECK(file.time() == 0);
    CHECK(file.size() == 32);
    CHECK(file.fields() == std::vector<std::string>{"speed", "pressure", "body", "material"});
    CHECK(file.field("speed") == std::vector<double>(32, 2.0));
    CHECK(file.field("pressure") == std::vector<double>(32, 0.0));
    for (const double x : file.positions(2)) CHECK(std::abs(x) < 0.021);
    for (const double diameter : file.diameter()) CHECK(diameter == relative(0.004));
  }
}
