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
# @TITLE@: @RUNS@ runs, one for each task of a Slurm array. Submit this file with sbatch. What failed or was
# stopped may be submitted again: what is done is left alone. When all tasks have ended, the same command without
# --index gathers the results, and runs what is missing.
set -eu
cd @FOLDER@
exec @SWEEP@ --index "$SLURM_ARRAY_TASK_ID"
)"},
    {"parallel", "sweep.parallel", R"(#!/bin/sh
# @TITLE@: @RUNS@ runs by GNU parallel. Arguments of this script go to it, such as --jobs 4. It may be run again:
# what is done is left alone.
set -eu
cd @FOLDER@
jobs=$(( $(nproc) / @THREADS@ ))
[ "$jobs" -gt 0 ] || jobs=1
# It stands in the environment since on its command line parallel would replace what looks like {}, and run what
# looks like {= =}.
TAUT_SWEEP=@QUOTED_SWEEP@
export TAUT_SWEEP
# a run that fails keeps no other one from running; it is told of at the end
seq 0 @LAST@ |
  parallel --jobs "$jobs" --env TAUT_SWEEP "$@" -q sh -c 'eval "exec $TAUT_SWEEP --quiet --index $1"' sh {} ||
  true
exec @SWEEP@
)"},
};

/// For sh: as it stands where that is safe, else in single quotes.
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

/// A line break would end a comment.
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
                        const std::vector<std::string>& sweep) {
  const std::pair<std::string_view, std::string> values[] = {
      {"@TITLE@", one_line(title)},
      {"@RUNS@", std::to_string(runs)},
      {"@LAST@", std::to_string(runs - 1)},
      {"@THREADS@", std::to_string(threads)},
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
