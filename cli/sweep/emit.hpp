#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// A shell script that does the runs of a sweep elsewhere.
struct EmitForm {
  std::string_view name;  // of --emit
  std::string_view file;  // in the sweep's folder
  std::string_view text;  // with placeholders such as @WORD@
};

std::vector<std::string> emit_names();
/// Throws UsageError with the nearest names.
const EmitForm& find_emit_form(const std::string& name);

/// Script for `runs` runs of `threads` threads each. `sweep` is the command in words, without --index; without
/// --index the command also collects the results.
std::string emit_script(const EmitForm& form, const std::string& title, int runs, int threads,
                        const std::vector<std::string>& sweep);

}  // namespace taut::cli
