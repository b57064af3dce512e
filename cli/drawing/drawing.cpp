#include "cli/drawing/drawing.hpp"

#include "cli/text/suggest.hpp"
#include "engine/error.hpp"

namespace taut::cli {

std::vector<std::string> names_of_fields() {
  std::vector<std::string> names;
  for (const Field& field : fields()) names.emplace_back(field.key);
  return names;
}

const Field& known_field(const std::string& key) {
  if (const Field* field = find_field(key)) return *field;
  throw UsageError(unknown_name("field", key, names_of_fields()));
}

}  // namespace taut::cli
