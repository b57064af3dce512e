#include "cli/scene/reference_table.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include <fmt/core.h>

#include "cli/scene/sections.hpp"
#include "cli/scene/shipped.hpp"
#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"

namespace taut::cli {
namespace {

std::vector<std::string> cells(std::string_view line) {
  std::vector<std::string> result(1);
  for (const char c : line) {
    if (c == ',')
      result.emplace_back();
    else if (c != '\r' && c != ' ')
      result.back() += c;
  }
  return result;
}

struct Rows {
  std::string file;
  std::string text;
  std::size_t next = 0;
  int line = 0;

  /// Nullopt at the end.
  std::optional<std::vector<std::string>> read() {
    if (constexpr std::string_view mark = "\xEF\xBB\xBF"; next == 0 && text.starts_with(mark))
      next = mark.size();
    while (next < text.size()) {
      const std::size_t end = std::min(text.find('\n', next), text.size());
      const std::string_view row = std::string_view(text).substr(next, end - next);
      next = end + 1;
      ++line;
      if (row.find_first_not_of(" \r") != std::string_view::npos && row.front() != '#') return cells(row);
    }
    return {};
  }

  [[noreturn]] void fail(const std::string& message) const { throw SceneError(file, line, 1, "", message); }

  double number(const std::vector<std::string>& row, std::size_t column) const {
    if (column >= row.size())
      fail(fmt::format("the row has {} columns, fewer than the header; add the missing values", row.size()));
    const std::string& cell = row[column];
    const auto value = parsed<double>(cell);
    if (!value || !std::isfinite(*value)) fail(fmt::format("'{}' is not a finite number", cell));
    return *value;
  }
};

std::size_t column_of(const Rows& rows, const std::vector<std::string>& head, const std::string& name) {
  for (std::size_t i = 0; i < head.size(); ++i)
    if (head[i] == name) return i;
  rows.fail(fmt::format("the table has no column '{}'{}; its columns: {}", name, did_you_mean(name, head),
                        join(head)));
}

/// Paths in a run's scene.toml may be relative to a scene folder.
std::filesystem::path find_file(const std::filesystem::path& folder, const std::string& file) {
  std::error_code error;
  if (std::filesystem::is_regular_file(folder / file, error))
    return std::filesystem::weakly_canonical(folder / file, error);
  for (const std::filesystem::path& scenes : scene_folders())
    if (std::filesystem::is_regular_file(scenes / file, error))
      return std::filesystem::weakly_canonical(scenes / file, error);
  return (folder / file).lexically_normal();
}

/// Scene folders may move.
std::string path_without_scene_folder(const std::filesystem::path& file) {
  std::error_code error;
  for (const std::filesystem::path& scenes : scene_folders()) {
    const auto inside = file.lexically_relative(std::filesystem::weakly_canonical(scenes, error));
    if (!inside.empty() && *inside.begin() != "..") return inside.string();
  }
  return file.string();
}

template <class Value, class Use>
void for_each_file_in(Value& value, const Use& use) {
  for (auto& item : value.items) for_each_file_in(item, use);
  for (auto& entry : value.entries) {
    for_each_file_in(entry.value, use);
    if (entry.key == "file" && !entry.value.text.empty()) use(entry.value.text);
  }
}

template <class Value, class Use>
void for_each_named_file(Value& scene, const Use& use) {
  for (const std::string_view key : {"reference", "body"})
    if (auto* section = scene.find(key)) for_each_file_in(section->value, use);
}

}  // namespace

std::filesystem::path named_file(TomlCursor& table, const std::filesystem::path& folder,
                                 std::string_view what) {
  const std::filesystem::path path = find_file(folder, table.text("file"));
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    table.fail(table.need("file"), "file",
               fmt::format("there is no {} '{}'; a relative path must start at the scene's folder", what,
                           path.string()));
  table.table().set("file", TomlValue(path_without_scene_folder(path)));
  return path;
}

void make_paths_relative(const std::filesystem::path& folder, TomlValue& scene) {
  // std::filesystem::relative gives "" for a relative folder whose first component does not exist
  std::error_code error;
  const std::filesystem::path base = std::filesystem::absolute(folder, error);
  for_each_named_file(scene, [&](std::string& file) {
    if (std::filesystem::path(file).is_absolute())
      file = std::filesystem::relative(file, base, error).string();
  });
}

std::string file_checksum(const SceneFile& scene) {
  const std::filesystem::path folder = std::filesystem::absolute(scene.path).parent_path();
  std::string sums;
  for_each_named_file(scene.tree, [&](const std::string& file) {
    std::ifstream content(find_file(folder, file), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(content), {}};
    sums += fmt::format("{:016x}", hash_of(text));
  });
  return sums.empty() ? "" : fmt::format("{:016x}", hash_of(sums));
}

std::string file_text(const std::filesystem::path& path, std::size_t most_bytes) {
  const auto fail = [&](const std::string& message) { throw SceneError(path.string(), 0, 0, "", message); };
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) fail("no such file");
  if (std::filesystem::is_directory(status)) fail("this is a folder, not a file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail("the file cannot be read; check its permissions");
  const std::uintmax_t size = std::filesystem::file_size(path, error);  // fails for a pipe
  std::string text(std::min<std::uintmax_t>(error ? most_bytes : size, most_bytes) + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) fail("the file cannot be read");
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > most_bytes)
    fail(fmt::format("the file is larger than {} MiB, which is the limit", most_bytes >> 20));
  return text;
}

