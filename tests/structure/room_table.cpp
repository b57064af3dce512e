#include "tests/structure/room_table.hpp"

#include <algorithm>
#include <sstream>

namespace taut::test {
namespace {

/// Cells of a table row; empty for any other line.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  if (!line.starts_with('|')) return cells;
  std::istringstream rest(line.substr(1));
  for (std::string cell; std::getline(rest, cell, '|');) {
    const std::size_t first = cell.find_first_not_of(' '), last = cell.find_last_not_of(' ');
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  return cells;
}

bool belongs(std::string_view file, std::string_view name) {
  if (name.ends_with('/')) return file.starts_with(name);
  return file == name || file.substr(0, file.rfind('.')) == name;
}

bool has(const std::vector<std::string>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

}  // namespace

std::vector<std::string> in_backticks(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t at = text.find('`'); at != std::string::npos;) {
    const std::size_t end = text.find('`', at + 1);
    if (end == std::string::npos) break;
    words.push_back(text.substr(at + 1, end - at - 1));
    at = text.find('`', end + 1);
  }
  return words;
}

std::optional<RoomTable> RoomTable::read(const std::string& markdown) {
  RoomTable table;
  std::size_t column = 0;  // "may include"; 0 before the table
  std::istringstream lines(markdown);
  for (std::string line; std::getline(lines, line);) {
    const std::vector<std::string> cells = cells_of(line);
    if (column > 0 && cells.empty()) break;
    if (column == 0) {
      const auto found = std::ranges::find(cells, "may include");
      if (found != cells.end()) column = static_cast<std::size_t>(found - cells.begin());
    } else if (column < cells.size() && !cells[0].starts_with('-')) {
      table.rows_.push_back({in_backticks(cells[0]), in_backticks(cells[column]),
                             cells[column].find("all above") != std::string::npos});
    }
  }
  return table.rows_.empty() ? std::nullopt : std::optional(table);
}

std::string RoomTable::room_of(std::string_view file) const {
  std::string longest;
  for (const RoomRow& row : rows_)
    for (const std::string& name : row.names)
      if (belongs(file, name) && name.size() > longest.size()) longest = name;
  return longest;
}

std::size_t RoomTable::row_of(std::string_view room) const {
  const auto found = std::ranges::find_if(rows_, [&](const RoomRow& row) { return has(row.names, room); });
  return static_cast<std::size_t>(found - rows_.begin());
}

bool RoomTable::allows(const std::string& from, const std::string& to) const {
  const std::size_t row = row_of(from), other = row_of(to);
  const bool files_of_one_row = row == other && !from.ends_with('/') && !to.ends_with('/');
  return from == to || files_of_one_row || (rows_[row].all_above && other < row) ||
         has(rows_[row].may_include, to);
}

}  // namespace taut::test
