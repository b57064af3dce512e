#include <fstream>
#include <string>
#include <tuple>

#include <doctest/doctest.h>

#include "tests/support/program_runner.hpp"

using namespace taut::cli;
using namespace taut::test;

TEST_SUITE("cli") {
  TEST_CASE("two bodies that start less than a spacing apart under sph are told of") {
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
              .find("bodies 'a' and 'b' start 1.5 spacings apart, within the kernel's reach of 2.6: under "
                    "contact = "
                    "\"sph\" they may hold together as one body") != std::string::npos);
    const auto is_told = [&](const std::string& above, const std::string& low) {
      return told(above, low).find("hold together") != std::string::npos;
    };
    CHECK(is_told("method = \"ulsph-av-as\"\ncontact = \"sph\"\n", "1"));
    CHECK_FALSE(is_told("method = \"enog\"\n", "1.1"));
    CHECK_FALSE(is_told("method = \"enog\"\ncontact = \"penalty\"\n", "1.05"));
    CHECK_FALSE(is_told("method = \"oenog\"\n", "1.05"));
  }
}
