#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// Script for Slurm or GNU parallel.
struct EmitForm {
  std::string_view name;  // of --emit
  std::string_view file;  // in the sweep's folder
  std::string_view text;  // with placeholders such as @TITLE@
};

std::vector<std::string> emit_names();
const EmitForm& find_emit_form(const std::string& name);

/// `sweep`: words of the command. `threads`: of each run.
/// With `measures_costs`, each thread gets a physical core.
std::string emit_script(const EmitForm& form, const std::string& title, int runs, int threads,
                        bool measures_costs, const std::vector<std::string>& sweep);

}  // namespace taut::cli
