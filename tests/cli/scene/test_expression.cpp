#include <atomic>
#include <cmath>
#include <numbers>
#include <thread>

#include <doctest/doctest.h>

#include "cli/scene/expression.hpp"

using taut::cli::ExpressionError;
using taut::cli::Names;

namespace {

ExpressionError error_of(const std::string& text, const Names& names = {}) {
  try {
    taut::cli::evaluate(text, names);
  } catch (const ExpressionError& error) {
    return error;
  }
  FAIL("no error for ", text);
  return {"", 0};
}

bool says(const ExpressionError& error, const char* part) {
  return std::string(error.what()).find(part) != std::string::npos;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("an expression evaluates names, numbers and functions") {
    CHECK(taut::cli::evaluate("2*a + b", {{"a", 3}, {"b", 0.5}}) == 6.5);
    CHECK(taut::cli::evaluate("-2^2", {}) == -4);
    CHECK(taut::cli::evaluate("1.5e-3", {}) == 1.5e-3);
    CHECK(taut::cli::evaluate("cos(pi)", {}) == -1);
    CHECK(taut::cli::evaluate("sqrt(16) + cosh(0) + sinh(0)", {}) == 5);
    CHECK(taut::cli::evaluate(" 1\n + 2 ", {}) == 3);
  }

  TEST_CASE("comparisons give 1 or 0, and ? : selects") {
    CHECK(taut::cli::evaluate("a < 0", {{"a", -1}}) == 1);
    CHECK(taut::cli::evaluate("a >= 0", {{"a", -1}}) == 0);
    CHECK(taut::cli::evaluate("a == 2 && a <= 2 || 0", {{"a", 2}}) == 1);
    CHECK(taut::cli::evaluate("a != 2", {{"a", 2}}) == 0);
    CHECK(taut::cli::evaluate("a >= 0 ? 10*a : 7", {{"a", 2}}) == 20);
    CHECK(taut::cli::evaluate("a >= 0 ? 10*a : 7", {{"a", -2}}) == 7);
  }

  TEST_CASE("an expression compiles to a function of the position") {
    const auto f = taut::cli::compile("x < 0 ? 0 : a*x + 10*y + 100*z", {{"a", 2}});
    CHECK(f({1, 2, 3}) == 322);
    CHECK(f({-1, 2, 3}) == 0);
    const auto copy = f;
    CHECK(copy({3, 0, 0}) == 6);
    CHECK(f({1, 0, 0}) == 2);
  }

  TEST_CASE("an expression compiles to a function of position and time") {
    const taut::Solution f = taut::cli::compile_in_time("a*x + y - z*t", {{"a", 2}});
    CHECK(f({1, 2, 3}, 10) == -26);
    CHECK(f({1, 2, 3}, 0) == 4);
    CHECK_THROWS_AS(taut::cli::compile("t", {}), ExpressionError);
  }

  TEST_CASE("names_in returns the names of an expression, without functions and constants") {
    CHECK(taut::cli::names_in("2*a + sin(b1)*1e5 + pi") == std::set<std::string>{"a", "b1"});
    CHECK(taut::cli::names_in("a + (").empty());
  }

  TEST_CASE("values that are not finite are returned to the caller") {
    CHECK(std::isinf(taut::cli::evaluate("1/0", {})));
    CHECK(std::isnan(taut::cli::evaluate("sqrt(-1)", {})));
  }
}

TEST_SUITE("cli") {
  TEST_CASE("an unknown name is an error with its place, the nearest name and all names") {
    const ExpressionError error = error_of("2*vo", {{"v0", 1}, {"length", 2}});
    CHECK(error.offset == 2);
    CHECK(says(error, "unknown name 'vo' in '2*vo' (did you mean 'v0'?)"));
    CHECK(says(error, "length, v0, pi"));
    CHECK(says(error_of("sin(x)"), "unknown name 'x'"));
    CHECK(says(error_of("sqr(4)"), "'sqrt'"));
    CHECK(says(error_of("_pi"), "did you mean 'pi'"));
  }

  TEST_CASE("a text that is not an expression is an error with the reason") {
    CHECK(says(error_of("(1 + 2"), "is not an expression"));
    CHECK(says(error_of("1 2"), "is not an expression"));
    CHECK(error_of("1 2").offset == 2);
    CHECK(says(error_of("!a", {{"a", 1}}), "was not expected"));
    CHECK(says(error_of("1, 2"), "several values"));
    CHECK(says(error_of("  "), "empty"));
    CHECK(says(error_of("a = 2", {{"a", 1}}), "write '=='"));
    CHECK_THROWS_AS(taut::cli::compile("x = 2", {}), ExpressionError);
  }

  TEST_CASE("two threads can call copies of a function at once") {
    const auto function = taut::cli::compile("2*x + y*z", {});
    const auto in_time = taut::cli::compile_in_time("x - t", {});
    std::atomic<int> ready = 0;
    const auto wrong_of = [&ready](const auto f, auto g, double from) {
      int wrong = 0;
      for (++ready; ready < 2;) std::this_thread::yield();
      for (int k = 0; k < 200000; ++k) {
        const double x = from + k;
        wrong += f({x, 1, 3}) != 2 * x + 3 || g({x, 0, 0}, 1) != x - 1;
      }
      return wrong;
    };
    int other = 0;
    std::thread second([&] { other = wrong_of(function, in_time, 1e6); });
    const int own = wrong_of(function, in_time, 0);
    second.join();
    CHECK(own == 0);
    CHECK(other == 0);
  }

  TEST_CASE("names and texts beyond the limits of muParser are errors") {
    const std::string longest(100, 'v'), longer(101, 'v');
    CHECK(taut::cli::evaluate(longest, {{longest, 3}}) == 3);
    CHECK(says(error_of("1", {{longer, 3}}), "a name has at most 100 letters"));
    CHECK(says(error_of(longer), "at most 100 letters"));
    CHECK_THROWS_AS(taut::cli::compile_of_values("t", {}, {longer}), ExpressionError);
    CHECK(taut::cli::names_in(longer + " + 1").empty());
    CHECK(says(error_of(std::string(20001, '1')), "has 20001 letters; at most 20000 are allowed"));
  }

  TEST_CASE("a message shortens long texts and escapes unprintable characters") {
    const std::string deep = std::string(2000, '(') + "1";
    CHECK(says(error_of(deep), "((…"));
    CHECK(std::string(error_of(deep).what()).size() < 600);
    CHECK(says(error_of(std::string("1\0 2", 4)), "1\\x00 2"));
    CHECK(says(error_of("1 \x1b[2J"), "1 \\x1b[2J"));
    CHECK(says(error_of("1 \xff µ"), "1 \\xff \\xc2\\xb5"));
    CHECK(says(error_of("1 µ"), "'1 µ'"));
  }
}
