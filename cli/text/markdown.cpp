#include "cli/text/markdown.hpp"

#include "cli/text/shown.hpp"

namespace taut::cli {
namespace {

std::string row_of(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) {
    text += ' ';
    for (const char c : printable(cell)) (text += c == '|' ? "\\" : "") += c == '\n' ? ' ' : c;
    text += " |";
  }
  return text + "\n";
}

}  // namespace

std::string markdown_table(const std::vector<std::vector<std::string>>& rows) {
  std::string text;
  for (const std::vector<std::string>& row : rows) {
    text += row_of(row);
    if (&row == &rows.front()) text += row_of(std::vector<std::string>(row.size(), "---"));
  }
  return text;
}

}  // namespace taut::cli
