#include "cli/text/unknown_name.hpp"

#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"

namespace taut::cli {

std::string unknown_name(std::string_view kind, std::string_view given,
                         const std::vector<std::string>& names) {
  const std::string near = did_you_mean(given, names);
  return "unknown " + std::string(kind) + " '" + std::string(given) + "'" +
         (near.empty() ? "; there are: " + join(names) : near);
}

}  // namespace taut::cli
