#include <doctest/doctest.h>

#include "cli/scene/scene_file.hpp"
#include "cli/scene/shipped.hpp"
#include "cli/scene/toml_cursor.hpp"
#include "engine/layout/initial_particles.hpp"
#include "tests/support/scene_text.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

std::string usage_error(const std::vector<Setting>& settings) {
  try {
    read_text(small_scene, settings);
  } catch (const UsageError& error) {
    return error.what();
  }
  FAIL("no error");
  return "";
}

std::string set_error(const std::string& name, const std::string& value) {
  return usage_error({{name, value}});
}

bool says(const std::string& message, const char* part) {
  const bool found = message.find(part) != std::string::npos;
  if (!found) MESSAGE("expected '", std::string(part), "' in: ", message);
  return found;
}

std::string file_error(const std::filesystem::path& path) {
  try {
    read_scene(path);
  } catch (const SceneError& error) {
    CHECK(error.file == path.string());
    CHECK(error.line == 0);
    return error.what();
  }
  FAIL("no error");
  return "";
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("the small scene is valid") { CHECK_NOTHROW(read_text(small_scene)); }

  TEST_CASE("scene: invalid TOML is refused") {
    check_error("until = 2", "until = @= 2", {"not valid TOML"});
    check_error("until = 2", "until = 2\nuntil = @3", {"not valid TOML", "until"});
  }

  TEST_CASE(
      "scene: unknown, misspelt and missing keys, and a wrong spacing, jitter or coordinate, are refused") {
    check_error("spacing = 0.1", "spacing = @3", {"spacing = 3 m is more than twice the thickness", "1 m"});
    check_error("velocity = [\"v0*c0*x\", 0]", "velocity = [@\"v0*z\", 0]",
                {"uses z, but the scene has dim = 2"});
    check_error("until = 2", "until = 2\njitter = @0.5", {"jitter = 0.5 must be at least 0 and below 0.5"});
    check_error("until = 2", "until = 2\njitter = @\"0.1*dp\"",
                {"must not contain dp, because jitter is in spacings"});
    check_error("until = 2", "until = 2\njitter_seed = @0", {"jitter_seed = 0 must be a whole number"});
    check_error("until = 2", "until = 2\n@methd = \"enog\"",
                {"unknown key 'methd' in the scene", "did you mean 'method'"});
    check_error("[[body]]\nname = \"ring\"", "[[@bdy]]\nname = \"ring\"", {"unknown key 'bdy'", "'body'"});
    check_error("poisson_ratio = 0.4", "poisson_ratio = 0.4\n@colour = 3",
                {"unknown key 'colour' in material 'rubber'", "density, youngs_modulus, poisson_ratio"});
    check_error("density = 1200", "@densty = 1200",
                {"'density' is missing in material 'rubber'", "'densty'"});
    check_error("inner = 1", "inner = 1, @radius = 1",
                {"unknown key 'radius'", "body 'ring'", "centre, inner, outer"});
    check_error("help = \"speed\"", "@hlp = \"speed\"", {"unknown key 'hlp' in parameter 'v0'", "'help'"});
    check_error("component = \"y\"", "component = \"y\"\n@to = [0, 0]", {"unknown key 'to' in probe 'tip'"});
    check_error("unit = \"m\"", "unit = \"m\"\n@threshold = 0",
                {"unknown key 'threshold' in measure 'peak'"});
    check_error("name = \"made up\"", "name = \"made up\"\n@wehn = {}", {"unknown key 'wehn'", "'when'"});
    check_error("color = \"von_mises\"", "color = \"von_mises\"\n@frame = 3",
                {"unknown key 'frame'", "'frames'"});
    check_error("[[body]]\nname = \"ring\"\nshape", "[[body]]\nname = \"ring\"\n@form",
                {"'shape' is missing in body 'ring'; the unknown key 'form' may be meant"});
    check_error("outer = 2 }", "@diameter = 4 }",
                {"'outer' is missing in the shape of body 'ring'", "'diameter' may be meant"});
  }

  TEST_CASE("scene: a known key without effect is refused") {
    check_error("material = \"rubber\"\nvelocity",
                "material = \"rubber\"\nwithout = { type = \"disc\", centre = [0, 0], radius = 0.1, "
                "@layout = \"lattice\" }\nvelocity",
                {"'layout' has no effect in the without of body"});
  }

  TEST_CASE("a reader that reads a key outside the table of its section throws a logic error") {
    constexpr KeyInfo keys[] = {{"low", types::number(), "", ""}};
    TomlSource source;
    TomlValue table = parse_toml("low = 1", "a file");
    TomlCursor cursor(table, "", "the table", keys, {}, source);
    CHECK(cursor.number("low") == 1);
    CHECK_THROWS_AS(cursor.find("high"), std::logic_error);
    CHECK_THROWS_AS(keys_of("no such section"), std::logic_error);
  }

  TEST_CASE("scene: values of a wrong type are refused") {
    check_error("title = \"Small\"", "title = @3", {"title must be a text", "a number"});
    check_error("until = 2", "until = @[2]", {"until must be a number or an expression", "an array"});
    check_error("until = 2", "until = @2020-01-01", {"until", "a date"});
    check_error("density = 1200", "density = @true", {"density", "a boolean"});
    check_error("low = [0, 0]", "low = @[0]", {"low must be an array of 2 numbers", "not an array of 1"});
    check_error("low = [0, 0]", "low = @0", {"low must be an array of 2 numbers", "a number"});
    check_error("velocity = [\"v0*c0*x\", 0]", "velocity = @\"v0*c0*x\"", {"velocity must be an array of 2"});
    check_error("{ value = 0.06, unit = \"c0\", help = \"speed\", min = 0, max = 0.5 }", "@0.06",
                {"parameter 'v0' must be a table", "a number"});
    check_error("shape = { type = \"rectangle\", low = [0, 0], high = [2, 1] }", "shape = @\"rectangle\"",
                {"shape of body 'block' must be a table", "a text"});
    check_error("shape = { type = \"rectangle\", low = [0, 0], high = [2, 1] }", "shape = @[]",
                {"is empty; it must have at least one rectangle, disc, ring, "});
  }

  TEST_CASE(
      "scene: names, titles and texts above their length limits, or with forbidden characters, are refused") {
    const std::string name(101, 'v'), title(201, 'a');
    check_error("[parameters]", "[parameters]\n@" + name + " = { value = 1 }", {"at most 100 letters"});
    check_error("name = \"tip\"", "name = @\"" + name + "\"", {"at most 100 letters"});
    check_error("\"Small\"", "@\"" + title + "\"", {"title has 201 bytes", "at most 200"});
    check_error("\"Small\"", "@\"a\\nb\"", {"title", "one line", "'a\\x0ab'"});
    check_error("title =", "name = @\"../../evil\"\ntitle =", {"name = '../../evil' must not contain '/'"});
    check_error("title =", "name = @\"..\"\ntitle =", {"must not contain '/'"});
    check_error("help = \"speed\"", "help = @\"" + title + "\"", {"help has 201 bytes"});
    std::string parts;
    for (int k = 0; k < 100000; ++k) parts += "a.";
    check_error("[render]", "[@" + parts + "b]\n[render]", {"a key has more than 16 parts"});
    check_error("[render]", "@" + parts + "b = 1\n[render]", {"a key has more than 16 parts"});
    check_error("v0 = {", "v0 = { @" + parts + "b = 1, ", {"a key has more than 16 parts"});
    CHECK_NOTHROW(read_text(replaced(small_scene, "\"Small\"", "'" + std::string(100, '.') + "'")));
    // [TOML 1.0, String]: a multi-line string ends in three to five quotes
    for (const std::string text : {R"("""x"""")", R"("""x""""")", "'''x''''", "'''x'''''", R"("""\"""")"}) {
      CAPTURE(text);
      check_error("\"Small\"", text + " # \\\n@" + parts + "b = 1", {"a key has more than 16 parts"});
      check_error("v0 = {", "v1 = { unit = " + text + ", @" + parts + "b = 1 }\nv0 = {",
                  {"a key has more than 16 parts"});
    }
  }

  TEST_CASE("scene: more than 500 parameters are refused") {
    std::string more;
    for (int k = 0; k < 501; ++k) more += "p" + std::to_string(k) + " = { value = 1, default = 1 }\n";
    check_error("v0 = { value", more + "@v0 = { value", {"has 502 parameters; at most 500 are allowed"});
  }

  TEST_CASE("scene: invalid expressions are refused") {
    check_error("\"v0*c0*x\"", "\"v0 + 2*@vo\"", {"unknown name 'vo'", "did you mean 'v0'", "c0"});
    check_error("until = 2", "until = \"2*@x\"", {"unknown name 'x'", "known names", "v0"});
    check_error("until = 2", "until = \"2*(v0@\"", {"not an expression"});
    check_error("until = 2", "until = @\"1/0\"", {"until is inf", "finite"});
    check_error("until = 2", "until = @nan", {"until is nan", "finite"});
    check_error("density = 1200", "density = @inf", {"density is inf"});
    check_error("spacing = 0.1", "spacing = @\"dp/2\"", {"depends on dp"});
  }

  TEST_CASE("scene: a velocity that is not finite throws when it is evaluated") {
    const MarkedScene marked("\"v0*c0*x\"", "@\"v0/x\"");
    const SceneFile file = read_text(marked.text);
    CHECK(file.scene.bodies[0].velocity[0]({0.5, 0, 0}) == 0.12);
    try {
      file.scene.bodies[0].velocity[0]({0, 1, 0});
      FAIL("no error");
    } catch (const SceneError& error) {
      CHECK(error.line == marked.place.line);
      CHECK(error.column == marked.place.column);
      CHECK(error.key == "body.block.velocity");
      CHECK(says(error.what(), "is inf at (0, 1, 0)"));
    }
  }

  TEST_CASE("scene: invalid parameters are refused") {
    check_error("min = 0, max = 0.5", "min = @1, max = 0.5",
                {"min = 1 is above max = 0.5", "no value is allowed"});
    check_error("value = 0.06", "value = @0.6", {"v0 = 0.6 is out of bounds", "0 to 0.5 c0"});
    check_error("[material", "@c0 = { value = 3 }\n[material", {"'c0' is reserved"});
    check_error("[material", "@sin = { value = 3 }\n[material", {"'sin' is reserved"});
    check_error("[material", "@\"a b\" = { value = 3 }\n[material", {"'a b' is not a valid name", "letters"});
    check_error("[material", "@w = { value = 3 }\n[material", {"'w' is unused"});
    check_error("[material", "a = { value = \"2*@b\" }\nb = { value = 3 }\n[material", {"unknown name 'b'"});
  }

  TEST_CASE("scene: values out of bounds are refused") {
    check_error("poisson_ratio = 0.4", "poisson_ratio = @0.5",
                {"must be below 0.5", "bulk modulus would be infinite"});
    check_error("poisson_ratio = 0.4", "poisson_ratio = @-1", {"must be greater than -1 and below 0.5"});
    check_error("density = 1200", "density = @0", {"density = 0 must be greater than 0"});
    check_error("youngs_modulus = 1e7", "youngs_modulus = @-1",
                {"youngs_modulus = -1 must be greater than 0"});
    check_error("spacing = 0.1", "spacing = @0", {"spacing = 0 must be greater than 0"});
    check_error("until = 2", "until = @-2", {"until = -2 must be greater than 0"});
    check_error("until = 2", "until = @1e-322\nhistory = 1", {"must be at least 1e-100 s"});
    check_error("until = 2", "until = 2\nhistory = @0", {"history = 0 must be greater than 0"});
    check_error("until = 2", "until = 2\ncfl = @0", {"cfl = 0 must be at least 1e-06"});
    check_error("until = 2", "until = 2\ndim = @4", {"dim = 4 must be a whole number from 2 to 3"});
    check_error("until = 2", "until = 2\ndim = @2.5", {"dim = 2.5 must be a whole number"});
    check_error("inner = 1", "inner = @2", {"inner = 2 must be less than outer = 2"});
    check_error("low = [0, 0]", "low = @[0, 1]", {"low.y = 1 must be less than high.y = 1"});
    check_error("color = \"von_mises\"", "range = @[2, 1]", {"range = [2, 1]", "less than"});
    check_error("color = \"von_mises\"", "view = @[0, 1, 1, 1]", {"y_min < y_max"});
    check_error("color = \"von_mises\"", "size = [100, @63]",
                {"size[1] = 63 must be at least 64 and at most 8192"});
    check_error("color = \"von_mises\"", "frames = @1.5", {"frames = 1.5 must be a whole number from 1"});
  }

  TEST_CASE("scene: unknown names are refused with the nearest name") {
    check_error("until = 2", "until = 2\nmethod = @\"enogg\"", {"unknown method 'enogg'", "'enog'"});
    check_error("until = 2", "until = 2\nstepping = @\"duel\"", {"unknown stepping 'duel'", "dual, single"});
    check_error("until = 2", "until = 2\nmethod = \"enog\"\nmethod_constants = { @zta = 4 }",
                {"no constant 'zta'", "'zeta'"});
    check_error("until = 2", "until = 2\nmethod = \"enog\"\nmethod_constants = { zeta = @-4 }",
                {"zeta = -4 is out of bounds", "allowed: "});
    check_error("until = 2", "until = 2\nmethod = \"enog\"\nmethod_constants = { cubic_spline = @0.5 }",
                {"cubic_spline = 0.5 is out of bounds; allowed: 0 or 1"});
    check_error("until = 2",
                "until = 2\nmethod = \"ulsph-r-tic\"\nmethod_constants = { limiter = @\"minmd\" }",
                {"unknown limiter 'minmd'", "'minmod'"});
    check_error("material = \"rubber\"", "material = @\"ruber\"", {"unknown material 'ruber'", "'rubber'"});
    check_error("type = \"ring\"", "type = @\"rings\"", {"unknown type 'rings'", "did you mean 'ring'"});
    check_error("component = \"y\"", "component = @\"z\"", {"unknown component 'z'", "x, y"});
    check_error("material = \"rubber\"\nvelocity", "material = \"rubber\"\nmirror = @\"q\"\nvelocity",
                {"unknown axis 'q'", "x, y"});
    check_error("of = \"displacement\"", "of = @\"displacment\"",
                {"unknown of 'displacment'", "'displacement'"});
    check_error("body = \"block\"", "body = @\"blok\"", {"unknown body 'blok'", "'block'"});
    check_error("of = \"maximum\"", "of = @\"maximun\"", {"did you mean 'maximum'"});
    check_error("probe = \"tip\"", "probe = @\"top\"", {"unknown probe 'top'", "'tip'"});
    check_error("law = \"neo_hookean\"", "law = @\"neohookean\"",
                {"unknown law", "'neo-hookean'", "2d-deviator"});
    check_error("{ peak = 3 }", "{ @peek = 3 }", {"unknown measure 'peek'", "'peak'"});
    check_error("values =", "when = { vo = @3 }\nvalues =", {"unknown parameter 'vo'", "'v0'"});
    check_error("color = \"von_mises\"", "color = @\"von_misses\"", {"unknown field", "'von_mises'"});
    check_error("color = \"von_mises\"", "colormap = @\"virdis\"", {"unknown colour map", "'viridis'"});
  }

  TEST_CASE("scene: duplicate names, empty names and unused materials are refused") {
    check_error("name = \"ring\"", "name = @\"block\"", {"'block' is already in use"});
    check_error("name = \"ring\"", "name = @\"\"", {"'' is not a valid name"});
    check_error("[[body]]", "[material.@steel]\ndensity = 1\nyoungs_modulus = 1\npoisson_ratio = 0\n[[body]]",
                {"the material 'steel' is unused"});
    check_error("[[probe]]",
                "[[probe]]\nname = \"gap\"\nof = \"gap\"\nbodies = @[\"block\", \"block\"]\n[[probe]]",
                {"two different"});
    check_error("[render]",
                "@[[reference]]\nlaw = \"neo_hookean\"\nname = \"twin\"\nvalues = { peak = 4 }\n[render]",
                {"two references of the law 'neo_hookean'", "measure 'peak'", "when"});
    check_error("[render]", "@[[reference]]\nlaw = \"neo_hookean\"\nname = \"bare\"\n[render]",
                {"'bare' is empty", "values, tables or solutions"});
    const std::string no_bodies = small_scene.substr(0, small_scene.find("[[body]]"));
    CHECK_THROWS_WITH_AS(read_text(no_bodies), doctest::Contains("no bodies"), SceneError);
  }

  TEST_CASE("scene: invalid measures and tables are refused") {
    check_error("of = \"maximum\"", "of = \"final_ratio\"\nscale = @0", {"scale is 0"});
    check_error("values = { peak = 3 }", "tables = { @peak = { file = \"no.csv\", column = \"a\" } }",
                {"cannot have a table; only rmse, path_error, turn, line_rmse or "});
    check_error("of = \"maximum\"\nprobe = \"tip\"", "of = \"turn\"\nprobes = @[\"tip\"]",
                {"probes must be an array of 2 names"});
    check_error("of = \"maximum\"\nprobe = \"tip\"", "of = \"turn\"\nprobes = [\"tip\", @\"top\"]",
                {"unknown probe 'top'", "'tip'"});
    check_error("[[measure]]\nname = \"peak\"\nof = \"maximum\"\nprobe",
                "[[measure]]\nname = \"peak\"\nof = \"turn\"\n@probe",
                {"'probes' is missing", "'probe' may be meant"});
    check_error("values = { peak = 3 }", "let = { @t = 1 }", {"the name 't' is reserved"});
    check_error("values = { peak = 3 }", "let = { @v0 = 1 }", {"'v0' is already a parameter"});
    check_error("values = { peak = 3 }", "let = { a = \"@q + 1\" }", {"unknown name 'q'"});
    check_error(
        "of = \"maximum\"\nprobe = \"tip\"\nunit = \"m\"\n"
        "[[reference]]\nlaw = \"neo_hookean\"\nname = \"made up\"\nvalues = { peak = 3 }",
        "of = \"rmse\"\nprobe = \"tip\"\n"
        "[[reference]]\nlaw = \"neo_hookean\"\nname = \"made up\"\nsolutions = { peak = \"2*@tt\" }",
        {"unknown name 'tt'"});
    check_error(
        "of = \"maximum\"\nprobe = \"tip\"\nunit = \"m\"\n"
        "[[reference]]\nlaw = \"neo_hookean\"\nname = \"made up\"\nvalues = { peak = 3 }",
        "of = \"turn\"\nprobes = [\"tip\", \"tip\"]\n"
        "[[reference]]\nlaw = \"neo_hookean\"\nname = \"made up\"\nsolutions = { peak = @\"t\" }",
        {"has 2 probes", "an array with one expression for each"});
    check_error(
        "of = \"maximum\"\nprobe = \"tip\"\nunit = \"m\"\n"
        "[[reference]]\nlaw = \"neo_hookean\"\nname = \"made up\"\nvalues = { peak = 3 }",
        "of = \"turn\"\nprobes = [\"tip\", \"tip\"]\n"
        "[[reference]]\nlaw = \"neo_hookean\"\nname = \"made up\"\n"
        "tables = { peak = { file = \"table.csv\", columns = @[\"uy\"] } }",
        {"array of 2 names of columns"});
    const auto with_rmse = [](const std::string& table) {
      return replaced(replaced(small_scene, "of = \"maximum\"", "of = \"rmse\""), "values = { peak = 3 }",
                      "tables = { peak = { file = \"" + table + "\", column = \"uy\" } }");
    };
    CHECK_THROWS_WITH_AS(read_text(with_rmse("no.csv")), doctest::Contains("no.csv"), SceneError);
    const auto table_error = [&](const std::string& content) {
      std::ofstream(scratch_folder() / "table.csv") << content;
      try {
        read_text(with_rmse("table.csv"));
      } catch (const SceneError& error) {
        CHECK(error.file == (scratch_folder() / "table.csv").string());
        return std::to_string(error.line) + ": " + error.what();
      }
      return std::string("none");
    };
    CHECK(table_error("# head\nt,uy\n0,1\n1,2\n") == "none");
    CHECK_THROWS_WITH_AS(
        read_text(replaced(with_rmse("table.csv"), "tables =", "solutions = { peak = \"t\" }\ntables =")),
        doctest::Contains("has a table and a solution"), SceneError);
    CHECK(says(table_error("# head\nt,ux\n0,1\n1,2\n"),
               "2: the table has no column 'uy' (did you mean 'ux'?)"));
    CHECK(says(table_error("t,uy\n0,1\n1,two\n"), "3: 'two' is not a finite number"));
    CHECK(says(table_error("t,uy\n0,1\n1\n"), "3: the row has 1 columns"));
    CHECK(says(table_error("t,uy\n0,1\n0,2\n"), "3: t must increase"));
    CHECK(says(table_error("t,uy\n0,1\n"), "at least two rows"));
    CHECK(says(table_error(""), "the table is empty"));
  }

  TEST_CASE("scene: invalid lines are refused") {
    const auto with = [](const std::string& line) {
      return "[[line]]\nname = \"cut\"\nbody = \"block\"\nfield = \"pressure\"\n"
             "from = [0, 0.5]\nto = [2, 0.5]\n" +
             line + "[[reference]]";
    };
    const auto bad = [&](const std::string& line, std::initializer_list<const char*> parts) {
      check_error("[[reference]]", with(line), parts);
    };
    const SceneFile right =
        read_text(replaced(small_scene, "[[reference]]", with("points = 5\ntimes = [0, \"v0\", 2]\n")));
    CHECK(right.scene.lines.at(0).times == std::vector<double>{0, 0.06, 2});
    CHECK_FALSE(right.scene.lines.at(0).in_space);
    CHECK(read_text(
              replaced(small_scene, "[[reference]]", with("points = 5\ntimes = [1]\nframe = \"space\"\n")))
              .scene.lines.at(0)
              .in_space);
    bad("points = 5\ntimes = [1]\nframe = @\"spce\"\n", {"spce", "space"});
    bad("points = @1\ntimes = [1]\n", {"points = 1 must be a whole number from 2"});
    bad("points = 5\ntimes = @[]\n", {"times must be an array"});
    bad("points = 5\ntimes = @3\n", {"times must be an array"});
    bad("points = 5\ntimes = [1, @0.5]\n", {"0.5 comes after 1", "times must increase"});
    bad("points = 5\ntimes = [1, @1]\n", {"1 comes after 1", "times must increase"});
    bad("points = 5\ntimes = [@-1]\n", {"times must increase"});
    bad("points = 5\ntimes = [1]\n@width = 3\n", {"unknown key 'width'"});
    const std::string good = with("points = 5\ntimes = [1]\n");
    check_error("[[reference]]", replaced(good, "\"pressure\"", "@\"presure\""),
                {"unknown field 'presure'", "'pressure'"});
    check_error("[[reference]]", replaced(good, "\"block\"", "@\"blok\""),
                {"unknown body 'blok'", "'block'"});
    const std::string measured = "of = \"line_rmse\"\nline = ";
    check_error("of = \"maximum\"\nprobe = \"tip\"", measured + "@\"cut\"",
                {"unknown line 'cut'", "there is none"});
  }

  TEST_CASE("scene: invalid measures of fields are refused") {
    const auto bad = [](const std::string& keys, std::initializer_list<const char*> parts) {
      check_error(
          "unit = \"m\"\n[[reference]]",
          "unit = \"m\"\n[[measure]]\nname = \"field\"\nof = \"field_rmse\"\n" + keys + "\n[[reference]]",
          parts);
    };
    bad("body = @\"blok\"\nfields = [\"pressure\"]", {"unknown body 'blok'", "'block'"});
    bad("body = \"block\"\nfields = [@\"presure\"]", {"unknown field 'presure'", "'pressure'"});
    bad("body = \"block\"\nfields = @[]", {"fields must be an array of 1 to 2 names"});
    bad("body = \"block\"\nfields = @\"pressure\"", {"fields must be an array"});
    bad("body = \"block\"\nfields = [\"pressure\"]\nrigid_motion = @\"fre\"", {"'fre'", "free"});
    bad("body = \"block\"\nfields = [\"pressure\"]\nrigid_motion = @\"free\"", {"displacement_x"});
    bad("body = \"block\"\nfields = [\"pressure\"]\n@probe = \"tip\"", {"unknown key 'probe'"});
    check_error("values = { peak = 3 }\n", "values = { peak = 3 }\nmethods = [@\"ibc\"]\n",
                {"unknown method 'ibc'", "'icb'"});
    check_error("values = { peak = 3 }\n", "values = { peak = 3 }\nmethods = @\"icb\"\n",
                {"methods must be an array"});
  }

  TEST_CASE("scene: messages explain common mistakes") {
    check_error("youngs_modulus = 1e7", "youngs_modulus = \"10 @MPa\"",
                {"has a unit", "write the number alone, in SI units or degrees: 1e+07"});
    for (const char* low : {"low = [\"5 @mm\", 0]", "low = [\"5 @mm \", 0]"})
      check_error("low = [0, 0]", low, {"has a unit", "0.005"});
    check_error("[[body]]\nname = \"ring\"", "rotate = \"20 @deg\"\n[[body]]\nname = \"ring\"",
                {"'20 deg' has a unit", "write the number alone, in SI units or degrees: 20"});
    check_error("velocity = [\"v0*c0*x\", 0]", "velocity = [\"x > 0 @and y > 0\", 0]",
                {"instead of 'and', write '&&'"});
    check_error("velocity = [\"v0*c0*x\", 0]", "velocity = [\"x > 0 @or y > 0\", 0]",
                {"instead of 'or', write '||'"});
    check_error("velocity = [\"v0*c0*x\", 0]", "velocity = [\"@if(x > 0, 1, 2)\", 0]",
                {"instead of 'if', write 'CONDITION ? A : B'"});
    check_error("velocity = [\"v0*c0*x\", 0]", "velocity = [\"@pow(x, 2)\", 0]",
                {"instead of 'pow', write 'A^B'"});
    check_error("velocity = [\"v0*c0*x\", 0]", "velocity = [\"x@**2\", 0]", {"instead of '**', write '^'"});
    check_error("velocity = [\"v0*c0*x\", 0]", "velocity = [\"x > 0 ? @true : 0\", 0]",
                {"instead of 'true', write '1'"});
    check_error("until = 2", "until = @\"sqrt(-1)\"", {"until is nan;"});
    const auto message = [](std::string_view old_part, std::string_view new_part) {
      try {
        read_text(replaced(small_scene, old_part, new_part));
      } catch (const SceneError& error) {
        return std::string(error.what());
      }
      return std::string();
    };
    CHECK(says(message("title = \"Small\"", "title = \"Small"), "Is a quote missing"));
    CHECK(says(message("material = \"rubber\"", "material = rubber"), "need quotes"));
    CHECK(says(message("until = 2", "until = 2*3"), "need quotes"));
    CHECK(says(message("[[body]]\nname = \"ring\"", "[body]\nname = \"ring\""), "[[body]]"));
  }

  TEST_CASE("overrides: unknown names are refused") {
    CHECK(says(set_error("vo", "1"), "'vo' cannot be set"));
    CHECK(says(set_error("vo", "1"), "did you mean 'v0'"));
    CHECK(says(set_error("speed", "1"), "names that can be set: v0, method."));
    CHECK(says(set_error("speed", "1"), "method.damping, "));
    CHECK(says(set_error("speed", "1"),
               ", method, spacing, until, cfl, stepping, contact, law, jitter, jitter_seed"));
    CHECK(says(set_error("method.dampng", "1"), "did you mean 'method.damping'"));
    CHECK(says(set_error("method", "enogg"), "did you mean 'enog'"));
    CHECK(says(set_error("stepping", "duel"), "dual, single"));
    CHECK(says(set_error("contact", "impuls"), "did you mean 'impulse'"));
    CHECK(says(set_error("contact", "impuls"), "published, sph, impulse, penalty"));
  }

  TEST_CASE("overrides: invalid values are refused") {
    CHECK(says(set_error("v0", "0.6"), "v0 = 0.6 is out of bounds; allowed: 0 to 0.5 c0"));
    CHECK(says(set_error("v0", "fast"), "unknown name 'fast'"));
    CHECK(says(set_error("v0", "1/0"), "finite"));
    CHECK(says(set_error("method.damping", "-1"), "out of bounds"));
    CHECK(says(set_error("spacing", "0"), "spacing = 0 must be greater than 0"));
    CHECK(says(set_error("until", "-1"), "until = -1 must be greater than 0"));
    CHECK(says(set_error("cfl", "v0 - 1"), "cfl = v0 - 1 must be at least 1e-06"));
    CHECK(says(set_error("jitter", "0.5"), "jitter = 0.5 must be at least 0 and below 0.5"));
    CHECK(says(set_error("jitter", "0.1*dp"), "jitter = 0.1*dp must not contain dp"));
    CHECK(says(set_error("jitter", "-0.1"), "jitter = -0.1 must be at least 0"));
    CHECK(says(set_error("jitter", "much"), "unknown name 'much'"));
    CHECK(says(set_error("jitter_seed", "1.5"), "jitter_seed = 1.5 must be a whole number from 1 to 1e+09"));
    CHECK(says(set_error("jitter_seed", "0"), "whole number from 1"));
    CHECK(says(set_error("jiter", "0.1"), "did you mean 'jitter'"));
    CHECK(says(usage_error({{"method", "enogg"}}), "did you mean 'enog'"));
    CHECK(says(usage_error({{"until", "0"}}), "until = 0 must be greater than 0"));
  }

  TEST_CASE("files that are not scenes are refused") {
    CHECK(says(file_error(scratch_folder() / "absent.toml"), "no such file"));
    CHECK(says(file_error(scratch_folder()), "folder"));
    CHECK(says(file_error(write_scene(std::string((4 << 20) + 1, ' '))), "larger than 4 MiB"));
    if (geteuid() != 0) {
      const auto path = write_scene(small_scene);
      std::filesystem::permissions(path, std::filesystem::perms::none);
      CHECK(says(file_error(path), "cannot be read"));
      std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    }
    CHECK_THROWS_WITH_AS(find_scene("coliding-rings"), doctest::Contains("did you mean 'colliding-rings'"),
                         UsageError);
  }

  TEST_CASE("an error of the engine gets its place in the file") {
    const SceneFile file = read_text(replaced(small_scene, "centre = [5, 0]", "centre = [1, 0]"));
    try {
      make_initial_particles(file.scene);
      FAIL("no error for overlapping bodies");
    } catch (const SceneError& error) {
      const SceneError located = locate(file, error);
      CHECK(located.file == file.path.string());
      CHECK(located.line > 0);
      CHECK(located.column > 0);
    }
  }
}
