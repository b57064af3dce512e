#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

#include <doctest/doctest.h>

#include "cli/formats/particle_arrays.hpp"
#include "cli/formats/particle_file.hpp"
#include "cli/formats/particle_format.hpp"
#include "cli/text/format.hpp"
#include "tests/support/files.hpp"
#include "tests/support/relative.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

using Numbers = std::vector<double>;

/// 3 particles along each axis after x = F X, with different stresses.
Snapshot deformed_lattice(int dim, const LinearMap& F) {
  Snapshot now;
  now.resize(dim, dim == 3 ? 27 : 9);
  now.time = 1.0 / 3;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const auto at = [i](std::size_t axis) {
      return 0.1 * static_cast<double>(i / (axis == 0 ? 1 : axis == 1 ? 3 : 9) % 3);
    };
    const auto d = static_cast<std::size_t>(dim);
    for (std::size_t k = 0; k < d; ++k) {
      now.x0[d * i + k] = at(k);
      now.v[d * i + k] = std::exp(-static_cast<double>(d * i + k));
      for (std::size_t l = 0; l < d; ++l) now.x[d * i + k] += F[3 * k + l] * at(l);
    }
    const double number = static_cast<double>(i) + 1;
    now.m[i] = 0.5 + number;
    now.rho[i] = 1000 * std::sqrt(number);
    now.p[i] = std::sin(number);
    now.diameter[i] = 0.1;
    now.set_deviator(i, {number, 2 * number, -3 * number, 4 * number, dim == 3 ? 5 * number : 0,
                         dim == 3 ? 6 * number : 0});
    now.body[i] = static_cast<int>(i % 3);
    now.material[i] = static_cast<int>(i % 2);
    now.clamped[i] = i % 5 == 0;
  }
  return now;
}

constexpr LinearMap sheared{1.2, 0.3, 0.1, 0, 0.9, 0.2, 0, 0, 1.1};

std::vector<const Field*> all_fields(int dim) {
  std::vector<const Field*> all;
  for (const Field& field : fields(dim)) all.push_back(&field);
  return all;
}

Numbers values_of(std::string_view key, const Snapshot& now) { return evaluate(*find_field(key), now); }

Numbers numbers_in(std::string text) {
  std::ranges::replace(text, ',', ' ');
  std::istringstream words(text);
  Numbers numbers;
  for (std::string word; words >> word;) numbers.push_back(std::strtod(word.c_str(), nullptr));
  return numbers;
}

/// Components of one array, particle after particle.
Numbers interleaved(const std::vector<Numbers>& columns) {
  Numbers all;
  for (std::size_t i = 0; i < columns.front().size(); ++i)
    for (const Numbers& column : columns) all.push_back(column[i]);
  return all;
}

Numbers as_float(const Numbers& values) {
  Numbers rounded;
  for (const double value : values) rounded.push_back(static_cast<float>(value));
  return rounded;
}

fs::path write(const TemporaryFolder& folder, const Snapshot& now, ParticleForm form,
               const std::vector<const Field*>& fields) {
  const fs::path path = folder / std::string("particles.").append(name(form.format));
  std::ofstream(path, std::ios::binary) << particle_text(now, fields, form);
  return path;
}

bool has_python_module(const std::string& module) {
  return std::system(("/usr/bin/python3 -c 'import " + module + "' 2>/dev/null").c_str()) == 0;
}

std::map<std::string, std::string> read_by_python(const TemporaryFolder& folder, const fs::path& file) {
  const std::string command = "/usr/bin/python3 " TAUT_SOURCE_DIR "/tests/cli/formats/read_particles.py " +
                              file.string() + " >" + folder.str("read") + " 2>&1";
  const int code = std::system(command.c_str());
  CAPTURE(text_of(folder / "read"));
  REQUIRE(code == 0);
  std::map<std::string, std::string> lines;
  for (const std::string& line : lines_of(folder / "read")) {
    const std::size_t end = std::min(line.find(' '), line.size());
    lines[line.substr(0, end)] = line.substr(std::min(end + 1, line.size()));
  }
  return lines;
}

