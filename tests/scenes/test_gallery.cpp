#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include <doctest/doctest.h>

#include "cli/scene/scene_file.hpp"
#include "engine/diagnostics/curve.hpp"
#include "engine/diagnostics/measures.hpp"
#include "engine/materials/neo_hookean.hpp"
#include "engine/methods/catalogue.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

const fs::path gallery = fs::path(TAUT_SOURCE_DIR) / "scenes" / "gallery";

SceneFile read(const fs::path& scene, const std::string& spacing = {}) {
  std::vector<Setting> settings = {{"method", "oenog"}};
  if (!spacing.empty()) settings.push_back({"spacing", spacing});
  SceneFile file = read_scene(scene, settings);
  file.settings.threads = 1;
  return file;
}

std::vector<double> values_at(double until, const char* name, const char* method) {
  const SceneFile file = read_scene(gallery / name, {{"method", method}});
  const auto simulation = make_simulation(file.scene, file.settings);
  simulation->advance_to(until);
  std::vector<double> last;
  for (const std::vector<double>& value : simulation->series().value) last.push_back(value.back());
  return last;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("gallery: every scene is short, is listed with its picture, and makes steps with oenog") {
    const std::string index = text_of(gallery / "README.md");
    int scenes = 0;
    for (const auto& entry : fs::directory_iterator(gallery)) {
      if (entry.path().extension() != ".toml") continue;
      const std::string name = entry.path().stem().string();
      CAPTURE(name);
      ++scenes;
      CHECK(lines_of(entry.path()).size() <= 40);
      CHECK(contains(index, "](" + name + ".png)"));
      CHECK(contains(index, "`taut run gallery/" + name + "`"));
      const fs::path picture = gallery / (name + ".png");
      CHECK(fs::exists(picture));
      if (fs::exists(picture)) CHECK(fs::file_size(picture) <= 100'000);
      const SceneFile file = read(entry.path());
      const auto simulation = make_simulation(file.scene, file.settings);
      make_steps(*simulation, 5);
      CHECK(simulation->time() > 0);
    }
    CHECK(scenes == 12);
  }
}

TEST_SUITE("analytic") {
  TEST_CASE(
      "gallery: the period of a beam that swings to one side follows from crossings of the mean deflection") {
    const SceneFile file = read(gallery / "swinging-beam.toml", "0.005");
    const auto simulation = make_simulation(file.scene, file.settings);
    simulation->advance_to(file.scene.until);
    const Series& series = simulation->series();
    const auto& [t, y] = std::tie(series.time, series.value[0]);
    double level = 0, period = 0;
    int crossings = 0;
    for (std::size_t i = 1; i < t.size(); ++i) level += (y[i] + y[i - 1]) / 2 * (t[i] - t[i - 1]) / t.back();
    for (int round = 0; round < 5; ++round) {
      std::size_t first = 0, last = 0;
      crossings = 0;
      for (std::size_t i = 1; i < t.size(); ++i) {
        if (!(y[i - 1] > level && y[i] <= level)) continue;
        if (++crossings == 1) first = i;
        last = i;
      }
      double area = 0;
      for (std::size_t i = first + 1; i <= last; ++i) area += (y[i] + y[i - 1]) / 2 * (t[i] - t[i - 1]);
      level = area / (t[last] - t[first]);
      period = (t[last] - t[first]) / (crossings - 1);
    }
    CHECK(crossings >= 3);
    CHECK(level < -0.005);
    const auto measured = measure(file.scene, series, find_method("oenog")->material_law);
    REQUIRE(measured.at(0).value.has_value());
    CHECK(std::abs(*measured[0].value / period - 1) < 0.01);
  }

  TEST_CASE(
      "gallery: the force of a pulled bar follows the neo-Hookean law, also with a negative Poisson's ratio") {
    for (const double poisson_ratio : {0.4, -0.4}) {
      CAPTURE(poisson_ratio);
      SceneFile file = read(gallery / "pulled-bar.toml");
      Material& rubber = file.scene.materials[0];
      rubber.poisson_ratio = poisson_ratio;
      const auto simulation = make_simulation(file.scene, file.settings);
      simulation->advance_to(0.46 * file.scene.until);
      const NeoHookean law{rubber.bulk_modulus(), rubber.shear_modulus()};
      const auto piola = [&](double along, double across) {
        Mat<double, 2> F{};
        F(0, 0) = along, F(1, 1) = across;
        return law.piola(F, along * across);
      };
      const auto column = [&](const char* name) -> const std::vector<double>& {
        return simulation->series()
            .value[std::ranges::find(file.scene.probes, name, &Probe::name) - file.scene.probes.begin()];
      };
      const std::vector<double>&stretch = column("stretch"), &force = column("force");
      for (const double at : {1.3, 1.6, 2.0, 2.2}) {
        CAPTURE(at);
        const std::size_t i = std::ranges::lower_bound(stretch, at) - stretch.begin();
        REQUIRE(i < stretch.size());
        double thin = 0.3, thick = 1.8;  // bounds of the lateral stretch without lateral stress
        for (int k = 0; k < 50; ++k) {
          const double middle = 0.5 * (thin + thick);
          (piola(stretch[i], middle)(1, 1) > 0 ? thick : thin) = middle;
        }
        CHECK(force[i] / (0.04 * piola(stretch[i], thin)(0, 0)) == relative(1, 0.002));
      }
    }
  }
}

TEST_SUITE("failure") {
  TEST_CASE("gallery: tension resists a lateral force with oenog, and hardly with enog") {
    // a clamped beam under tension; E is the plane-strain modulus
    const double E = 1e7 / (1 - 0.09), L = 0.4, h = 0.01, strain = 0.05, Q = 55, T = E * h * strain;
    const double deflection = Q / (2 * T) * ((1 + strain) * L / 4 - std::sqrt(E * h * h * h / 12 / T));
    CHECK(values_at(0.55, "tensioned-strip.toml", "oenog")[0] == relative(deflection, 0.1));
    CHECK(values_at(0.55, "tensioned-strip.toml", "enog")[0] > 6 * deflection);
  }

  TEST_CASE("gallery: a column buckles at Euler's load with oenog, and not with enog") {
    const double E = 1e7 / (1 - 0.09), L = 0.4, h = 0.02, pi = 3.14159265358979;
    const double load = 4 * pi * pi * E * h * h * h / 12 / (L * L);
    const std::vector<double> oenog = values_at(0.7, "pressed-column.toml", "oenog"),
                              enog = values_at(0.7, "pressed-column.toml", "enog");
    CHECK(oenog[0] > h);
    CHECK(oenog[1] == relative(load, 0.05));
    CHECK(enog[0] < 0.01 * h);
    CHECK(enog[1] > 2 * load);
  }
}

}  // namespace of_this_file
