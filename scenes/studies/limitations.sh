#!/usr/bin/env bash
# Runs the `taut run` commands of engine/METHODS.md, and writes excerpts of their reports as Markdown.
#
#     scenes/studies/limitations.sh                    # all, into results/limitations.md; some minutes
#     scenes/studies/limitations.sh FILE PATTERN       # commands that match PATTERN, into FILE
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
taut=${TAUT:-$here/../../build/taut}
to=$(realpath -m "${1:-$here/results/limitations.md}")
pattern=${2:-.}
runs=$(mktemp -d)
trap 'rm -rf "$runs"' EXIT

mapfile -t commands < <(grep -o '`taut run [^`]*`' "$here/../../engine/METHODS.md" | tr -d '`' | sort -u | grep -e "$pattern")
cd "$runs"
{
  echo "# Limitations: what their commands report"
  echo
  echo "Made by \`limitations.sh\` from the commands in [METHODS.md](../../../engine/METHODS.md#limitations); do not edit."
  for command in "${commands[@]}"; do
    echo "$command" >&2
    printf '\n**`%s`**\n\n```\n' "$command"
    code=0
    "$taut" ${command#taut } --no-render --quiet --out run >report 2>said || code=$?
    case $code in
      0 | 3) sed -n '/^  measure /,/^$/{/^$/d;p}; /^  verdict /p; /^  energy /p; /^  warning /p; /^  law /p' report ;;  # 3: diverged
      2) sed 's|^[^ ]*/scenes/||' said ;;  # refused
      *) cat said >&2; exit 1 ;;
    esac
    printf '```\n'
  done
} >"$runs/page"
mkdir -p "$(dirname "$to")"
mv "$runs/page" "$to"
