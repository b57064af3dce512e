#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// "unknown method 'enogg' (did you mean 'enog'?)": what an error says of a name that does not exist. All the
/// names follow when none is near.
std::string unknown_name(std::string_view kind, std::string_view given,
                         const std::vector<std::string>& names);

}  // namespace taut::cli
