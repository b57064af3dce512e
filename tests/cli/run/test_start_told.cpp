#include <algorithm>
#include <fstream>
#include <string>
#include <tuple>
#include <unistd.h>
#include <vector>

#include <doctest/doctest.h>

#include "cli/run/plan.hpp"
#include "tests/support/program_runner.hpp"

using namespace taut::cli;
using namespace taut::test;

TEST_SUITE("cli") {
  TEST_CASE("two bodies whose faces start less than a spacing apart give a warning with contact sph") {
    const TemporaryFolder folder;
    const auto told = [&](const std::string& above, const std::string& low) {
      std::ofstream file(folder / "scene.toml");
      file << "title = \"Two\"\nuntil = 1e-6\nspacing = 0.1\n"
           << above << "[material.rubber]\ndensity = 1000\nyoungs_modulus = 1e7\npoisson_ratio = 0.4\n";
      for (const auto& [name, from, to] : {std::tuple{"a", std::string("0"), "1"}, {"b", low, "2"}})
        file << "[[body]]\nname = \"" << name << "\"\nmaterial = \"rubber\"\n"
             << "shape = { type = \"rectangle\", low = [" << from << ", 0], high = [" << to << ", 0.5] }\n";
      file.close();
      const Outcome outcome =
          call({"run", folder.str("scene.toml"), "--no-render", "--quiet", "--out", folder.str("out")});
      CHECK(outcome.code == 0);
      return outcome.err;
    };
    CHECK(told("method = \"enog\"\n", "1.05")
              .find("bodies 'a' and 'b' start 1.5 spacings apart, within the kernel support of 2.6: "
                    "contact = \"sph\" may join them into one body") != std::string::npos);
    const auto is_told = [&](const std::string& above, const std::string& low) {
      return told(above, low).find("may join them") != std::string::npos;
    };
    CHECK(is_told("method = \"ulsph-av-as\"\ncontact = \"sph\"\n", "1"));
    CHECK_FALSE(is_told("method = \"enog\"\n", "1.1"));
    CHECK_FALSE(is_told("method = \"enog\"\ncontact = \"penalty\"\n", "1.05"));
    CHECK_FALSE(is_told("method = \"oenog\"\n", "1.05"));
  }

  TEST_CASE("a run warns about parts one or two particles thick, and not about round faces") {
    const TemporaryFolder folder;
    const auto warning = [&](const std::string& shape, int dim = 2) {
      std::ofstream(folder / "scene.toml")
          << "title = \"Thin\"\nuntil = 1e-7\nspacing = 0.1\ndim = " + std::to_string(dim) +
                 "\n[material.rubber]\ndensity = 1000\nyoungs_modulus = 1e7\npoisson_ratio = 0.4\n[[body]]\n"
                 "name = \"a\"\nmaterial = \"rubber\"\nshape = " +
                 shape + "\n";
      const Outcome outcome =
          call({"run", folder.str("scene.toml"), "--no-render", "--quiet", "--out", folder.str("out")});
      CHECK(outcome.code == 0);
      const auto at = outcome.err.find("particles thick");
      return at == std::string::npos ? "" : outcome.err;
    };
    const auto box = [](const std::string& high) {
      return "{ type = \"rectangle\", low = [0, 0], high = [" + high + "] }";
    };
    CHECK(contains(warning(box("1, 0.2")),
                   "100 % of the particles of body 'a' are in parts one or two particles thick"));
    CHECK(warning(box("1, 0.3")).empty());
    CHECK(contains(warning("{ type = \"union\", shapes = [" + box("1, 1") + ", " + box("2, 0.2") + "] }"),
                   "thick"));
    for (const std::string radius : {"0.5", "0.73", "0.95", "1.31"}) {
      CAPTURE(radius);
      CHECK(warning("{ type = \"disc\", centre = [0, 0], layout = \"lattice\", radius = " + radius + " }")
                .empty());
      CHECK(warning("{ type = \"ball\", centre = [0, 0, 0], radius = " + radius + " }", 3).empty());
    }
    CHECK(contains(warning("{ type = \"box\", low = [0, 0, 0], high = [1, 1, 0.2] }", 3), "100 %"));
  }

  TEST_CASE("a run warns about a body that starts above its sound speed relative to a wall in its way") {
    const TemporaryFolder folder;
    const auto warns = [&](const std::string& modulus, const std::string& more) {
      std::ofstream(folder / "scene.toml")
          << "title = \"Fast\"\nuntil = 1e-7\nspacing = 0.1\n[material.rubber]\ndensity = 1000\n"
             "youngs_modulus = " +
                 modulus +
                 "\npoisson_ratio = 0.4\n[[body]]\nname = \"a\"\nmaterial = \"rubber\"\n"
                 "velocity = [5, 0]\nshape = { type = \"rectangle\", low = [0, 0], high = [1, 0.5] }\n" +
                 more;
      const Outcome outcome =
          call({"run", folder.str("scene.toml"), "--no-render", "--quiet", "--out", folder.str("out")});
      CHECK(outcome.code == 0);
      return outcome.err.find("body 'a' starts at ") != std::string::npos;
    };
    const std::string wall = "[[wall]]\nname = \"w\"\nat = [9, 0]\nnormal = [-1, 0]\n";
    CHECK(warns("10", wall));  // 10 MPa given as 10 Pa: c0 is 0.13 m/s
    CHECK_FALSE(warns("1e7", wall));
    CHECK_FALSE(warns("10", ""));
  }

  TEST_CASE(
      "a probe of a reaction or contact force gives a warning if the method does not conserve momentum") {
    const TemporaryFolder folder;
    const auto is_told = [&](const std::string& method, const std::string& probe,
                             const std::vector<std::string>& more = {}) {
      std::ofstream(folder / "scene.toml")
          << "title = \"Held\"\nuntil = 1e-6\nspacing = 0.1\n[material.rubber]\ndensity = 1000\n"
             "youngs_modulus = 1e7\npoisson_ratio = 0.4\n[[body]]\nname = \"a\"\nmaterial = \"rubber\"\n"
             "held = \"x < 0.2\"\nshape = { type = \"rectangle\", low = [0, 0], high = [1, 0.5] }\n"
             "[[probe]]\nname = \"f\"\nbody = \"a\"\ncomponent = \"x\"\nof = \""
          << probe << "\"\n[[wall]]\nname = \"floor\"\nat = [0, -1]\nnormal = [0, 1]\n";
      std::vector<std::string> arguments{
          "run",   folder.str("scene.toml"), "--method", method, "--no-render", "--quiet",
          "--out", folder.str("out")};
      arguments.insert(arguments.end(), more.begin(), more.end());
      const Outcome outcome = call(arguments);
      CHECK(outcome.code == 0);
      return outcome.err.find("reaction and contact forces of " + method + " do not balance the loads") !=
             std::string::npos;
    };
    CHECK(is_told("d-ulsph-r-tic", "reaction"));
    CHECK(is_told("d-ulsph-r-tic", "contact_force\"\nwall = \"floor"));
    CHECK_FALSE(is_told("d-ulsph-r-tic", "mean_velocity"));
    CHECK_FALSE(is_told("d-ulsph-av-as", "reaction"));
    CHECK_FALSE(is_told("oenog", "reaction"));
    CHECK(is_told("gnog-amc", "reaction", {"--set", "method.penalty_rotation=1"}));
    CHECK_FALSE(is_told("gnog-amc", "reaction"));
    const std::vector<std::string> one_sided{"--set", "method.internal_force=one-sided"};
    CHECK_FALSE(is_told("pf", "reaction", one_sided));  // projection restores momentum
    CHECK(is_told("pf", "reaction", {one_sided[0], one_sided[1], "--set", "method.projection=0"}));
  }

  TEST_CASE("a scene can be read from a pipe, and the run folder's name contains the settings") {
    const TemporaryFolder folder;
    const std::string text = text_of(write_tiny_scene(folder));
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    REQUIRE(::write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size()));
    ::close(ends[1]);
    RunOptions options;
    options.scene = "/dev/fd/" + std::to_string(ends[0]);
    options.settings = {{"spacing", "0.004"}, {"until", "0.001"}};
    const RunPlan plan = make_plan(options);
    ::close(ends[0]);
    CHECK(plan.folder.path() == "out/" + std::to_string(ends[0]) + "-enog-spacing=0.004-until=0.001");
  }

  TEST_CASE(
      "the report explains an energy drift by the way in which the method computes or dissipates energy") {
    const TemporaryFolder folder;
    const auto note_of = [&](const std::string& method) {
      const Outcome outcome = call({"run", "colliding-rings", "--method", method, "--spacing", "0.005",
                                    "--until", "4e-3", "--no-render", "--quiet", "--out", folder.str("out")});
      const auto record = json_of(folder / "out/run.json");
      const std::string note = record.contains("energy_note") ? record["energy_note"] : "";
      CHECK(record["conservation"]["energy"].get<double>() ==
            std::max(record["conservation"]["energy_gained"].get<double>(),
                     record["conservation"]["energy_lost"].get<double>()));
      CHECK((note.empty() || outcome.out.find("  energy      " + note + "\n") != std::string::npos));
      return note;
    };
    CHECK(note_of("enog").find("enog recovers its strain energy for display only") != std::string::npos);
    CHECK(note_of("pf-jst").find("was lost, dissipated by the method") != std::string::npos);
    CHECK(note_of("ulsph-av-as").find("ulsph-av-as integrates a stress rate and has no potential energy") !=
          std::string::npos);
  }

  TEST_CASE("the report states why a measure has no reference") {
    const TemporaryFolder folder;
    const auto reported = [&](const std::vector<std::string>& more) {
      std::vector<std::string> words{"run",  "twisting-column", "--spacing", "0.5",   "--until",
                                     "1e-3", "--no-render",     "--quiet",   "--out", folder.str("out")};
      words.insert(words.end(), more.begin(), more.end());
      return call(words).out;
    };
    CHECK(reported({"--set", "law=mooney-rivlin"})
              .find("the scene's reference is for neo-hookean; pf-jst's law is mooney-rivlin") !=
          std::string::npos);
    CHECK(reported({"--set", "poisson_ratio=0.4"}).find("the scene's reference holds for other parameters") !=
          std::string::npos);
  }
}
