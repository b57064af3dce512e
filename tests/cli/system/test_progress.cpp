#include <algorithm>
#include <sstream>
#include <string>

#include <doctest/doctest.h>

#include "cli/system/progress.hpp"

using namespace taut::cli;

TEST_SUITE("cli") {
  TEST_CASE("progress: only a time left of half a day or more counts as long") {
    constexpr double hour = 3600, day = 24 * hour;
    CHECK(long_time_left(0.5, 0.5, hour).empty());
    CHECK(long_time_left(1e-3, 0.999, 60) == "17 hours");
    CHECK(long_time_left(0.01, 0.99, hour) == "4 days");
    CHECK(long_time_left(1e-12, 1, 10) == "centuries");
    CHECK(long_time_left(1e-12, 1, 0.5).empty());  // too early for an estimate
    CHECK(long_time_left(0.9, 0.1, 10 * day) == "27 hours");
    CHECK(long_time_left(0, 1, 60).empty());
    CHECK(long_time_left(0, 1, day).empty());
  }

  TEST_CASE("progress: the time left follows from the pace of this process, not of the resumed run") {
    CHECK(time_left(0.5, 0, 10) == "0:10 left");
    CHECK(time_left(0.5, 0.4, 10) == "0:50 left");
    CHECK(time_left(0.403, 0.4, 10).empty());
  }

  TEST_CASE("progress: in few columns the name is cut, but not the time left") {
    const std::string name = "oscillating-plate-3d, enog-nonconservative, 43923 particles";
    for (const std::size_t width : {30, 40, 79, 100, 200}) {
      CAPTURE(width);
      const std::string line = bar_line(name, 0.4, "0:12 left", "2.1 M particle-steps/s", width);
      CHECK(line.size() <= std::max<std::size_t>(width, 48));
      CHECK(line.starts_with("oscillatin"));
      CHECK(line.find("] 40 %  0:12 left") != std::string::npos);
      CHECK((line.find("particle-steps/s") != std::string::npos) == (width >= 200));
      CHECK(bar_line(name, 0.4, "", "", width).find(']') - bar_line(name, 0.4, "", "", width).find('[') ==
            line.find(']') - line.find('['));
    }
    CHECK(bar_line("rings", 1, "0:00 left", "", 60) ==
          "rings [" + std::string(29, '#') + "] 100 %  0:00 left");
  }

  TEST_CASE("progress: a terminal shows the set-up until the work begins") {
    for (const auto style : {Progress::Style::bar, Progress::Style::lines, Progress::Style::none}) {
      std::ostringstream err;
      {
        Progress progress(err, style);
        progress.prepare("rings, setting up");
        CHECK(err.str() == (style == Progress::Style::bar ? "\rrings, setting up\x1b[K" : ""));
      }
      if (style == Progress::Style::bar) CHECK(err.str().ends_with("\r\x1b[K"));  // removes the line
    }
  }
}
