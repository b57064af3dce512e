#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// At most five of the candidates that `name` may stand for, the likeliest first: few edits away (a swap of two
/// neighbouring letters counts as one, a change of case as none), or containing `name`.
std::vector<std::string> nearest(std::string_view name, const std::vector<std::string>& candidates);

/// " (did you mean 'a' or 'b'?)", the end of a message; empty if no candidate is near.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

/// The end of a message about a name that does not exist: did_you_mean(), with all names if they are at most eight; the
/// five nearest names if nothing is near.
std::string known_names(std::string_view given, const std::vector<std::string>& names);

/// "unknown method 'enogg' (did you mean 'enog'?)": a message about a name that does not exist.
std::string unknown_name(std::string_view kind, std::string_view given,
                         const std::vector<std::string>& names);

}  // namespace taut::cli