std::map<std::string, Numbers> columns_of(const fs::path& csv) {
  const std::vector<std::string> lines = lines_of(csv);
  std::vector<std::string> names;
  std::istringstream header(lines.front());
  for (std::string name; std::getline(header, name, ',');) names.push_back(name);
  std::map<std::string, Numbers> columns;
  for (std::size_t k = 1; k < lines.size(); ++k) {
    const Numbers row = numbers_in(lines[k]);
    REQUIRE(row.size() == names.size());
    for (std::size_t c = 0; c < row.size(); ++c) columns[names[c]].push_back(row[c]);
  }
  REQUIRE(columns.size() == names.size());
  return columns;
}

const ParticleArray& find(const std::vector<ParticleArray>& arrays, std::string_view name) {
  const auto found = std::ranges::find(arrays, name, &ParticleArray::name);
  REQUIRE(found != arrays.end());
  return *found;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("particle arrays have the values of the snapshot, tensors in the order xx, yy, zz, xy, yz, xz") {
    for (const int dim : {2, 3}) {
      CAPTURE(dim);
      const Snapshot now = deformed_lattice(dim, sheared);
      const std::vector<ParticleArray> arrays = particle_arrays(now, all_fields(dim));
      const std::size_t i = 5, d = static_cast<std::size_t>(dim);
      const ParticleArray &stress = find(arrays, "stress"), &strain = find(arrays, "strain");
      CHECK(stress.values[6 * i + 0] == 6 - now.p[i]);
      CHECK(stress.values[6 * i + 1] == 12 - now.p[i]);
      CHECK(stress.values[6 * i + 2] == -18 - now.p[i]);
      CHECK(stress.values[6 * i + 3] == 24);
      CHECK(stress.values[6 * i + 4] == (dim == 3 ? 36 : 0));  // yz
      CHECK(stress.values[6 * i + 5] == (dim == 3 ? 30 : 0));  // xz
      for (const auto& [component, key] :
           std::map<std::size_t, const char*>{{0, "strain_xx"}, {1, "strain_yy"}, {3, "strain_xy"}})
        CHECK(strain.values[6 * i + component] == values_of(key, now)[i]);
      for (const auto& [component, key] :
           std::map<std::size_t, const char*>{{2, "strain_zz"}, {4, "strain_yz"}, {5, "strain_xz"}})
        CHECK(strain.values[6 * i + component] == (dim == 3 ? values_of(key, now)[i] : 0));
      CHECK(find(arrays, "displacement_vector").values[3 * i + 1] == now.x[d * i + 1] - now.x0[d * i + 1]);
      CHECK(find(arrays, "initial_position").values[3 * i + 1] == now.x0[d * i + 1]);
      CHECK(find(arrays, "volume").values[i] == now.m[i] / now.rho[i]);
      CHECK(find(arrays, "volume").unit == (dim == 3 ? "m³" : "m²"));
      CHECK(find(arrays, "mass").values == now.m);
      CHECK(find(arrays, "id").values[i] == 5);
    }
  }

  TEST_CASE("the strain tensor is the logarithmic strain of the motion") {
    // stretch by 2 along (1, 1) and by 1/2 across
    constexpr double regularized = 1e-8;
    const LinearMap F{1.25, 0.75, 0, 0.75, 1.25, 0, 0, 0, 1};
    Snapshot now = deformed_lattice(2, F);
    now.body.assign(now.size(), 0);
    const std::vector<ParticleArray> arrays = particle_arrays(now, all_fields(2));
    for (std::size_t i = 0; i < now.size(); ++i) {
      CHECK(std::abs(find(arrays, "strain").values[6 * i + 0]) < regularized);
      CHECK(std::abs(find(arrays, "strain").values[6 * i + 1]) < regularized);
      CHECK(find(arrays, "strain").values[6 * i + 3] == Approx(std::log(2)));
    }
  }

  TEST_CASE("tensors are written only with one of their components among the fields") {
    const Snapshot now = deformed_lattice(3, sheared);
    const auto has = [&](const char* field, const char* tensor) {
      const std::vector<const Field*> chosen{find_field(field)};
      return std::ranges::count(particle_arrays(now, chosen), tensor, &ParticleArray::name) > 0;
    };
    CHECK(has("stress_yz", "stress"));
    CHECK_FALSE(has("stress_yz", "strain"));
    CHECK(has("strain_xx", "strain"));
    CHECK_FALSE(has("strain_xx", "stress"));
    CHECK_FALSE(has("equivalent_strain", "strain"));
    CHECK_FALSE(has("von_mises", "stress"));
  }

  TEST_CASE("a file with single precision is read back with real numbers rounded to 24 bits") {
    const TemporaryFolder folder;
    const Snapshot now = deformed_lattice(3, sheared);
    const std::vector<const Field*> chosen{find_field("stress_xx"), find_field("speed")};
    const ParticleFile file(write(folder, now, {ParticleFormat::vtp, true}, chosen));
    CHECK(file.positions(3) == as_float(now.x));
    CHECK(file.field("stress_xx") == as_float(values_of("stress_xx", now)));
    CHECK(file.field("stress_xx") != values_of("stress_xx", now));
    CHECK(file.field("body") == values_of("body", now));
    CHECK(file.time() == now.time);
  }

  TEST_CASE("a csv file has a column for each component, with the values of the snapshot") {
    const TemporaryFolder folder;
    for (const int dim : {2, 3}) {
      CAPTURE(dim);
      const Snapshot now = deformed_lattice(dim, sheared);
      const auto columns = columns_of(write(folder, now, {ParticleFormat::csv, false}, all_fields(dim)));
      for (const Field& field : fields(dim)) {
        CAPTURE(field.key);
        const std::string unit = field.unit.empty() ? "" : " [" + std::string(field.unit) + "]";
        CHECK(columns.at(std::string(field.key) + unit) == evaluate(field, now));
      }
      const auto d = static_cast<std::size_t>(dim);
      CHECK(columns.at("y [m]")[4] == now.x[d * 4 + 1]);
      CHECK(columns.at("initial_position_y [m]")[4] == now.x0[d * 4 + 1]);
      CHECK(columns.at("stress_zz [Pa]")[4] == now.stress(4).zz);
      CHECK(columns.at(dim == 3 ? "mass [kg]" : "mass [kg/m]") == now.m);
      CHECK(columns.at("id")[4] == 4);
      CHECK(columns.at("held")[5] == 1);
      CHECK(columns.at("time [s]") == Numbers(now.size(), now.time));
      CHECK(columns.contains("z [m]") == (dim == 3));
      CHECK(columns.contains("velocity_z [m/s]") == (dim == 3));
      CHECK(columns.contains("stress_yz [Pa]") == (dim == 3));
    }
    const Snapshot now = deformed_lattice(2, sheared);
    const auto single =
        columns_of(write(folder, now, {ParticleFormat::csv, true}, {find_field("von_mises")}));
    CHECK(as_float(single.at("von_mises [Pa]")) == as_float(values_of("von_mises", now)));
    CHECK(single.at("von_mises [Pa]") != values_of("von_mises", now));
  }

  TEST_CASE("an xyz file has OVITO's names, and tensors in OVITO's order xx, yy, zz, xy, xz, yz") {
    const TemporaryFolder folder;
    const Snapshot now = deformed_lattice(3, sheared);
    const std::vector<std::string> lines =
        lines_of(write(folder, now, {ParticleFormat::xyz, false}, all_fields(3)));
    REQUIRE(lines.size() == 29);
    CHECK(lines[0] == "27");
    const std::string& comment = lines[1];
    CAPTURE(comment);
    CHECK(comment.starts_with("Lattice=\""));
    CHECK(comment.find(" pbc=\"F F F\" Properties=species:S:1:pos:R:3:von_mises:R:1:pressure:R:1:") !=
          std::string::npos);
    CHECK(comment.ends_with(" Time=" + exact(now.time)));
    for (const char* property : {":velo:R:3", ":disp:R:3", ":stress:R:6", ":strain:R:6", ":radius:R:1",
                                 ":id:I:1", ":mass:R:1", ":held:I:1", ":initial_position:R:3"})
      CHECK(comment.find(property) != std::string::npos);
    for (const char* part : {":stress_xx", ":velocity_x", ":displacement_x", ":strain_xy", ":diameter"})
      CHECK(comment.find(part) == std::string::npos);
    std::size_t column = 0, at = comment.find(":stress:R:6");
    std::istringstream before(comment.substr(comment.find("species"), at - comment.find("species")));
    for (std::string name, type, width; std::getline(before, name, ':') && std::getline(before, type, ':') &&
                                        std::getline(before, width, ':');)
      column += std::stoul(width);
    const Numbers row = numbers_in("0" + lines[2 + 4].substr(1));
    const StressTensor t = now.stress(4);
    CHECK(Numbers(row.begin() + static_cast<long>(column), row.begin() + static_cast<long>(column) + 6) ==
          Numbers{t.xx, t.yy, t.zz, t.xy, t.xz, t.yz});
  }

  TEST_CASE("VTK reads back every value of a particle file, and stress as a tensor") {
    if (!has_python_module("vtk")) {
      MESSAGE("skipped: there is no VTK for Python (Debian's package python3-vtk9)");
      return;
    }
    const TemporaryFolder folder;
    for (const bool single : {false, true})
      for (const int dim : {2, 3}) {
        CAPTURE(dim);
        CAPTURE(single);
        const Snapshot now = deformed_lattice(dim, sheared);
        auto read =
            read_by_python(folder, write(folder, now, {ParticleFormat::vtp, single}, all_fields(dim)));
        const auto expected = [single](const ParticleArray& array) {
          return single && array.type == ParticleArray::Type::real ? as_float(array.values) : array.values;
        };
        for (const ParticleArray& array : particle_arrays(now, all_fields(dim))) {
          CAPTURE(array.name);
          CHECK(numbers_in(read[std::string(array.name)]) == expected(array));
        }
        CHECK(numbers_in(read["positions"]) == expected(position_array(now)));
        CHECK(numbers_in(read["time"]) == Numbers{now.time});
        CHECK(numbers_in(read["vertices"]) == Numbers{static_cast<double>(now.size())});
        CHECK(numbers_in(read["last_vertex"]) == Numbers{static_cast<double>(now.size() - 1)});
        CHECK(read["vectors"] == "velocity");
        CHECK(read["tensors"] == "stress");
        CHECK(read["stress.components"] == "xx yy zz xy yz xz");
        CHECK(read["strain.components"] == "xx yy zz xy yz xz");
        CHECK(read["stress.type"] == (single ? "float" : "double"));
        CHECK(read["id.type"] == "int");
      }
    const Snapshot many = deformed_lattice(3, sheared);
    CHECK(read_by_python(folder, write(folder, many, {}, {find_field("speed")}))["tensors"] == "none");
  }

  TEST_CASE("ASE reads back positions, vectors, tensors and scalars of an xyz file") {
    if (!has_python_module("ase.io")) {
      MESSAGE("skipped: there is no ASE for Python (Debian's package python3-ase)");
      return;
    }
    const TemporaryFolder folder;
    for (const int dim : {2, 3}) {
      CAPTURE(dim);
      const Snapshot now = deformed_lattice(dim, sheared);
      auto read = read_by_python(folder, write(folder, now, {ParticleFormat::xyz, false}, all_fields(dim)));
      const auto read_as = [&](const char* name) { return numbers_in(read[name]); };
      const auto arrays = particle_arrays(now, all_fields(dim));
      CHECK(read_as("positions") == position_array(now).values);
      CHECK(read_as("velo") == find(arrays, "velocity").values);
      CHECK(read_as("disp") == find(arrays, "displacement_vector").values);
      CHECK(read_as("initial_position") == find(arrays, "initial_position").values);
      CHECK(read_as("radius") == Numbers(now.size(), 0.05));
      for (const char* same : {"id", "mass", "volume", "body", "material", "held", "von_mises", "J"}) {
        CAPTURE(same);
        CHECK(read_as(same) == (same == std::string("J") ? values_of("J", now) : find(arrays, same).values));
      }
      const auto in_order = [&](const char* tensor) {
        std::vector<Numbers> columns;
        for (const std::size_t c : {0, 1, 2, 3, 5, 4}) {
          columns.emplace_back();
          for (std::size_t i = 0; i < now.size(); ++i)
            columns.back().push_back(find(arrays, tensor).values[6 * i + c]);
        }
        return interleaved(columns);
      };
      CHECK(read_as("stress") == in_order("stress"));
      CHECK(read_as("strain") == in_order("strain"));
      CHECK(read_as("time") == Numbers{now.time});
      CHECK(read_as("periodic") == Numbers{0, 0, 0});
      CHECK(read_as("origin")[1] == Approx(-0.05));
      CHECK(read_as("cell")[4] == Approx(0.2 * 0.9 + (dim == 3 ? 0.2 * 0.2 : 0) + 0.1));
    }
  }
}
