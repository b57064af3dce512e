#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// At most three of the candidates that `name` may have been meant to be, the likeliest first: few edits
/// away (a swap of two neighbouring letters counts as one, case as none), or containing `name`.
std::vector<std::string> nearest(std::string_view name, const std::vector<std::string>& candidates);

/// " (did you mean 'a' or 'b'?)" to be put behind a message; empty if nothing is near.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

/// "unknown method 'enogg' (did you mean 'enog'?)": what an error says of a name that does not exist. All the
/// names follow when none is near.
std::string unknown_name(std::string_view kind, std::string_view given,
                         const std::vector<std::string>& names);

}  // namespace taut::cli
