#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "engine/error.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/scenes.hpp"

namespace of_this_file {

using namespace taut;
using namespace taut::test;

namespace {

template <class E>
std::string message(const Scene& scene, const Settings& settings) {
  try {
    make_simulation(scene, settings);
  } catch (const E& error) {
    return error.what();
  }
  FAIL("nothing was thrown");
  return "";
}

std::string usage_error(const Settings& settings) { return message<UsageError>(small_collision(), settings); }

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("methods: each method is found by its name and has a description") {
    CHECK(methods().size() >= 4);
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      CHECK(find_method(method.name) == &method);
      CHECK(make_simulation(small_collision(), with_method(std::string(method.name)))->snapshot().size() >
            200);
      CHECK_FALSE(method.paper.empty());
      CHECK_FALSE(method.summary.empty());
      CHECK_FALSE(method.conserves.empty());
      CHECK_FALSE(method.terms.empty());
      CHECK(method.cfl > 0);
      for (const MethodConstant& constant : method.constants) {
        CAPTURE(std::string(constant.name));
        CHECK(constant.low <= constant.value);
        CHECK(constant.value <= constant.high);
        CHECK_FALSE(constant.help.empty());
      }
    }
    CHECK(find_method("nog") == nullptr);
    CHECK(find_method("") == nullptr);
  }

  TEST_CASE("methods: the message for an unknown method contains its name") {
    CHECK(contains(usage_error(with_method("nog")), "'nog'"));
    CHECK_FALSE(usage_error(with_method("")).empty());
  }

  TEST_CASE("constants: the message for an unknown constant contains its name and a known constant") {
    Settings settings = with_method("enog");
    settings.constants = {{"zeal", 1}};
    CHECK(contains(usage_error(settings), "'zeal'"));
    CHECK(contains(usage_error(settings), "zeta"));
    settings.constants = {{"epsilon", 0.3}};
    CHECK(contains(usage_error(settings), "'epsilon'"));
  }

  TEST_CASE(
      "constants: both bounds are allowed, values beyond are refused, and the message contains the bounds") {
    for (const MethodInfo& method : methods()) {
      for (const MethodConstant& constant : method.constants) {
        CAPTURE(std::string(method.name));
        CAPTURE(std::string(constant.name));
        const std::string name(constant.name);
        Settings settings = with_method(std::string(method.name));
        for (const double value : {constant.low, constant.high}) {
          settings.constants = {{name, value}};
          CHECK_NOTHROW(make_simulation(small_collision(), settings));
        }
        for (const double value :
             {constant.low - 1e-3, constant.high + 1e-3, std::numeric_limits<double>::quiet_NaN()}) {
          settings.constants = {{name, value}};
          const std::string error = usage_error(settings);
          CHECK(contains(error, "'" + name + "'"));
          CHECK(contains(error, fmt::format("{:g}", constant.low)));
          CHECK(contains(error, fmt::format("{:g}", constant.high)));
        }
      }
    }
  }

  TEST_CASE(
      "constants: another value of any constant changes the run, and setting the default value does not") {
    for (const MethodInfo& method : methods()) {
      const Settings plain = with_method(std::string(method.name));
      for (const MethodConstant& constant : method.constants) {
        CAPTURE(std::string(method.name));
        CAPTURE(std::string(constant.name));
        Scene scene = constant.name == "boundary_projection" ? small_clamped_plate() : small_collision();
        const bool by_penalty = constant.name == "contact_stiffness" && supports(method, ContactLaw::penalty);
        scene.contact = by_penalty ? ContactLaw::penalty : ContactLaw::published;
        const int steps = constant.name == "contact_stiffness" ? 40 : 20;
        const Snapshot usual = state_after(steps, scene, plain);
        Settings settings = plain;
        if (constant.name == "riemann_limiter") settings.constants["beta_least"] = 0;
        settings.constants[std::string(constant.name)] = constant.value;
        const Snapshot same = state_after(steps, scene, settings);
        // with smaller values the body tears
        const double low = constant.name == "surface_colour" ? constant.high : constant.low;
        const double middle = 0.5 * (constant.value + low);
        settings.constants[std::string(constant.name)] = middle == constant.value ? constant.high : middle;
        CHECK(state_after(steps, scene, settings).v != same.v);
        if (constant.name != "riemann_limiter") CHECK(same.v == usual.v);
      }
    }
  }

