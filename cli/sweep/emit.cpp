#include "cli/sweep/emit.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

constexpr EmitForm forms[] = {
    {"slurm", "sweep.slurm", R"(#!/bin/sh
#SBATCH --job-name=taut-sweep
#SBATCH --array=0-@LAST@
#SBATCH --cpus-per-task=@THREADS@
@HINT@# @TITLE@: @RUNS@ runs, one per task of a Slurm array. Submit this file with sbatch. Submit it again to repeat
# failed and stopped runs; finished runs are skipped. When all tasks have ended, the same command without --index
# collects the results and does the missing runs.
set -eu
cd @FOLDER@
exec @SWEEP@ --index "$SLURM_ARRAY_TASK_ID"
)"},
    {"parallel", "sweep.parallel", R"(#!/bin/sh
# @TITLE@: @RUNS@ runs by GNU parallel. The script passes its arguments to GNU parallel, such as --jobs 4. Run it
# again to repeat failed and stopped runs; finished runs are skipped.
set -eu
cd @FOLDER@
jobs=$(( @CORES@ / @THREADS@ ))
[ "$jobs" -gt 0 ] || jobs=1
# The command is an environment variable, since parallel would replace {} and run {= =} on its own command line.
TAUT_SWEEP=@QUOTED_SWEEP@
export TAUT_SWEEP
# A failed run does not stop the others. The last command repeats failed runs and collects the results.
seq 0 @LAST@ |
  parallel --jobs "$jobs" --env TAUT_SWEEP "$@" -q sh -c 'eval "exec $TAUT_SWEEP --quiet --index $1"' sh {} ||
  true
exec @SWEEP@
)"},
};

/// Number of physical cores with an allowed CPU, at most nproc.
constexpr std::string_view physical_cores = R"sh($(
  allowed=$(sed -n 's/^Cpus_allowed_list:[[:space:]]*//p' /proc/self/status | tr , '\n' |
    while IFS=- read -r first last; do seq "$first" "${last:-$first}"; done | paste -s -d '|')
  { nproc; lscpu --parse=CPU,CORE,SOCKET | grep -E "^($allowed)," | cut -d , -f 2- | sort -u | wc -l; } |
    sort -n | head -n 1
))sh";

std::string quoted(const std::string& word) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-+=.,:/@%").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, plain)) return word;
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

std::string command(const std::vector<std::string>& arguments) {
  std::vector<std::string> words;
  for (const std::string& argument : arguments) words.push_back(quoted(argument));
  return join(words, " ");
}

std::string one_line(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' '; }, ' ');
  return text;
}

}  // namespace

std::vector<std::string> emit_names() {
  std::vector<std::string> names;
  for (const EmitForm& form : forms) names.emplace_back(form.name);
  return names;
}

const EmitForm& find_emit_form(const std::string& name) {
  const auto* found = std::ranges::find(forms, name, &EmitForm::name);
  if (found != std::end(forms)) return *found;
  throw UsageError(unknown_name("kind of script", name, emit_names()));
}

std::string emit_script(const EmitForm& form, const std::string& title, int runs, int threads,
                        bool measures_costs, const std::vector<std::string>& sweep) {
  const std::pair<std::string_view, std::string> values[] = {
      {"@TITLE@", one_line(title)},
      {"@RUNS@", std::to_string(runs)},
      {"@LAST@", std::to_string(runs - 1)},
      {"@THREADS@", std::to_string(threads)},
      {"@HINT@", measures_costs ? "#SBATCH --hint=nomultithread\n" : ""},
      {"@CORES@", measures_costs ? std::string(physical_cores) : "$(nproc)"},
      {"@FOLDER@", quoted(std::filesystem::current_path().string())},
      {"@SWEEP@", command(sweep)},
      {"@QUOTED_SWEEP@", quoted(command(sweep))},
  };
  std::string script;
  for (std::string_view rest = form.text; !rest.empty();) {
    const auto value = std::ranges::find_if(values, [&](const auto& v) { return rest.starts_with(v.first); });
    const bool found = value != std::end(values);
    script += found ? value->second : std::string(1, rest.front());
    rest.remove_prefix(found ? value->first.size() : 1);
  }
  return script;
}

}  // namespace taut::cli
