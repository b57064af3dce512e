#include <cmath>
#include <fstream>
#include <iterator>

#include "cli/scene/sections.hpp"
#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"

namespace taut::cli {
namespace {

/// Cells of a line of a CSV file without quotes.
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

/// The rows of one file and the place in it, for messages.
struct Rows {
  std::string file;
  std::string text;
  std::size_t next = 0;
  int line = 0;

  /// The next line that is no comment; nothing at the end.
  std::optional<std::vector<std::string>> read() {
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
      fail("the row has " + std::to_string(row.size()) + " columns, fewer than the head");
    const std::string& cell = row[column];
    const auto value = parsed<double>(cell);
    if (!value || !std::isfinite(*value)) fail("'" + cell + "' is not a finite number");
    return *value;
  }
};

std::size_t column_of(const Rows& rows, const std::vector<std::string>& head, const std::string& name) {
  for (std::size_t i = 0; i < head.size(); ++i)
    if (head[i] == name) return i;
  rows.fail("the table has no column '" + name + "'" + did_you_mean(name, head) +
            "; there are: " + join(head));
}

}  // namespace

std::string file_text(const std::filesystem::path& path) {
  constexpr std::size_t most_bytes = 4 << 20;
  const auto fail = [&](const std::string& message) { throw SceneError(path.string(), 0, 0, "", message); };
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) fail("no such file");
  if (std::filesystem::is_directory(status)) fail("this is a folder, not a scene file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail("the file cannot be read; check its permissions");
  std::string text(most_bytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) fail("the file cannot be read");
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > most_bytes) fail("the file is larger than 4 MiB: this is not a scene file or table");
  return text;
}

ReferenceTable read_table(const std::filesystem::path& path, const std::string& lead,
                          const std::vector<std::string>& columns) {
  Rows rows{.file = path.string(), .text = file_text(path)};
  const auto head = rows.read();
  if (!head) rows.fail("the table is empty; it needs a head with '" + lead + "' and " + join(columns));
  const std::size_t t = column_of(rows, *head, lead);
  std::vector<std::size_t> places;
  for (const std::string& name : columns) places.push_back(column_of(rows, *head, name));
  ReferenceTable table;
  table.value.resize(columns.size());
  while (const auto row = rows.read()) {
    table.t.push_back(rows.number(*row, t));
    for (std::size_t k = 0; k < places.size(); ++k) table.value[k].push_back(rows.number(*row, places[k]));
    if (table.t.size() > 1 && !(table.t.back() > table.t[table.t.size() - 2]))
      rows.fail(lead + " must grow from row to row");
  }
  if (table.t.size() < 2) rows.fail("the table needs at least two rows");
  return table;
}

}  // namespace taut::cli
