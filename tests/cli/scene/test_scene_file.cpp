#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>

#include <doctest/doctest.h>

#include "cli/scene/scene_file.hpp"
#include "cli/scene/shipped.hpp"
#include "engine/layout/initial_particles.hpp"
#include "engine/methods/catalogue.hpp"
#include "engine/scene/shapes/box.hpp"
#include "engine/scene/shapes/round_shapes.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/scene_text.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

SceneFile shipped(const std::string& name, const std::vector<Setting>& settings = {}) {
  return read_scene(std::filesystem::path(TAUT_SOURCE_DIR) / "scenes" / (name + ".toml"), settings);
}

std::vector<Setting> set(const std::vector<std::pair<std::string, std::string>>& values) {
  std::vector<Setting> settings;
  for (const auto& [name, value] : values) settings.push_back({name, value});
  return settings;
}

std::size_t particles(const Scene& scene) {
  return static_cast<std::size_t>(make_initial_particles(scene).size());
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a small scene has its values and the defaults") {
    const SceneFile file = read_text(small_scene);
    CHECK(file.scene.name == "scene");
    CHECK(file.scene.title == "Small");
    CHECK(file.scene.dim == 2);
    CHECK(file.scene.spacing == 0.1);
    CHECK(file.scene.until == 2);
    CHECK(file.settings.method == "oenog");
    CHECK(file.settings.stepping == Stepping::dual);
    CHECK(file.settings.cfl == find_method("oenog")->cfl);
    CHECK(*file.history == 0.002);
    REQUIRE(file.parameters.size() == 1);
    CHECK(file.parameters[0].value == 0.06);
    CHECK(file.parameters[0].unit == "c0");
    CHECK(file.parameters[0].help == "speed");
    CHECK(*file.parameters[0].low == 0);
    CHECK(*file.parameters[0].high == 0.5);
    CHECK(file.drawing.field == find_field("von_mises"));
    CHECK_FALSE(file.drawing.look.colormap);
    CHECK_FALSE(file.drawing.look.range);
    CHECK_FALSE(file.drawing.look.view);
    CHECK(file.drawing.look.size == render::Size{1280, 720});
    CHECK(file.drawing.frames == 60);
  }

  TEST_CASE("expressions of a body can use the constants of its material") {
    const Scene scene = read_text(small_scene).scene;
    REQUIRE(scene.bodies.size() == 2);
    const double c0 = std::sqrt(1e7 / (3 * (1 - 2 * 0.4)) / 1200);
    CHECK(scene.bodies[0].velocity[0]({2, 0, 0}) == Approx(0.06 * c0 * 2).epsilon(1e-14));
    CHECK_FALSE(scene.bodies[0].velocity[1]);
    CHECK_FALSE(scene.bodies[0].clamped);
    const auto& ring = *scene.bodies[1].shapes[0].as<Ring>();
    CHECK(ring.inner == 1);
    CHECK(ring.outer == 2);
    CHECK(ring.centre == Point{5, 0, 0});

    const auto value = [&](const char* expression) {
      return read_text(replaced(small_scene, "\"v0*c0*x\"", expression))
          .scene.bodies[0]
          .velocity[0]({1, 2, 3});
    };
    CHECK(value("\"v0*E + nu + rho\"") == Approx(0.06 * 1e7 + 0.4 + 1200).epsilon(1e-14));
    CHECK(value("\"v0*K/G\"") == Approx(0.06 * (1e7 / 0.6) / (1e7 / 2.8)).epsilon(1e-14));
    CHECK(value("\"v0*0 + y + dp + pi\"") == Approx(2 + 0.1 + 3.14159265358979).epsilon(1e-14));
  }

  TEST_CASE("parameters can use earlier parameters and keep the order of the file") {
    const SceneFile file =
        read_text(replaced(small_scene, "[material",
                           "width = { value = \"2*v0\" }\nheight = { value = \"width + dp\" }\n[material") +
                  "view = [0, \"width\", 0, \"height\"]\n");
    REQUIRE(file.parameters.size() == 3);
    CHECK(file.parameters[0].name == "v0");
    CHECK(file.parameters[1].name == "width");
    CHECK(file.parameters[1].value == 0.12);
    CHECK(file.parameters[2].name == "height");
    CHECK(file.parameters[2].value == Approx(0.22));
    CHECK(file.drawing.look.view->y_max == file.parameters[2].value);
  }

  TEST_CASE("the spacing is rounded to divide the first body, and dp is the rounded spacing") {
    const std::string text = replaced(small_scene, "spacing = 0.1", "spacing = \"v0*4\"");  // 1/0.24 = 4.17
    CHECK(read_text(text).scene.spacing == 0.25);
    const SceneFile file = read_text(replaced(text, "at = [2, 0.5]", "at = [\"2 - dp\", \"dp\"]"));
    CHECK(file.scene.probes[0].at == Point{1.75, 0.25, 0});
  }

  TEST_CASE("a reference holds only for its own parameters") {
    CHECK(read_text(small_scene).scene.references.at("neo_hookean").value.at("peak") == 3);
    CHECK(read_text(small_scene, set({{"v0", "0.07"}})).scene.references.empty());
    CHECK(read_text(small_scene, set({{"v0", "0.03*2"}, {"spacing", "0.05"}})).scene.references.size() == 1);
    const std::string text = replaced(small_scene, "values =", "when = { v0 = 0.07 }\nvalues =");
    CHECK(read_text(text).scene.references.empty());
    CHECK(read_text(text, set({{"v0", "0.07"}})).scene.references.size() == 1);
    CHECK(read_text(text, set({{"v0", "0.07000001"}})).scene.references.empty());
  }

  TEST_CASE("a solution holds for any parameters unless `when` restricts it") {
    const std::string curve = replaced(small_scene, "of = \"maximum\"", "of = \"at_rest\"");
    const std::string text =
        replaced(curve, "values = { peak = 3 }",
                 "let = { a = \"2*v0\", b = \"a + 1\" }\nsolutions = { peak = \"b*t + 5\" }");
    const auto peak = [&](const std::string& scene, const std::vector<Setting>& settings = {}) {
      return read_text(scene, settings)
          .scene.references.at("neo_hookean")
          .solution.at("peak")
          .at(0)({5, 0, 0}, 10);
    };
    CHECK(peak(text) == Approx(16.2).epsilon(1e-14));
    CHECK(peak(text, set({{"v0", "0.5"}})) == Approx(25).epsilon(1e-14));
    const std::string when = replaced(text, "let =", "when = { v0 = 0.06 }\nlet =");
    CHECK(peak(when) == Approx(16.2).epsilon(1e-14));
    CHECK(read_text(when, set({{"v0", "0.5"}})).scene.references.empty());
    const std::string valued = replaced(text, "let =", "values = { peak = 3 }\nlet =");
    CHECK(read_text(valued).scene.references.at("neo_hookean").value.at("peak") == 3);
    CHECK(peak(valued) == Approx(16.2).epsilon(1e-14));
    CHECK(peak(valued, set({{"v0", "0.5"}})) == Approx(25).epsilon(1e-14));
    CHECK(read_text(valued, set({{"v0", "0.5"}})).scene.references.at("neo_hookean").value.empty());
  }

  TEST_CASE("scenes are found by name and by path") {
    const std::vector<std::string> names = scene_names();
    const auto of_gallery = [](const std::string& name) { return name.starts_with("gallery/"); };
    CHECK(std::ranges::is_partitioned(names, std::not_fn(of_gallery)));
    CHECK(std::ranges::is_sorted(names.begin(), std::ranges::find_if(names, of_gallery)));
    for (const char* name :
         {"ball-plate", "colliding-rings", "composite-rings", "composite-rings-density", "elastic-cable",
          "elastic-rings", "heterogeneous-cable", "oscillating-plate", "rotating-plate", "tran-duc-rings"})
      CHECK(std::ranges::count(names, name) == 1);
    CHECK(find_scene("ball-plate") == scene_folders().front() / "ball-plate.toml");
    const std::string path = write_scene(small_scene).string();
    CHECK(find_scene(path) == path);
  }

  TEST_CASE("folders of TAUT_SCENES add scenes and come first") {
    const std::filesystem::path folder = scratch_folder() / "scenes of mine";
    std::filesystem::create_directories(folder / "studies");
    const auto among = [](const std::vector<std::string>& names, const char* name) {
      return std::ranges::count(names, name) == 1;
    };
    for (const char* name : {"mine", "ball-plate"})
      std::ofstream(folder / (name + std::string(".toml"))) << small_scene;
    std::ofstream(folder / "studies/my-study.toml") << "scene = \"mine\"\n";
    setenv("TAUT_SCENES", (":" + folder.string() + ":").c_str(), 1);
    CHECK(among(scene_names(), "mine"));
    CHECK(among(scene_names(), "ball-plate"));
    CHECK(among(scene_names(), "colliding-rings"));
    CHECK(find_scene("mine") == folder / "mine.toml");
    CHECK(find_scene("ball-plate") == folder / "ball-plate.toml");
    CHECK(find_sweep("my-study") == folder / "studies/my-study.toml");
    setenv("TAUT_SCENES", (folder / "not there").c_str(), 1);
    CHECK_THROWS_WITH_AS(scene_names(), doctest::Contains("not there', which does not exist"), UsageError);
    unsetenv("TAUT_SCENES");
    CHECK(!among(scene_names(), "mine"));
  }

  TEST_CASE("an error of the engine gets the file position of its key") {
    const SceneFile file = read_text(small_scene);
    const SceneError spacing = locate(file, SceneError("spacing", "too many particles"));
    CHECK(spacing.file == file.path.string());
    CHECK(spacing.line == 2);
    CHECK(spacing.column == 11);
    CHECK(std::string(spacing.what()) == "too many particles");
    CHECK(locate(file, SceneError("body.ring", "")).line == 15);
    CHECK(locate(file, SceneError("body.ring.shape", "")).line == 17);
    CHECK(locate(file, SceneError("body.ring.nothing", "")).line == 15);
    CHECK(locate(file, SceneError("elsewhere", "")).line == 0);
    CHECK(locate(file, SceneError("f", 3, 4, "spacing", "")).line == 3);
  }

  TEST_CASE("colliding rings: the numbers equal Zhang2024 6.3") {
    const SceneFile file = shipped("colliding-rings");
    const Scene& scene = file.scene;
    CHECK(scene.name == "colliding-rings");
    CHECK(scene.spacing == 0.001);
    CHECK(scene.until == 0.012);
    REQUIRE(scene.bodies.size() == 2);
    REQUIRE(scene.materials.size() == 1);
    CHECK(scene.materials[0].density == 1200);
    CHECK(scene.materials[0].youngs_modulus == 1e7);
    CHECK(scene.materials[0].poisson_ratio == 0.4);
    for (int b = 0; b < 2; ++b) {
      const auto& ring = *scene.bodies[b].shapes.at(0).as<Ring>();
      CHECK(ring.centre == Point{b == 0 ? -0.045 : 0.045, 0, 0});
      CHECK(ring.inner == 0.03);
      CHECK(ring.outer == 0.04);
      CHECK(scene.bodies[b].velocity[0]({}) == Approx(b == 0 ? 7.07106781 : -7.07106781).epsilon(1e-8));
      CHECK(scene.bodies[b].mirror[0] == (b == 1));
    }
    CHECK(scene.probes.at(0).at[0] == Approx(-0.085));
    CHECK(scene.probes.at(0).to[0] == Approx(-0.005));
    CHECK(scene.measures.at(2).scale == Approx(-7.07106781).epsilon(1e-8));
    CHECK(scene.measures.at(2).free == "gap");
    for (std::size_t m = 0; m < 3; ++m) CHECK(scene.measures[m].threshold == Approx(0.0009));  // 0.9 dp
    CHECK(scene.references.at("2d_deviator").value.at("least_diameter") == 0.0485);
    CHECK(scene.references.at("neo_hookean").value.at("separation_time") == 0.009756);
    CHECK(particles(scene) == 4398);
  }

  TEST_CASE("oscillating plate: the numbers equal Zhang2024 6.1") {
    const SceneFile file = shipped("oscillating-plate");
    const Scene& scene = file.scene;
    CHECK(scene.spacing == 0.002);
    CHECK(scene.until == 1);
    CHECK(scene.materials.at(0).youngs_modulus == 2e6);
    CHECK(scene.materials.at(0).poisson_ratio == 0.3975);
    const auto& clamp = *scene.bodies.at(0).shapes.at(1).as<Box>();
    CHECK(clamp.low[0] == Approx(-0.068));
    CHECK(clamp.low[1] == Approx(-0.018));
    CHECK(scene.bodies[0].clamped({-1e-9, 0, 0}) != 0);
    CHECK(scene.bodies[0].clamped({0, 0, 0}) == 0);
    CHECK(particles(scene) == 1612);
    // Eq. 28–29
    const auto& velocity = scene.bodies[0].velocity[1];
    const double c0 = scene.materials[0].sound_speed();
    CHECK(velocity({0.2, 0, 0}) == Approx(0.05 * c0).epsilon(1e-14));
    CHECK(velocity({0.1, 0, 0}) == Approx(0.05 * c0 * 0.3395167769).epsilon(1e-9));
    CHECK(velocity({0, 0, 0}) == 0);
    CHECK(velocity({-0.01, 0, 0}) == 0);
  }

  TEST_CASE("oscillating plate: references depend on the initial speed") {
    const auto period = [](const std::string& vf, const std::string& law) {
      return shipped("oscillating-plate", set({{"vf", vf}})).scene.references.at(law).value.at("period");
    };
    CHECK(period("0.001", "2d_deviator") == 0.25685);
    CHECK(period("0.01", "2d_deviator") == 0.25682);
    CHECK(period("0.05", "2d_deviator") == 0.25614);
    CHECK(period("0.001", "neo_hookean") == 0.25522);
    CHECK(period("0.01", "neo_hookean") == 0.25519);
    CHECK(period("0.05", "neo_hookean") == 0.25447);
    CHECK(shipped("oscillating-plate", set({{"vf", "0.02"}})).scene.references.empty());
    CHECK(shipped("oscillating-plate", set({{"L", "0.1"}})).scene.references.empty());
    const Scene scene = shipped("oscillating-plate").scene;
    const ReferenceTable& tip = scene.references.at("2d_deviator").table.at("tip_rmse");
    REQUIRE(tip.t.size() == 1001);
    CHECK(tip.t.back() == 1);
    CHECK(tip.t[1] == 0.001);
    CHECK(tip.value.at(0)[1] == 0.00277107307);
    CHECK(scene.references.at("neo_hookean").table.at("tip_rmse").value.at(0)[1] == 0.002771050745);
  }

  TEST_CASE("ball and plate: the numbers equal Zhang2024 6.5") {
    const Scene scene = shipped("ball-plate").scene;
    CHECK(scene.spacing == 0.0025);
    CHECK(scene.until == 0.04);
    CHECK(scene.materials.at(0).poisson_ratio == 0.49);
    REQUIRE(scene.bodies.size() == 2);
    CHECK(scene.bodies[0].name == "plate");
    CHECK(scene.bodies[0].shapes.at(1).as<Box>()->low[0] == Approx(-0.26));
    CHECK(scene.bodies[0].shapes.at(2).as<Box>()->high[0] == Approx(0.26));
    CHECK(scene.bodies[0].clamped({0.2501, 0, 0}) != 0);
    CHECK(scene.bodies[0].clamped({-0.2501, 0, 0}) != 0);
    CHECK(scene.bodies[0].clamped({0.2499, 0, 0}) == 0);
    CHECK(scene.bodies[1].shapes.at(0).as<Disc>()->radius == 0.05);
    CHECK(scene.bodies[1].shapes.at(0).as<Disc>()->centre == Point{0, 0.1, 0});
    CHECK(scene.bodies[1].velocity[1]({}) == Approx(-7.45355992).epsilon(1e-8));
    CHECK(scene.references.at("neo_hookean").value.at("deflection") == -0.07766);
    CHECK(scene.references.at("2d_deviator").value.at("rebound_ratio") == 0.7189);
    CHECK(particles(scene) == 2928);
  }

  TEST_CASE("rotating plate: the numbers equal Khayyer2024 4.2") {
    const Scene scene = shipped("rotating-plate").scene;
    CHECK(scene.spacing == 0.04);
    CHECK(scene.until == 0.2);
    CHECK(scene.materials.at(0).density == 1100);
    CHECK(scene.materials[0].youngs_modulus == 17e6);
    CHECK(scene.materials[0].poisson_ratio == 0.45);
    CHECK(scene.bodies.at(0).velocity[0]({0.3, -0.2, 0}) == Approx(21).epsilon(1e-14));
    CHECK(scene.bodies[0].velocity[1]({0.3, -0.2, 0}) == Approx(31.5).epsilon(1e-14));
    CHECK(particles(scene) == 625);
    for (std::size_t k = 0; k < 2; ++k) {
      CHECK(scene.measures.at(k).probes == std::vector<std::string>{"corner_x", "corner_y"});
      CHECK(scene.probes.at(k).at == Point{0.5, 0.5, 0});
      CHECK(scene.probes[k].axis == static_cast<int>(k));
    }
    CHECK(scene.measures[0].scale == 1);
    for (const char* law : {"neo_hookean", "2d_deviator"})
      for (const char* measure : {"corner_error", "corner_angle"}) {
        const ReferenceTable& table = scene.references.at(law).table.at(measure);
        REQUIRE(table.t.size() == 401);
        CHECK(table.t.back() == 0.2);
        CHECK(table.value.at(0).front() == 0.5);
        CHECK(table.value.at(1).size() == 401);
      }
    const ReferenceTable& own = scene.references.at("neo_hookean").table.at("corner_error");
    CHECK(own.value[0].back() == Approx(-0.49487).epsilon(1e-5));
    CHECK(own.value[1].back() == Approx(0.51579).epsilon(1e-5));
    CHECK(shipped("rotating-plate", set({{"omega", "100"}})).scene.references.empty());
  }

  TEST_CASE("elastic cable: the exact solution is the sum of the modes") {
    for (const char* speed : {"5", "-2"}) {
      const Scene scene = shipped("elastic-cable", set({{"speed", speed}})).scene;
      const Solution& exact = scene.references.at("neo_hookean").solution.at("end_rmse").at(0);
      const double U = std::stod(speed), L = 10, c = 5000, pi = std::numbers::pi;
      for (const double t : {0.0, 2e-4, 5e-4, 1e-3, 3.7e-3, 4.4e-3, 5e-3, 7.6e-3, 8.1e-3, 0.01}) {
        // u = Σ a_n sin(k_n x) sin(k_n c t)/(k_n c), k_n = (n + ½)π/L, a_n = 2/L ∫ v0 sin(k_n x) dx from 3L/4
        // to L
        double u = 0;
        for (int n = 0; n < 20000; ++n) {
          const double k = (n + 0.5) * pi / L;
          const double a = 2 / L * U / k * (std::cos(k * 0.75 * L) - std::cos(k * L));
          u += a * std::sin(k * L) * std::sin(k * c * t) / (k * c);
        }
        CHECK(std::abs(exact({L, 0, 0}, t) - u) < 1e-4 * std::abs(U) * L / (4 * c));
      }
    }
    // the 2D deviator subtracts 1/2 of the trace, so the modulus of the rod is 4KG/(K + G)
    const Scene scene = shipped("elastic-cable").scene;
    const double K = scene.materials.at(0).bulk_modulus(), G = scene.materials[0].shear_modulus();
    const double c = std::sqrt(4 * K * G / (K + G) / 8000);
    const Solution& rod = scene.references.at("2d_deviator").solution.at("end_rmse").at(0);
    CHECK(rod({}, 1e-4) == Approx(5e-4).epsilon(1e-12));
    CHECK(rod({}, 1e-3) == Approx(5 * 2.5 / c).epsilon(1e-12));
    CHECK(rod({}, 20 / c) == Approx(0).scale(1e-3));
    CHECK(4 * G * (3 * K + G) / (3 * K + 4 * G) == Approx(2e11).epsilon(1e-12));
    CHECK(particles(scene) == 401 * 8);
  }

  TEST_CASE("heterogeneous cable: the analytic stress equals that of a bar of many small masses") {
    const Scene scene = shipped("heterogeneous-cable").scene;
    for (const char* law : {"neo_hookean", "2d_deviator"}) {
      const Solution& exact = scene.references.at(law).solution.at("stress_rmse").at(0);
      const int n = 1000;
      const double dx = 1.0 / n, dt = 0.5 * dx / 6000, pi = std::numbers::pi;
      const auto modulus = [&](int material) {
        const double K = scene.materials[material].bulk_modulus(),
                     G = scene.materials[material].shear_modulus();
        const double lateral = law[0] == 'n' ? K - 2 * G / 3 : K - G,
                     own = law[0] == 'n' ? K + 4 * G / 3 : K + G;
        return own - lateral * lateral / own;
      };
      const double M[] = {modulus(0), modulus(1)}, rho[] = {2785, 8930};
      std::vector<double> u(2 * n + 1), v(2 * n + 1), stress(2 * n);
      double t = 0;
      const double times[] = {1.0e-4, 2.0e-4, 2.5e-4, 3.5e-4};
      for (const double time : times) {
        for (; t < time; t += dt) {
          for (int k = 0; k < 2 * n; ++k) stress[k] = M[k >= n] * (u[k + 1] - u[k]) / dx;
          for (int k = 0; k <= 2 * n; ++k) {
            const double left = k > 0 ? stress[k - 1] : 0, right = k < 2 * n ? stress[k] : 0;
            const double mass = dx / 2 * ((k > 0 ? rho[k > n] : 0) + (k < 2 * n ? rho[k >= n] : 0));
            v[k] += dt * (right - left) / mass;
          }
          if (t < 1e-4) v[0] = 5e-5 * pi * 1e4 * std::sin(pi * 1e4 * (t + dt / 2));
          for (int k = 0; k <= 2 * n; ++k) u[k] += dt * v[k];
        }
        double squared = 0, greatest = 0;
        for (int k = 0; k < 2 * n; ++k) {
          const double expected = exact({(k + 0.5) * dx, 0, 0}, t - dt / 2);
          squared += std::pow(stress[k] - expected, 2) / (2 * n);
          greatest = std::max(greatest, std::abs(expected));
        }
        CHECK(greatest > 2e7);
        CHECK(std::sqrt(squared) < 0.01 * greatest);
      }
    }
    CHECK(scene.lines.at(0).times == std::vector<double>{1.0e-4, 1.5e-4, 2.0e-4, 2.5e-4, 3.0e-4, 3.5e-4});
  }

  TEST_CASE("rings: the numbers equal Khayyer2024 4.4 and 4.6") {
    const Scene rings = shipped("elastic-rings").scene;
    CHECK(rings.materials.at(0).youngs_modulus == 2e6);
    CHECK(rings.materials[0].poisson_ratio == 0.495);
    CHECK(rings.bodies.at(0).velocity[0]({}) == 1);
    CHECK(rings.bodies.at(1).velocity[0]({}) == -1);
    for (const char* name : {"composite-rings", "composite-rings-density"}) {
      CAPTURE(name);
      const Scene scene = shipped(name).scene;
      CHECK(scene.materials.at(0).youngs_modulus == 5e6);
      CHECK(scene.materials.at(1).youngs_modulus == 5e5);
      CHECK(scene.materials[0].density == 1000);
      CHECK(scene.materials[1].density == (std::string(name) == "composite-rings" ? 1000 : 100));
      const InitialParticles layout = make_initial_particles(scene);
      CHECK(layout.size() == make_initial_particles(rings).size());
      int inner = 0;
      for (int i = 0; i < layout.size(); ++i) {
        const double from_centre =
            std::hypot(layout.x[i][0] + (layout.body[i] == 0 ? 0.045 : -0.045), layout.x[i][1]);
        CHECK((layout.material[i] == 1) == (from_centre < 0.035));
        inner += layout.material[i];
      }
      CHECK(inner == Approx(layout.size() * 325.0 / 700).epsilon(0.01));
    }
  }

  TEST_CASE("large rings: diameter, wall and speed equal TranDuc2023 3.3") {
    const SceneFile file = shipped("tran-duc-rings", set({{"speed", "8"}}));
    const auto& ring = *file.scene.bodies.at(0).shapes.at(0).as<Ring>();
    CHECK(ring.outer == 0.1);
    CHECK(ring.inner == Approx(0.09));
    CHECK(ring.centre[0] == Approx(-0.101));
    CHECK(file.scene.bodies[0].velocity[0]({}) == 8);
  }
}