  TEST_CASE("settings: a law that a method lacks is refused with a reason") {
    const Scene scene = small_collision();
    const auto message = [&](const char* method, const char* law) -> std::string {
      Settings settings = with_method(method);
      settings.law = law;
      try {
        make_simulation(scene, settings);
      } catch (const UsageError& error) {
        return error.what();
      }
      return "nothing was thrown";
    };
    CHECK(message("tl", "hooke").find("it has: neo-hookean, mooney-rivlin, st-venant-kirchhoff, linear") !=
          std::string::npos);
    CHECK(message("icb", "linear").find("cannot be chosen") != std::string::npos);
    const std::string refusal = message("pfj-jst", "linear");
    CHECK(refusal.find("has the volume ratio as a separate unknown") != std::string::npos);
    CHECK(refusal.find("allowed laws: neo-hookean, mooney-rivlin") != std::string::npos);
    Settings settings = with_method("tl");
    CHECK(material_law(*find_method("tl"), settings) == "neo_hookean");
    settings.law = "linear";
    CHECK(material_law(*find_method("tl"), settings) == "linear_elastic");
    CHECK(material_law(*find_method("og"), with_method("og")) == "2d_deviator");
  }

  TEST_CASE("settings: the step is proportional to the CFL number") {
    const Scene scene = small_collision();
    Settings settings = with_method("enog");
    const double usual = state_after(1, scene, settings).time;
    const double h = 1.3 * scene.spacing, c0 = scene.materials[0].sound_speed();
    const double vmax = 0.12 * c0;  // without perturbations
    CHECK(usual == relative(0.4 * h / (c0 + vmax), 0.05));
    settings.cfl = 0.1;
    CHECK(state_after(1, scene, settings).time == relative(usual * 0.1 / 0.4));
  }

  TEST_CASE("settings: the step shortens only below a Poisson's ratio of 0, or 0.2 for enog") {
    Scene scene = small_collision();
    for (Body& body : scene.bodies) body.velocity = {};
    const auto step = [&](const char* method, double nu) {
      scene.materials[0].poisson_ratio = nu;
      const double c0 = scene.materials[0].sound_speed();
      const MethodInfo& info = *find_method(method);
      return state_after(1, scene, with_method(method)).time * c0 /
             (info.cfl * info.formulation.h_over_dp * scene.spacing);
    };
    for (const char* method : {"og", "enog", "d-ulsph-r-tic", "ccb"}) {
      CAPTURE(std::string(method));
      for (const double nu : {0.2, 0.3, 0.49}) CHECK(step(method, nu) == relative(1, 1e-14));
      // below ν = 0, or 0.2 for enog, c0 times the step is proportional to 1/√(1 + ζG/K);
      // G/K is ¾, 3/2 and 6 at ν = 0.2, 0 and −0.5
      const bool enog = std::string(method) == "enog";
      const double zeta = enog ? 3.5 : 4.0 / 3, known = 1 + (enog ? 0.75 : 1.5) * zeta;
      CHECK(step(method, 0) == relative(std::sqrt(known / (1 + 1.5 * zeta)), 1e-9));
      CHECK(step(method, -0.5) == relative(std::sqrt(known / (1 + 6 * zeta)), 1e-9));
    }
  }

  TEST_CASE("divergence: a block with a Poisson's ratio from −0.9 to 0.1 is stable at the default step") {
    Scene scene = small_collision();
    scene.bodies.resize(1);
    scene.bodies[0].shapes = {Box{{0, 0, 0}, {0.012, 0.008, 0}}};
    for (const double nu : {0.1, 0.0, -0.3, -0.6, -0.9}) {
      scene.materials[0].poisson_ratio = nu;
      const double v = 1e-4 * scene.materials[0].sound_speed();
      scene.bodies[0].velocity = {[=](const Point& x) { return v * std::sin(600 * x[0]); },
                                  [=](const Point& x) { return v * std::cos(400 * x[1]); },
                                  {}};
      for (const char* method :
           {"enog", "enog-nonconservative", "og", "oas", "d-ulsph-r-tic", "ulsph-av-as"}) {
        CAPTURE(nu);
        CAPTURE(std::string(method));
        const Snapshot now = state_after(400, scene, with_method(method));
        double fastest = 0;
        for (const double speed : now.v) fastest = std::max(fastest, std::abs(speed));
        CHECK(fastest < 3 * v);
      }
    }
  }

