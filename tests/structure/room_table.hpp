#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace taut::test {

struct RoomRow {
  std::vector<std::string> names;  // "terms/", "simulation.hpp", "colormap" (.hpp and .cpp)
  std::vector<std::string> may_include;
  bool all_above = false;
};

/// First table of a README.md with a column "may include", lowest room first. Files of one row may include each other,
/// folders of one row may not.
///
///     | room | what for | may include |
///     |---|---|---|
///     | `core/` | numbers only | `error.hpp` |
///     | `methods/` | one algorithm per room | all above |
class RoomTable {
 public:
  static std::optional<RoomTable> read(const std::string& markdown);

  const std::vector<RoomRow>& rows() const { return rows_; }
  /// Longest matching name, or empty.
  std::string room_of(std::string_view file) const;
  std::size_t row_of(std::string_view room) const;
  bool allows(const std::string& from, const std::string& to) const;

 private:
  std::vector<RoomRow> rows_;
};

std::vector<std::string> in_backticks(const std::string& text);

}  // namespace taut::test
