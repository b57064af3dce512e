#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace taut::test {

/// A row of a table of rooms.
struct RoomRow {
  std::vector<std::string> names;  // "terms/", "simulation.hpp", "colormap" (its .hpp and its .cpp)
  std::vector<std::string> may_include;
  bool all_above = false;  // the words "all above" stand for the names of all rows above
};

/// The rooms of a part of the repository, from the bottom up, as its README.md has them: the first table with
/// a column "may include". The first column names rooms, or files that are none's, in backticks. Several
/// rooms in one row keep apart; several files are as one room.
///
///     | room | what for | may include |
///     |---|---|---|
///     | `core/` | numbers only | `error.hpp` |
///     | `methods/` | one algorithm box a room | all above |
class RoomTable {
 public:
  /// None without such a table.
  static std::optional<RoomTable> read(const std::string& markdown);

  const std::vector<RoomRow>& rows() const { return rows_; }
  /// The longest name that `file`, a path inside the part, belongs to; empty: to none.
  std::string room_of(std::string_view file) const;
  /// The row with the name `room`.
  std::size_t row_of(std::string_view room) const;
  bool allows(const std::string& from, const std::string& to) const;

 private:
  std::vector<RoomRow> rows_;
};

/// The words of `text` in backticks.
std::vector<std::string> in_backticks(const std::string& text);

}  // namespace taut::test