  TEST_CASE("scene: enog refuses a second, different material, and the message names bodies and materials") {
    Scene scene = small_collision();
    scene.materials.push_back(scene.materials[0]);
    scene.bodies[1].material = 1;
    CHECK_NOTHROW(make_simulation(scene, with_method("enog")));
    scene.materials[1].youngs_modulus *= 2;
    const std::string error = message<SceneError>(scene, with_method("enog"));
    CHECK(contains(error, "one material; body 'disc' has 'rubber', but body 'ring' has 'rubber'; methods"));
    scene.bodies[0].parts = {{1, [](const Point& x) { return x[0] < -0.0081 ? 1.0 : 0.0; }}};
    scene.materials[1].name = "hard";
    CHECK(contains(message<SceneError>(scene, with_method("enog")),
                   "one material; body 'ring' has 'hard' and 'rubber'; methods"));
  }

  TEST_CASE("settings: constants have the bounds of the scene's dimension") {
    Settings settings = with_method("oenog");
    settings.constants = {{"h", 1.2}};
    Scene scene = small_collision();
    CHECK_NOTHROW(make_simulation(scene, settings));
    scene.dim = 3;
    CHECK(contains(message<UsageError>(scene, settings), "it must be from 0.87 to 0.99"));
  }

  TEST_CASE("divergence: a far too large step gives an error with step, time and particle") {
    const Scene scene = small_collision();
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      Settings settings = with_method(std::string(method.name));
      settings.cfl = 5;
      for (const MethodConstant& constant : method.constants)  // this dissipation would stabilise the run
        if (constant.name.starts_with("eps_")) settings.constants[std::string(constant.name)] = 0;
      const auto simulation = make_simulation(scene, settings);
      const auto particles = static_cast<long>(simulation->snapshot().size());
      try {
        simulation->advance_to(0.01);
        FAIL("the run did not diverge");
      } catch (const NumericalError& error) {
        const double longest_step = 5 * 1.3 * scene.spacing / scene.materials[0].sound_speed();
        CHECK(error.step > 0);
        CHECK(error.step < 100);
        CHECK(error.time > 0);
        CHECK(error.time < static_cast<double>(error.step + 1) * longest_step);
        CHECK(error.particle >= 0);
        CHECK(error.particle < particles);
        CHECK(error.field == "velocity");
        CHECK(contains(error.what(), "particle " + std::to_string(error.particle)));
      }
    }
  }

  TEST_CASE("divergence: the error names the first of the too fast particles in creation order") {
    Scene scene = small_collision();
    const double c0 = scene.materials[0].sound_speed();
    scene.bodies[0].velocity = {};
    const auto thrown_off = [](const Point& x) { return x[1] > -0.0165; };
    scene.bodies[1].velocity = {[=](const Point& x) { return thrown_off(x) ? 11 * c0 : 0.0; }, {}, {}};
    // the solver stores this body first
    scene.bodies[1].shapes = {Box{{-0.04, -0.02, 0}, {-0.035, -0.015, 0}}};
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      const auto simulation = make_simulation(scene, with_method(std::string(method.name)));
      const Snapshot& start = simulation->snapshot();
      std::size_t first = 0;
      while (start.body[first] != 1 || !thrown_off(start.initial(first))) ++first;
      try {
        make_steps(*simulation, 1);
        FAIL("the fast particles were not noticed");
      } catch (const NumericalError& error) {
        CHECK(std::cmp_equal(error.particle, first));
      }
    }
  }

  TEST_CASE("divergence: a whole body may be fast") {
    Scene scene = small_collision();
    const double fast = 300 * scene.materials[0].sound_speed();
    scene.bodies.resize(1);
    scene.bodies[0].velocity = {constant(fast), constant(-fast), {}};
    for (const MethodInfo& method : methods()) {
      CAPTURE(std::string(method.name));
      const auto simulation = make_simulation(scene, with_method(std::string(method.name)));
      const Snapshot start = simulation->snapshot();
      make_steps(*simulation, 5);
      const double way = fast * simulation->time();
      CHECK(simulation->snapshot().x[0] - start.x[0] == relative(way, 1e-9));
      CHECK(simulation->snapshot().x[1] - start.x[1] == relative(-way, 1e-9));
    }
  }

  TEST_CASE("divergence: the error does not depend on the number of threads") {
    Settings settings = with_method("enog");
    settings.cfl = 5;
    const auto where = [&](int threads) {
      settings.threads = threads;
      const auto simulation = make_simulation(small_collision(), settings);
      try {
        simulation->advance_to(0.01);
      } catch (const NumericalError& error) {
        return std::tuple{error.step, error.time, error.particle};
      }
      return std::tuple{-1L, 0.0, -1L};
    };
    CHECK(std::get<0>(where(1)) > 0);
    CHECK(where(2) == where(1));
    CHECK(where(3) == where(1));
  }
}

}  // namespace of_this_file
