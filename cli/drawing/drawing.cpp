#include "cli/drawing/drawing.hpp"

#include "cli/text/suggest.hpp"
#include "engine/error.hpp"

namespace taut::cli {

std::vector<std::string> names_of_fields() { return names_of_fields(3); }

std::vector<std::string> names_of_fields(int dim) {
  std::vector<std::string> names;
  for (const Field& field : fields(dim)) names.emplace_back(field.key);
  return names;
}

const Field& known_field(const std::string& key, int dim) {
  if (const Field* field = find_field(key, dim)) return *field;
  throw UsageError(unknown_name("field", key, names_of_fields(dim)));
}

}  // namespace taut::cli
