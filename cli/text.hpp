#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace taut {

/// The shortest text that reads back as the same number.
std::string exact(double value);
/// Four digits, for people.
std::string brief(double value);
/// "4.1 M", for rates.
std::string with_prefix(double value);
/// "12 %" of a share.
std::string percent(double share);
/// "0:07" or "1:02:03".
std::string clock_time(double seconds);
std::string join(const std::vector<std::string>& words, std::string_view between = ", ");

/// The same for a text on every machine (FNV-1a).
std::uint64_t hash_of(std::string_view text);

/// Rows of cells, printed in columns with two blanks between and `indent` before.
std::string in_columns(const std::vector<std::vector<std::string>>& rows, int indent = 2);

}  // namespace taut