ReferenceTable read_table(const std::filesystem::path& path, const std::string& lead,
                          const std::vector<std::string>& columns) {
  Rows rows{.file = path.string(), .text = file_text(path)};
  const auto head = rows.read();
  if (!head)
    rows.fail(fmt::format("the table is empty; it must have a header with '{}' and {}", lead, join(columns)));
  const std::size_t t = column_of(rows, *head, lead);
  std::vector<std::size_t> places;
  for (const std::string& name : columns) places.push_back(column_of(rows, *head, name));
  ReferenceTable table;
  table.value.resize(columns.size());
  while (const auto row = rows.read()) {
    table.t.push_back(rows.number(*row, t));
    for (std::size_t k = 0; k < places.size(); ++k) table.value[k].push_back(rows.number(*row, places[k]));
    if (table.t.size() > 1 && !(table.t.back() > table.t[table.t.size() - 2]))
      rows.fail(lead + " must increase from row to row");
  }
  if (table.t.size() < 2) rows.fail("the table must have at least two rows");
  return table;
}

ColumnTable read_columns(const std::filesystem::path& path, const std::vector<std::string>& needed,
                         const std::vector<std::string>& optional) {
  constexpr std::size_t most_bytes = 256 << 20;
  Rows rows{.file = path.string(), .text = file_text(path, most_bytes)};
  const auto head = rows.read();
  if (!head) rows.fail("the table is empty; it must have a header with " + join(needed));
  ColumnTable table;
  std::vector<std::size_t> places;
  for (const std::string& name : needed) places.push_back(column_of(rows, *head, name));
  for (const std::string& name : optional)
    places.push_back(static_cast<std::size_t>(std::ranges::find(*head, name) - head->begin()));
  for (std::size_t k = 0; k < head->size(); ++k)
    if (std::ranges::count(places, k) == 0)
      rows.fail(fmt::format("unknown column '{}'; known columns: {}, {}", (*head)[k], join(needed),
                            join(optional)));
  table.columns.resize(places.size());
  while (const auto row = rows.read()) {
    table.lines.push_back(rows.line);
    for (std::size_t k = 0; k < places.size(); ++k)
      if (places[k] < head->size()) table.columns[k].push_back(rows.number(*row, places[k]));
  }
  if (table.lines.empty()) rows.fail("the table has no rows below its header; it must have at least one");
  return table;
}

}  // namespace taut::cli
