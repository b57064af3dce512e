#include <set>

#include <doctest/doctest.h>

#include "cli/sweep/grid.hpp"
#include "engine/error.hpp"

using namespace taut;
using namespace taut::cli;
using Texts = std::vector<std::string>;

namespace {

std::string error_of(const std::string& values) {
  try {
    parse_values(values);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("sweep grid: a range includes both ends and has no round-off") {
    CHECK(parse_values("0.02:0.16:0.02") ==
          Texts{"0.02", "0.04", "0.06", "0.08", "0.1", "0.12", "0.14", "0.16"});
    CHECK(parse_values("0.1:0.3:0.1") == Texts{"0.1", "0.2", "0.3"});  // although 0.1 + 2*0.1 > 0.3
    CHECK(parse_values("0:0.7:0.1").size() == 8);                      // although 0.7/0.1 < 7
    CHECK(parse_values("-0.3:0.3:0.1") == Texts{"-0.3", "-0.2", "-0.1", "0", "0.1", "0.2", "0.3"});
    CHECK(parse_values("3:1:-1") == Texts{"3", "2", "1"});
    CHECK(parse_values("5:5:1") == Texts{"5"});
    CHECK(parse_values("1e-6:3e-6:1e-6") == Texts{"1e-06", "2e-06", "3e-06"});
    CHECK(parse_values("1e6:1e6+2:1") == Texts{"1e+06", "1000001", "1000002"});
    CHECK(parse_values("0:pi:pi/4").size() == 5);
  }

  TEST_CASE("sweep grid: a list can contain ranges and expressions") {
    CHECK(parse_values("og,oas, enog") == Texts{"og", "oas", "enog"});
    CHECK(parse_values("0.060,6e-1,7") == Texts{"0.06", "0.6", "7"});
    CHECK(parse_values("1,10:30:10") == Texts{"1", "10", "20", "30"});
    CHECK(parse_values("max(dp,0.001),dp") == Texts{"max(dp,0.001)", "dp"});
    CHECK(parse_values("dp<1 ? 2 : 3") == Texts{"dp<1 ? 2 : 3"});
  }

  TEST_CASE("sweep grid: an invalid range or list is refused with the reason") {
    CHECK(says(error_of("0.1:0.4"), "lo:hi:step"));
    CHECK(says(error_of("0:1:x"), "'x' is not a number"));
    CHECK(says(error_of("0:1:0"), "a step of 0"));
    CHECK(says(error_of("0:1:-1"), "does not lead from 0 to 1"));
    CHECK(says(error_of("0:1:0.3"), "could end at 0.9 or 1.2"));
    CHECK(says(error_of("0:1:0.33"), "does not divide the range"));
    CHECK(says(error_of("0:1:0.33333"), "does not divide the range"));
    CHECK(says(error_of("0:1:1e-9"), "more than"));
    CHECK(says(error_of("1,,2"), "empty value"));
    CHECK(says(error_of("0.06,0.1,0.060"), "0.06 twice"));
    CHECK_THROWS_AS(parse_axis("v0"), UsageError);
    CHECK_THROWS_AS(parse_axis("=1"), UsageError);
    CHECK(parse_axis("v0=1,2").values[1].value == "2");
  }

  TEST_CASE("sweep grid: rows are all combinations, and the last name varies fastest") {
    Texts rows;
    for (const GridRow& row : all_combinations({parse_axis("a=1,2"), parse_axis("b=x,y,z")}))
      rows.push_back(text_of(row));
    CHECK(rows == Texts{"a=1, b=x", "a=1, b=y", "a=1, b=z", "a=2, b=x", "a=2, b=y", "a=2, b=z"});
    CHECK_THROWS_AS(all_combinations({parse_axis("a=1"), parse_axis("a=2")}), UsageError);
    CHECK_THROWS_AS(all_combinations({parse_axis("a=1:200:1"), parse_axis("b=1:200:1")}), UsageError);
    const GridRow row{{"a", "1", {}}};
    CHECK_THROWS_AS(check_rows({row, row}), UsageError);
    CHECK_NOTHROW(check_rows({row, {{"a", "2", {}}}}));
  }

  TEST_CASE("sweep grid: a folder is named by its run's settings, without special characters of shells") {
    CHECK(folder_name({{"v0", "0.06", {}}, {"method.zeta", "3.5", {}}}) == "v0=0.06_method.zeta=3.5");
    CHECK(folder_name({}) == "as-it-stands");
    const GridRow long_row{{"a", std::string(300, '1'), {}}}, other_row{{"a", std::string(301, '1'), {}}};
    std::set<std::string> names;
    for (const GridRow& row : {GridRow{{"a", "max(dp,1)", {}}}, GridRow{{"a", "max(dp;1)", {}}},
                               GridRow{{"a", "$x `b` 'c' \"d\" /..", {}}}, long_row, other_row}) {
      const std::string name = folder_name(row);
      CAPTURE(name);
      CHECK(name.size() <= 100);
      CHECK(name.starts_with("a="));
      CHECK(name.find_first_of(" $`'\"/(),;*?&|<>") == std::string::npos);
      CHECK(folder_name(row) == name);
      names.insert(name);
    }
    CHECK(names.size() == 5);
  }
}
