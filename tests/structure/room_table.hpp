#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace taut::test {

struct RoomRow {
  std::vector<std::string> names;  // "terms/", "simulation.hpp", "colormap" (its .hpp and its .cpp)
  std::vector<std::string> may_include;
  bool all_above = false;  // "all above": may include all rooms of the rows above
};

/// The table of rooms in the README.md of a part, lowest room first: the first table with a column "may include". The
/// first column names rooms, or files outside all rooms, in backticks. Rooms in one row cannot include each other;
/// files in one row can.
///
///     | room | what for | may include |
///     |---|---|---|
///     | `core/` | numbers only | `error.hpp` |
///     | `methods/` | one algorithm box a room | all above |
class RoomTable {
 public:
  /// Returns nothing if the text has no such table.
  static std::optional<RoomTable> read(const std::string& markdown);

  const std::vector<RoomRow>& rows() const { return rows_; }
  /// Returns the longest name that matches `file`, a path inside the part; empty if none does.
  std::string room_of(std::string_view file) const;
  std::size_t row_of(std::string_view room) const;
  bool allows(const std::string& from, const std::string& to) const;

 private:
  std::vector<RoomRow> rows_;
};

std::vector<std::string> in_backticks(const std::string& text);

}  // namespace taut::test
