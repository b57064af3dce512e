#include <doctest/doctest.h>

#include "cli/text/suggest.hpp"

using taut::cli::did_you_mean;
using taut::cli::known_names;
using taut::cli::nearest;
using Names = std::vector<std::string>;

TEST_SUITE("unit") {
  TEST_CASE("nearest names are few edits away, the nearest first") {
    const Names methods = {"og", "oas", "enog", "oenog"};
    CHECK(nearest("enogg", methods) == Names{"enog"});
    CHECK(nearest("oneog", methods) == Names{"oenog"});  // a swap is one edit
    CHECK(nearest("eno", methods) == Names{"enog", "oenog"});
    CHECK(nearest("viridis", methods).empty());
  }

  TEST_CASE("nearest names ignore case and match parts of names") {
    CHECK(nearest("ENOG", {"enog"}) == Names{"enog"});
    CHECK(nearest("rings", {"colliding-rings", "ball-plate"}) == Names{"colliding-rings"});
    CHECK(nearest("l", {"L", "H"}) == Names{"L"});
    CHECK(nearest("", {"L", "H"}).empty());
    CHECK(nearest("abcd", {"abce", "abcf", "abcg", "abch", "abci", "abcj"}).size() == 5);
  }

  TEST_CASE("did_you_mean proposes the nearest names") {
    CHECK(did_you_mean("enogg", {"enog"}) == " (did you mean 'enog'?)");
    CHECK(did_you_mean("eno", {"enog", "oenog"}) == " (did you mean 'enog' or 'oenog'?)");
    CHECK(did_you_mean("viridis", {"enog"}).empty());
  }

  TEST_CASE("the message for an unknown name lists all of a few names, and at most five of many") {
    CHECK(known_names("xyz", {"sph", "penalty"}) == "; there are: sph, penalty");
    CHECK(known_names("sp", {"sph", "penalty"}) == " (did you mean 'sph'?); there are: sph, penalty");
    CHECK(known_names("sph", {}) == "; there is none");
    const Names many{"aaa", "bbb", "ccc", "ddd", "eee", "fff", "ggg", "hhh", "hhi"};
    CHECK(known_names("hhh", many) == " (did you mean 'hhh' or 'hhi'?)");
    CHECK(known_names("zzz", many) == "; the nearest of 9 names: aaa, bbb, ccc, ddd, eee");
  }
}
