#!/usr/bin/env bash
# Writes the tables of studies into results/: runs each study, or reads its stored runs, and copies its tables.
#
#     scenes/studies/update-results.sh                     # all studies with a picture; an hour on two cores
#     scenes/studies/update-results.sh rings-accuracy      # one study, by name or path
#     scenes/studies/update-results.sh --to DIR NAME ...   # into another folder
#
# Runs are kept in out/NAME; a study that was interrupted resumes there.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
taut=${TAUT:-$here/../../build/taut}
to=$here/results
if [[ ${1:-} == --to ]]; then to=${2:?"--to needs a folder"}; shift 2; fi

studies=("$@")
if ((! $#)); then
  mapfile -t studies < <(grep -lE '^\[(chart|map|history)\]' "$here"/*.toml)
fi
mkdir -p "$to"
for study in "${studies[@]}"; do
  name=$(basename "$study" .toml)
  "$taut" sweep "$study" --out "out/$name"
  cp "out/$name/tables.md" "$to/$name.md"
  echo "$to/$name.md"
done
