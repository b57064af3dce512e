#include <string>

#include <doctest/doctest.h>

#include "cli/text/json.hpp"
#include "cli/text/json_cursor.hpp"
#include "engine/error.hpp"

using namespace taut;
using namespace taut::cli;

TEST_SUITE("unit") {
  TEST_CASE("JSON with many siblings, keys or leaves does not take quadratic time") {
    constexpr int many = 300000;
    std::string items = "[{}", object = "{\"k\": 1";
    for (int k = 1; k < many; ++k) {
      items += ",{}";
      object += ",\"k" + std::to_string(k) + "\": " + std::to_string(k);
    }
    CHECK(parse_json(items + "]", "a.json").items().size() == many);
    const Json keys = parse_json(object + "}", "a.json");
    CHECK(keys.members().size() == many);
    CHECK(keys.leaves().back() == Json::Member("/k299999", 299999U));
  }

  TEST_CASE("JSON is read with its types and order, and its leaves have pointers") {
    const Json json = parse_json(
        R"({"b": [1, -2, 3.5, "x", true, null, [], {}], "a/~": {"c": "\u00e9"}, "big": 18446744073709551615})",
        "a.json");
    CHECK(json.dump() ==
          R"({"b":[1,-2,3.5,"x",true,null,[],{}],"a/~":{"c":"é"},"big":18446744073709551615})");
    std::string leaves;
    for (const auto& [pointer, value] : json.leaves()) leaves += pointer + "=" + value.dump() + " ";
    // clang-format off
    CHECK(leaves ==
  R"(/b/0=1 /b/1=-2 /b/2=3.5 /b/3="x" /b/4=true /b/5=null /b/6=null /b/7=null /a~1~0/c="é" /big=18446744073709551615 )");
    // clang-format on
    for (const char* wrong : {"", "{", "[1,]", "{\"a\": 1, \"a\": 2}", "1 2", "1e999", "\"\x80\""})
      CHECK_THROWS_AS(parse_json(wrong, "a.json"), UsageError);
    for (const std::string innermost : {"", "1", "{}"}) {
      const auto nested = [&](std::size_t levels) {
        const std::size_t arrays = levels - (innermost == "{}");
        return std::string(arrays, '[') + innermost + std::string(arrays, ']');
      };
      CHECK_NOTHROW(parse_json(nested(64), "a.json"));
      CHECK_THROWS_AS(parse_json(nested(65), "a.json"), UsageError);
    }
  }

  TEST_CASE("a cursor that reads texts as numbers also does so below keys and in arrays") {
    const std::string file = "a.json";
    const Json json = parse_json(R"({"a": ["1.5", "x"], "b": "2"})", file);
    const JsonCursor cursor(json, file, "", /*texts_are_numbers=*/true);
    CHECK(cursor.at("b").number() == 2.0);
    CHECK(cursor.at("a").items()[0].number() == 1.5);
    CHECK(cursor.at("a").items()[1].number() == std::nullopt);
  }
}
