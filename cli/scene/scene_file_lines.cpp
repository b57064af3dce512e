#include "cli/scene/sections.hpp"
#include "cli/text/format.hpp"
#include "engine/diagnostics/fields.hpp"

namespace taut::cli {
namespace {

std::vector<double> read_line_times(TomlCursor& cursor) {
  const TomlValue& value = cursor.need("times");
  if (value.kind != TomlValue::Kind::array || value.items.empty())
    cursor.fail(value, "times", "times must be an array of times in s, in growing order");
  std::vector<double> times;
  for (const TomlValue& item : value.items) {
    times.push_back(cursor.value_of(item, "times"));
    const double before = times.size() > 1 ? times[times.size() - 2] : 0;
    if (times.back() < before)
      cursor.fail(item, "times", exact(times.back()) + " comes after " + exact(before) + ": times must grow");
  }
  return times;
}

SampleLine read_line(TomlCursor& cursor, const Scene& scene) {
  constexpr int most_points = 100000;
  SampleLine line;
  line.name = label(cursor, names_of(scene.lines));
  line.body = body_index(cursor, cursor.need("body"), "body", scene);
  line.field = cursor.text("field");
  if (!find_field(line.field))
    cursor.fail_unknown(cursor.need("field"), "field", "field", line.field, names_of_fields());
  line.from = cursor.point("from", scene.dim);
  line.to = cursor.point("to", scene.dim);
  cursor.need("points");
  line.points = cursor.whole("points", 2, 2, most_points);
  line.times = read_line_times(cursor);
  cursor.finish();
  return line;
}

}  // namespace

void read_lines(TomlCursor& root, Scene& scene) {
  read_each(root, "line", [&](TomlCursor& cursor) { scene.lines.push_back(read_line(cursor, scene)); });
}

}  // namespace taut::cli
