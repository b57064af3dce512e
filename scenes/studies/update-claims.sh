#!/usr/bin/env bash
# Writes the table of the claims of the papers, results/claims.md, from the files in scenes/papers/.
#
#     scenes/studies/update-claims.sh                 # the table only
#     scenes/studies/update-claims.sh --all           # runs all claims first: hours; options as for `taut claims`
#     scenes/studies/update-claims.sh Lee2016 --quick
#
# Runs are kept in out/claims. A claim whose run differs from its recorded state ends the script with exit code 1.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
taut=${TAUT:-$here/../../build/taut}
if (($#)); then "$taut" claims "$@"; fi
{
  echo "# Claims of the papers"
  echo
  echo "Made by \`update-claims.sh\` from [scenes/papers](../../papers); do not edit. \`taut claims PAPER.KEY\` prints the"
  echo "commands and the criterion of a claim; \`taut claims --run PAPER.KEY\` runs it."
  echo
  "$taut" claims --markdown
} >"$here/results/claims.md"
echo "$here/results/claims.md"
