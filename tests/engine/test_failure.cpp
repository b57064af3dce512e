#include <doctest/doctest.h>
#include "engine/verdict.hpp"
#include "engine/measures.hpp"
#include "tests/engine/runs.hpp"
#include "tests/engine/scenes.hpp"
using namespace taut;
using namespace taut::test;
TEST_SUITE("failure") {
  TEST_CASE("explore rings") {
    const Scene scene = colliding_rings();
    for (const char* m : {"og", "oas", "enog"}) {
      const auto simulation = make_simulation(scene, with_method(m));
      Judge judge(scene, simulation->snapshot(), simulation->support());
      for (int k = 1; k <= 12; ++k) {
        simulation->advance_to(0.0005 * k);
        judge.look(simulation->snapshot(), balance(simulation->snapshot(), scene));
        printf("%s %g pieces %d verdict %s\n", m, simulation->time(), judge.pieces(), std::string(name(judge.verdict())).c_str());
      }
    }
  }
  TEST_CASE("explore plate") {
    for (const char* m : {"og", "enog", "oas", "enog-nonconservative"}) {
      for (double vf : {0.05, 0.001}) {
      const Scene scene = oscillating_plate(vf);
      const auto simulation = make_simulation(scene, with_method(m));
      for (int k = 1; k <= 30; ++k) {
        simulation->advance_to(0.003 * k);
        if (k%5==1) printf("%s vf %g t %g tip %.6g\n", m, vf,simulation->time(), simulation->series().value[0].back());
      }
      double peak=0; for (double y: simulation->series().value[0]) peak=std::max(peak,y);
      printf("%s vf %g peak %g\n", m,vf,peak);
    }}
  }
}
