#pragma once

#include <string>

namespace taut::cli {

/// The processor that this program runs on, as it calls itself; "unknown" where it does not say.
std::string machine_name();

}  // namespace taut::cli
