#include <algorithm>
#include <ostream>
#include <string_view>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/text/format.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

struct Script {
  std::string_view shell;
  std::string_view text;
};

constexpr Script scripts[] = {
    {"bash", R"(# bash completion of taut
_taut() {
  local line=${COMP_LINE:0:COMP_POINT} words word before files
  read -ra words <<< "$line"
  [[ $line == *[[:space:]] ]] && words+=("")
  word=${words[-1]}
  # bash starts a new word after = and :
  before=${word%"${word##*[=:]}"}
  {
    read -r files
    mapfile -t COMPREPLY
  } < <("${words[0]/#\~/$HOME}" --complete "${words[@]:1}" 2> /dev/null)
  COMPREPLY=("${COMPREPLY[@]%%$'\t'*}")
  COMPREPLY=("${COMPREPLY[@]#"$before"}")
  [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *= ]] && compopt -o nospace
  [[ $files ]] || return 0
  compopt -o filenames
  word=${word#"$before"}
  mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(
    compgen -d -- "$word"
    [[ $files == */ ]] || compgen -f -X "!$files" -- "$word"
  )
}
complete -F _taut taut
)"},
    {"zsh", R"(#compdef taut
# zsh completion of taut
_taut() {
  local -a answer closed open
  local line text
  answer=("${(@f)$("${(Q)words[1]/#\~/$HOME}" --complete "${(@Q)words[2,CURRENT-1]}" "$PREFIX" 2> /dev/null)}")
  for line in "${(@)answer[2,-1]}"; do
    text=${${line%%$'\t'*}//:/\\:}
    [[ $line == *$'\t'?* ]] && text+=:${line#*$'\t'}
    if [[ ${line%%$'\t'*} == *= ]]; then open+=("$text"); else closed+=("$text"); fi
  done
  _describe taut closed -- open -S ''
  if [[ $answer[1] == */ ]]; then
    [[ $PREFIX == --*=* ]] && compset -P '*='
    _files -/
  elif [[ -n $answer[1] ]]; then
    [[ $PREFIX == --*=* ]] && compset -P '*='
    _files -g "$answer[1]"
  fi
}
if [[ $funcstack[1] == _taut ]]; then _taut "$@"; else compdef _taut taut; fi
)"},
};

std::vector<std::string> shells() {
  std::vector<std::string> names;
  for (const Script& script : scripts) names.emplace_back(script.shell);
  return names;
}

int print_script(const std::string& shell, std::ostream& out) {
  const auto* script = std::ranges::find(scripts, shell, &Script::shell);
  if (script == std::end(scripts)) throw UsageError(unknown_name("shell", shell, shells()));
  out << script->text;
  return exit_fine;
}

}  // namespace

std::function<int(Streams)> declare_completion(Options& command) {
  auto shell = std::make_shared<std::string>();
  command.add_argument(join(shells(), "|"), *shell, "shell that loads the script").required();
  return [shell](Streams streams) { return print_script(*shell, streams.out); };
}

}  // namespace taut::cli
