#include "cli/drawing/kept_look.hpp"

#include <vector>

#include "cli/drawing/keys.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/system/build_info.hpp"
#include "cli/system/provenance.hpp"
#include "cli/text/json_cursor.hpp"

namespace taut::cli {
namespace {

std::string color_of(const Drawing& drawing) {
  return std::get<std::string>(drawing_key("color").get(drawing));
}

Json array_of(const std::vector<double>& numbers) {
  Json all = Json::array();
  for (const double number : numbers) all.add(number);
  return all;
}

/// Empty for null.
std::vector<double> numbers_of(const JsonCursor& value, std::size_t count) {
  std::vector<double> numbers;
  for (const JsonCursor& item : value.items())
    if (const auto number = item.number()) numbers.push_back(*number);
  if (!value.is_null() && numbers.size() != count) value.fail(std::to_string(count) + " numbers");
  return numbers;
}

}  // namespace

KeptLook look_of(const Drawing& drawn) {
  KeptLook look{color_of(drawn), drawn.look.range, {}};
  if (drawn.orbit) return look;
  look.view = drawn.look.view;
  if (drawn.look.camera) look.front = drawn.look.camera->front;
  return look;
}

void set_open(Drawing& drawing, const KeptLook& look) {
  if (!drawing.look.range && look.color == color_of(drawing)) drawing.look.range = look.range;
  if (drawing.look.view || drawing.orbit || !look.view) return;
  drawing.look.view = look.view;
  if (drawing.look.camera) drawing.look.camera->front = look.front;
}

Json to_json(const KeptLook& look) {
  Json json{{"taut", build_info.version},
            {"format", format_of("look.json")},
            {"color", look.color},
            {"range", nullptr},
            {"view", nullptr},
            {"front", look.front}};
  if (look.range) json["range"] = array_of({look.range->low, look.range->high});
  if (look.view)
    json["view"] = array_of({look.view->x_min, look.view->x_max, look.view->y_min, look.view->y_max});
  return json;
}

std::optional<KeptLook> read_look(const std::filesystem::path& file) {
  const std::optional<std::string> text = read_whole(file);
  if (!text) return std::nullopt;
  const std::string name = file.string();
  const Json json = parse_json(*text, name);
  const JsonCursor root(json, name);
  root.check_object();
  KeptLook look{root.at("color").text(), {}, {}, root.at("front").number().value_or(0)};
  if (const JsonCursor range = root.at("range"); !range.is_null()) {
    const std::vector<double> ends = numbers_of(range, 2);
    if (!(ends[0] < ends[1])) range.fail("two numbers in increasing order");
    look.range = {ends[0], ends[1]};
  }
  if (const JsonCursor view = root.at("view"); !view.is_null()) {
    const std::vector<double> ends = numbers_of(view, 4);
    if (!(ends[0] < ends[1]) || !(ends[2] < ends[3]))
      view.fail("[x_min, x_max, y_min, y_max] with min < max");
    look.view = {ends[0], ends[1], ends[2], ends[3]};
  }
  return look;
}

}  // namespace taut::cli
