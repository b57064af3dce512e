#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// A shell script for the runs of a sweep.
struct EmitForm {
  std::string_view name;
  std::string_view file;  // in the sweep's folder
  std::string_view text;  // with @WORD@ for values
};

std::vector<std::string> emit_names();
/// Throws UsageError with the nearest names.
const EmitForm& find_emit_form(const std::string& name);

/// Each run has `threads` threads. `sweep`: command without --index, which also collects results.
std::string emit_script(const EmitForm& form, const std::string& title, int runs, int threads,
                        const std::vector<std::string>& sweep);

}  // namespace taut::cli
