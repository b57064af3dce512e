#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// At most five candidates that resemble or contain `name`, fewest edits first.
std::vector<std::string> nearest(std::string_view name, const std::vector<std::string>& candidates);

/// " (did you mean 'a' or 'b'?)", or "".
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

/// End of a message about an unknown name.
std::string known_names(std::string_view given, const std::vector<std::string>& names);

/// "unknown method 'enogg' (did you mean 'enog'?)".
std::string unknown_name(std::string_view kind, std::string_view given,
                         const std::vector<std::string>& names);

}  // namespace taut::cli
