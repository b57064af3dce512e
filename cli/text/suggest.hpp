#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// At most five candidates, fewest edits first, that are a few edits from `name` or contain it (if it has three letters).
/// A swap is one edit, a change of case none.
std::vector<std::string> nearest(std::string_view name, const std::vector<std::string>& candidates);

/// " (did you mean 'a' or 'b'?)", or "".
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

/// With at most eight names: did_you_mean() and all names. With more: did_you_mean(), or the five names with the
/// fewest edits if it is empty.
std::string known_names(std::string_view given, const std::vector<std::string>& names);

/// "unknown method 'enogg' (did you mean 'enog'?)".
std::string unknown_name(std::string_view kind, std::string_view given,
                         const std::vector<std::string>& names);

}  // namespace taut::cli
