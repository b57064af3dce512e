#include "cli/study/csv.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "cli/system/atomic_file.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

// limit the memory for damaged files
constexpr std::size_t most_columns = 10000;
constexpr std::uintmax_t most_mebibytes = 256;

class CsvReader {
 public:
  CsvReader(const std::string& text, const std::string& file) : text_(text), file_(file) {}

  bool at_end() const { return at_ >= text_.size(); }
  int line() const { return line_; }

  std::vector<std::string> row() {
    std::vector<std::string> cells{cell()};
    while (!at_end() && text_[at_] == ',') {
      if (cells.size() == most_columns) fail(fmt::format("more than {} columns", most_columns));
      ++at_;
      cells.push_back(cell());
    }
    if (!at_end() && text_[at_] == '\r') ++at_;
    if (!at_end() && text_[at_] != '\n') fail("text follows the closing quote of a cell");
    ++at_;
    ++line_;
    return cells;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw UsageError(fmt::format("{}:{}: {}", file_, line_, what));
  }

 private:
  std::string cell() {
    if (!at_end() && text_[at_] == '"') return quoted_cell();
    const std::size_t end = std::min(text_.find_first_of(",\r\n", at_), text_.size());
    std::string plain = text_.substr(at_, end - at_);
    at_ = end;
    return plain;
  }

  std::string quoted_cell() {
    std::string inside;
    while (true) {
      const std::size_t quote = text_.find('"', at_ + 1);
      if (quote == std::string::npos) fail("a quote is not closed");
      inside.append(text_, at_ + 1, quote - at_ - 1);
      line_ += static_cast<int>(std::count(text_.begin() + static_cast<long>(at_) + 1,
                                           text_.begin() + static_cast<long>(quote), '\n'));
      at_ = quote + 1;
      if (at_end() || text_[at_] != '"') return inside;
      inside += '"';
    }
  }

  const std::string& text_;
  const std::string& file_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace

CsvTable parse_csv(const std::string& text, const std::string& file) {
  CsvReader reader(text, file);
  if (reader.at_end()) throw UsageError(fmt::format("'{}' is empty", file));
  CsvTable table{reader.row(), {}};
  while (!reader.at_end()) {
    const int line = reader.line();
    table.rows.push_back(reader.row());
    if (table.rows.back().size() != table.columns.size())
      throw UsageError(fmt::format("{}:{}: {} cells under {} columns", file, line, table.rows.back().size(),
                                   table.columns.size()));
  }
  return table;
}

CsvTable read_csv(const std::filesystem::path& path) {
  const auto text = read_whole(path, most_mebibytes << 20);
  if (!text) throw UsageError(fmt::format("'{}' cannot be read", path.string()));
  return parse_csv(*text, path.string());
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + "\"";
}

}  // namespace taut::cli
