#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// A shell script that has the runs of a sweep done one by one, elsewhere.
struct EmitForm {
  std::string_view name;  // for --emit
  std::string_view file;  // in the sweep's folder
  std::string_view text;  // with @WORD@ where a value goes in
};

std::vector<std::string> emit_names();
/// Throws UsageError, with the nearest names.
const EmitForm& find_emit_form(const std::string& name);

/// The script for a sweep of `runs` runs of `threads` threads each. `sweep` are the words of its command,
/// without --index; without that it also gathers the results.
std::string emit_script(const EmitForm& form, const std::string& title, int runs, int threads,
                        const std::vector<std::string>& sweep);

}  // namespace taut::cli
