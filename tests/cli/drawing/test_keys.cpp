#include <array>

#include <doctest/doctest.h>

#include "cli/drawing/bounds.hpp"
#include "cli/drawing/keys.hpp"
#include "cli/drawing/options.hpp"
#include "cli/drawing/page_keys.hpp"
#include "cli/scene/scene_file.hpp"
#include "engine/error.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/relative.hpp"

using namespace taut;
using namespace taut::cli;
using namespace taut::test;

namespace {

Drawing other_drawing() {
  return {.field = find_field("pressure"),
          .look = {.view = render::View{-1, 2, -3, 4},
                   .camera = render::Camera{.from = {1, 0, 0}, .up = {0, 1, 0}, .field_of_view = 30},
                   .range = render::Range{-5, 6},
                   .colormap = render::find_colormap("plasma"),
                   .size = render::Size{70, 80},
                   .bare = true,
                   .texts = {.parts = {.method = false},
                             .bar = render::BarPosition::bottom,
                             .axes_outside = true},
                   .bar_format = {2, true},
                   .glyph = 0.5,
                   .background = {1, 2, 3}},
          .frames = 9,
          .style = Style::cells,
          .cut = "x > 0",
          .hide = "plate,ring",
          .outline = Outlines::both,
          .follow = "ball",
          .title = "A ball",
          .font_points = 8,
          .dpi = 150,
          .print_width = "85mm"};
}

DrawingOptions typed(const std::string& key, const std::string& text) {
  DrawingOptions options;
  options.typed[key] = text;
  return options;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("keys of drawing: each key reads and writes its whole value") {
    const Drawing other = other_drawing();
    Drawing copy;
    for (const DrawingKey& key : drawing_keys()) {
      CAPTURE(key.name);
      CHECK(key.get(copy) != key.get(other));
      CHECK(key.set(copy, key.get(other)).empty());
      CHECK(key.get(copy) == key.get(other));
    }
    CHECK(copy.field == other.field);
    CHECK(copy.look.view == other.look.view);
    CHECK(copy.look.range == other.look.range);
    CHECK(copy.look.colormap == other.look.colormap);
    CHECK(copy.look.size == other.look.size);
    CHECK(copy.look.bare);
    CHECK(copy.look.glyph == other.look.glyph);
    CHECK(copy.look.background == other.look.background);
    CHECK(copy.look.camera == other.look.camera);
    CHECK(copy.style == other.style);
    CHECK(copy.cut == other.cut);
    CHECK(copy.hide == other.hide);
    CHECK(copy.look.texts.bar == other.look.texts.bar);
    CHECK(copy.look.texts.axes_outside);
    CHECK(copy.look.bar_format == other.look.bar_format);
    CHECK(copy.outline == other.outline);
    CHECK(copy.follow == other.follow);
    CHECK(copy.title == other.title);
    CHECK(copy.font_points == other.font_points);
    CHECK(copy.dpi == other.dpi);
    CHECK(copy.print_width == other.print_width);
    CHECK(copy.frames == other.frames);
  }

  TEST_CASE("keys of drawing: keys can be set back to automatic or to none") {
    Drawing drawing = other_drawing();
    for (const DrawingKey& key : drawing_keys())
      if (key.allows_auto) CHECK(key.set(drawing, std::string(automatic)).empty());
    CHECK_FALSE(drawing.look.view);
    CHECK_FALSE(drawing.look.range);
    CHECK_FALSE(drawing.look.colormap);
    CHECK_FALSE(drawing.style);
    CHECK(drawing.look.camera == render::Camera{});
    CHECK_FALSE(drawing.title);
    CHECK_FALSE(drawing.font_points);
    CHECK_FALSE(drawing.dpi);
    for (const std::string_view name : {"cut", "hide", "follow", "width", "title"})
      CHECK(drawing_key(name).set(drawing, std::string(nothing)).empty());
    CHECK(drawing.cut.empty());
    CHECK(drawing.hide.empty());
    CHECK(drawing.follow.empty());
    CHECK(drawing.print_width.empty());
    CHECK(drawing.title == "");
  }

  TEST_CASE("keys of drawing: a transparent background and a colour replace each other") {
    const Drawing transparent = with_options(other_drawing(), typed("background", "transparent"));
    CHECK(transparent.look.transparent);
    CHECK(transparent.look.background == render::white);
    CHECK(drawing_key("background").get(transparent) == DrawingValue(std::string("transparent")));
    const Drawing black = with_options(transparent, typed("background", "black"));
    CHECK_FALSE(black.look.transparent);
    CHECK(drawing_key("background").get(black) == DrawingValue(std::string("black")));
  }

  TEST_CASE("keys of drawing: a change of field resets range and colour map") {
    const Drawing same = with_options(other_drawing(), typed("color", "pressure"));
    CHECK(same.look.range);
    CHECK(same.look.colormap);
    const Drawing another = with_options(other_drawing(), typed("color", "speed"));
    CHECK(another.field == find_field("speed"));
    CHECK_FALSE(another.look.range);
    CHECK_FALSE(another.look.colormap);
    CHECK(another.look.view);
    const Drawing formula = with_options(other_drawing(), typed("color", "=pressure"));
    CHECK(formula.formula == "pressure");
    CHECK_FALSE(formula.look.range);
    CHECK(with_options(formula, typed("color", "pressure")).formula.empty());
    DrawingOptions both = typed("color", "speed");
    both.typed["range"] = "0:1";
    CHECK(with_options(other_drawing(), both).look.range == render::Range{0, 1});
  }

  TEST_CASE("keys of drawing: an invalid value is refused with the valid ones and changes nothing") {
    for (const auto& [name, text, right] :
         {std::array{"range", "2:1", "must be LOW:HIGH with LOW < HIGH"},
          std::array{"range", "1:2:3", "must be LOW:HIGH"},
          std::array{"range", "-1e308:1e308", "or 'auto'; both from -1e100 to 1e100"},
          std::array{"view", "-1e308:1e308:0:1", "or 'auto'; all from -1e100 to 1e100"},
          std::array{"camera", "1e-300:0:0", "or 'auto'; its length from 1e-100 to 1e100"},
          std::array{"up", "0:0:1e300", "or 'auto'; its length from 1e-100 to 1e100"},
          std::array{"view", "0:1:2:2", "must be X_MIN:X_MAX:Y_MIN:Y_MAX"},
          std::array{"camera", "0:0:0", "must be X:Y:Z, a direction towards the camera"},
          std::array{"camera", "1:2", "must be X:Y:Z"},
          std::array{"up", "1:2:z", "must be X:Y:Z"},
          std::array{"fov", "121", "must be DEGREES from 0 (parallel) to 120, or 'auto'"},
          std::array{"style", "cell", "unknown style 'cell' (did you mean 'cells'?)"},
          std::array{"size", "100x63.5", "must be WIDTHxHEIGHT"},
          std::array{"size", "auto", "must be WIDTHxHEIGHT"},
          std::array{"color", "=", "must be a field, or = and an expression"},
          std::array{"glyph", "0", "must be a number from 0.05 to 20"},
          std::array{"glyph", "auto", "must be a number"},
          std::array{"background", "#12345", "must be white, black, transparent or #rrggbb"},
          std::array{"background", "#12345g", "must be white, black, transparent or #rrggbb"},
          std::array{"background", "wite", "must be white, black, transparent or #rrggbb"},
          std::array{"text", "non", "unknown text 'non' (did you mean 'none'?)"},
          std::array{"text", "time,bra", "unknown text 'bra' (did you mean 'bar'?)"},
          std::array{"text", "none,bar", "--text is 'none,bar'; it must be all, none, or some of title"},
          std::array{"width", "85", "--width is '85'; it must be none or a length with mm, cm or in"},
          std::array{"width", "3m", "must be none or a length"},
          std::array{"dpi", "10", "--dpi is '10'; it must be N from 30 to 2400"},
          std::array{"font_size", "0", "--font-size is '0'; it must be POINTS from 1 to 100, or 'auto'"},
          std::array{"title", "Gr\xf6\xdf", "--title is 'Gr\\xf6\\xdf'; it must be one line of UTF-8 text"},
          std::array{"color", "presure", "unknown field 'presure' (did you mean 'pressure'?)"},
          std::array{"colormap", "plasm", "unknown colour map 'plasm' (did you mean 'plasma'?)"}}) {
      const auto& name_now = name;
      CAPTURE(name_now);
      const auto& text_now = text;
      CAPTURE(text_now);
      Drawing drawing = other_drawing();
      CHECK_THROWS_WITH_AS(set_typed(drawing, drawing_key(name), text), doctest::Contains(right), UsageError);
      for (const DrawingKey& key : drawing_keys()) CHECK(key.get(drawing) == key.get(other_drawing()));
    }
  }

  TEST_CASE("a title or label is one line of UTF-8 text of at most 200 bytes") {
    const std::string longest = "Größe " + std::string(192, 'x');
    CHECK(longest.size() == 200);
    for (const std::string& valid :
         {std::string(), std::string("none"), longest, std::string("∂σ, 応力, 🙂")})
      CHECK(line_of_text(valid).empty());
    for (const std::string& wrong :
         {longest + "x", std::string("two\nlines"), std::string("\x7f"), std::string("Gr\xf6\xdf\x65"),
          std::string("cut off \xc3"), std::string("surrogate \xed\xa0\x80"),
          std::string("overlong \xc0\x80"), std::string("beyond \xf5\x80\x80\x80")}) {
      CAPTURE(wrong.size());
      Drawing drawing = other_drawing();
      CHECK(line_of_text(wrong).ends_with("' must be one line of UTF-8 text of at most 200 bytes"));
      CHECK(drawing_key("title").set(drawing, wrong).starts_with("title: '"));
      CHECK(drawing.title == other_drawing().title);
    }
  }

  TEST_CASE("hidden bodies and the materials that only they have are not listed in the legend") {
    SceneFile file;
    for (const char* name : {"steel", "rubber", "foam", "unused"})
      file.scene.materials.push_back({.name = name});
    file.scene.bodies.resize(3);
    file.scene.bodies[0].name = "plate", file.scene.bodies[0].material = 0;
    file.scene.bodies[1].name = "ring", file.scene.bodies[1].material = 1;
    file.scene.bodies[2].name = "ball", file.scene.bodies[2].material = 2;
    file.scene.bodies[2].parts.push_back({.material = 1, .where = {}});
    Drawing drawing;
    const auto unlisted = [&](const char* color, const char* hide) {
      drawing.field = find_field(color), drawing.hide = hide;
      apply_scene(drawing, file);
      return drawing.look.unlisted;
    };
    CHECK(unlisted("body", "plate,ball") == std::vector{0, 2});
    CHECK(unlisted("body", "").empty());
    CHECK(unlisted("material", "ring") == std::vector{3});
    CHECK(unlisted("material", "ball,plate") == std::vector{0, 2, 3});
    CHECK(unlisted("von_mises", "ring").empty());
  }

  TEST_CASE(
      "a width on paper sets pixels by the resolution, keeps the proportions and sets texts of 7 points") {
    Drawing drawing;
    CHECK(sized(drawing).look.size == drawing.look.size);
    CHECK(sized(drawing).look.texts.font == 0);
    set_typed(drawing, drawing_key("width"), "85mm");
    const render::Look paper = sized(drawing).look;
    CHECK(paper.size == render::Size{1004, 565});  // 85 mm at 300 dpi
    CHECK(paper.texts.font == Approx(7 * 300 / 72.0));
    CHECK(sized(sized(drawing)).look.size == paper.size);
    for (const char* same : {"8.5cm", "3.3464567in"}) {
      set_typed(drawing, drawing_key("width"), same);
      CHECK(sized(drawing).look.size == paper.size);
    }
    set_typed(drawing, drawing_key("dpi"), "600");
    set_typed(drawing, drawing_key("font_size"), "9");
    CHECK(sized(drawing).look.size == render::Size{2008, 1129});
    CHECK(sized(drawing).look.texts.font == Approx(75));
    set_typed(drawing, drawing_key("width"), "none");
    set_typed(drawing, drawing_key("dpi"), "auto");
    CHECK(sized(drawing).look.texts.font == Approx(12));  // 9 points at 96 dpi
    CHECK(sized(drawing).look.size == render::Size{});
  }

  TEST_CASE("parts of the texts are read and written as a list in the order of the page") {
    Drawing drawing;
    const DrawingKey& key = drawing_key("text");
    set_typed(drawing, key, "bar,time");
    CHECK(key.get(drawing) == DrawingValue("time,bar"));
    CHECK_FALSE(drawing.look.bare);
    CHECK(drawing.look.texts.parts ==
          render::TextParts{.title = false, .method = false, .scale = false, .axes = false});
    set_typed(drawing, key, "title,method,time,bar,scale,axes");
    CHECK(key.get(drawing) == DrawingValue("all"));
    set_typed(drawing, key, "none");
    CHECK(drawing.look.bare);
    CHECK(key.get(drawing) == DrawingValue("none"));
  }

  TEST_CASE("in 3D the view is perpendicular to the camera's direction and contains all particles in full") {
    const std::vector<double> x{0, 0, 0, 1, 2, 3}, diameter{0.2, 0.2}, value{0, 1};
    FrameView particles;
    particles.dim = 3, particles.x = x, particles.diameter = diameter, particles.value = value;
    Drawing open;
    open.look.camera = render::Camera{.from = {0, -1, 0}};
    SequenceBounds shown(open.look.camera);
    shown.add(particles);
    const render::Look look = fitted(open, shown).look;
    const double margin = 0.05 * 3.2;
    CHECK(look.view->x_min == Approx(-0.1 - margin));
    CHECK(look.view->x_max == Approx(1.1 + margin));
    CHECK(look.view->y_min == Approx(-0.1 - margin));
    CHECK(look.view->y_max == Approx(3.1 + margin));
    CHECK(look.camera->front == Approx(0.1));
  }

  TEST_CASE("an automatic range omits distant outliers, but keeps extremes near the other values") {
    const auto range_of = [](const std::vector<double>& values, std::optional<double> middle = {}) {
      SequenceBounds shown;
      shown.add_values(values);
      return shown.range(middle);
    };
    std::vector<double> values;
    for (int k = 0; k <= 1000; ++k) values.push_back(k);
    CHECK(range_of(values) == render::Range{0, 1000});  // 99 % quantile: 990
    CHECK(range_of(values, 0.0) == render::Range{-1000, 1000});
    CHECK(range_of(values, 1.0) == render::Range{-998, 1000});
    values.push_back(1e9);
    CHECK(range_of(values) == render::Range{0, 991});
    values.push_back(-1e9);
    CHECK(range_of(values) == render::Range{9, 991});
    values.insert(values.end(), 500000, 0.0);
    CHECK(range_of(values) == render::Range{0, 991});
    values.assign(10, 0.0);
    CHECK(range_of(values) == render::Range{0, 1});
    CHECK(range_of({5, 5}) == render::Range{2.5, 7.5});
    CHECK(range_of({-4}) == render::Range{-6, -2});
    CHECK(range_of({1, 1}, 1.0) == render::Range{0.5, 1.5});
    CHECK(range_of({0, 0}, 0.0) == render::Range{-1, 1});
    CHECK(range_of({NAN, INFINITY}) == render::Range{0, 1});
    CHECK(range_of({NAN, 2, INFINITY, 0}) == render::Range{0, 2});
    CHECK(range_of({1e300, 2, -1e300, 0}) == render::Range{0, 2});  // magnitudes above 1e100 do not count
    CHECK(range_of({1200, 1200.000001}) == render::Range{1200, 1200.000001});
    std::vector<double> many;
    for (int k = 0; k < 9000000; ++k) many.push_back(k % 1000);
    many.insert(many.end(), 10, 1e9);
    CHECK(std::abs(range_of(many).high - 989) < 2);
  }

  TEST_CASE("only the unset keys of a drawing are fitted to the particles") {
    const std::vector<double> x{0, 0, 1, 2}, diameter{0.1, 0.2}, value{-1, 3};
    FrameView particles;
    particles.x = x, particles.diameter = diameter, particles.value = value;
    SequenceBounds shown;
    shown.add(particles);
    Drawing open;
    open.field = find_field("von_mises");
    const Drawing plain = fitted(open, shown);
    CHECK(plain.look.range == render::Range{-1, 3});
    CHECK(plain.look.colormap == render::find_colormap("viridis"));
    CHECK(plain.look.view->x_max > 1.1);
    open.field = find_field("pressure");
    CHECK(fitted(open, shown).look.range == render::Range{-3, 3});
    CHECK(fitted(open, shown).look.colormap == render::find_colormap("coolwarm"));
    open.round_off = 100;
    CHECK(fitted(open, shown).look.range == render::Range{-50, 50});
    open.field = find_field("von_mises");
    CHECK(fitted(open, shown).look.range == render::Range{0, 100});
    open.round_off = 3.9;
    CHECK(fitted(open, shown).look.range == render::Range{-1, 3});
    const Drawing chosen = fitted(other_drawing(), shown);
    for (const DrawingKey& key : drawing_keys()) CHECK(key.get(chosen) == key.get(other_drawing()));
  }

  TEST_CASE("keys of drawing: following another body resets the scene's view, and keeps a given view") {
    const render::View of_scene{0, 1, 2, 3}, given{-1, 1, -2, 2};
    const auto view_with = [&](const std::string& followed, DrawingOptions options) {
      Drawing drawing{.follow = followed};
      drawing.look.view = of_scene;
      return with_options(drawing, options).look.view;
    };
    CHECK_FALSE(view_with("", typed("follow", "ball")));
    CHECK_FALSE(view_with("ring", typed("follow", "ball")));
    CHECK_FALSE(view_with("ball", typed("follow", "none")));
    CHECK(view_with("ball", typed("follow", "ball")) == of_scene);
    CHECK(view_with("", typed("follow", "none")) == of_scene);
    DrawingOptions both = typed("follow", "ball");
    both.typed["view"] = "-1:1:-2:2";
    CHECK(view_with("", both) == given);
    DrawingOptions suite;
    suite.values = {{"follow", "ball"}};
    CHECK_FALSE(view_with("", suite));
    suite.values["view"] = std::vector<double>{-1, 1, -2, 2};
    CHECK(view_with("", suite) == given);
  }
}

TEST_SUITE("cli") {
  TEST_CASE("every key of drawing is an option of run and a line of its scene.toml") {
    const TemporaryFolder folder;
    REQUIRE(call(tiny_run(folder, "out", {"--no-render"})).code == 0);
    const std::string scene = text_of(folder / "out/scene.toml");
    const std::string help = call({"run", "--help"}).out;
    std::size_t at = scene.find("[render]");
    for (const DrawingKey& key : drawing_keys()) {
      const std::string name(key.name);
      CAPTURE(name);
      CHECK(contains(help, key.option() + " " + std::string(key.placeholder)));
      at = scene.find("\n" + name + " = ", at);
      CHECK(at != std::string::npos);
    }
  }
}
