#!/usr/bin/env bash
# Runs situations with known answers by several methods, and compares results and answers in a table.
#
#     scenes/studies/known-answers.sh                      # all, into results/known-answers.md; two minutes of CPU time
#     scenes/studies/known-answers.sh FILE SITUATION ...   # some situations, into FILE
#
# The scenes are in known-answers/, or shipped (oblique-discs); their references are the answers. Runs are kept in
# out/known-answers; an interrupted study resumes there. Uses build/taut, or the program in TAUT.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
taut=${TAUT:-$here/../../build/taut}
to=${1:-$here/results/known-answers.md}
situations=("${@:2}")
if ((! ${#situations[@]})); then
  situations=(oblique-discs disc-on-wall lame-tube hertz-disc bars-1-2 free-l euler-column block-on-wall hanging-disc
              spinning-ring shrink-fit drawn-strip)
fi
methods="oenog tl pf-jst enog gnog d-ulsph-r-tic"
table=$(mktemp)
trap 'rm -f "$table"' EXIT

# rows NAME RESULTS: lines for the verdicts and for each measure
rows() {
  awk -v name="$1" -v methods="$methods" '
    # splits a line of a table at commas, with quoted fields
    function cut(line, field,    n, rest) {
      for (n = 0; line != ""; line = rest) {
        if (match(line, /^"([^"]|"")*"/)) { field[++n] = substr(line, 2, RLENGTH - 2); rest = substr(line, RLENGTH + 2) }
        else { match(line, /^[^,]*/); field[++n] = substr(line, 1, RLENGTH); rest = substr(line, RLENGTH + 2) }
      }
      return n
    }
    function marked(text, wrong) { return wrong ? "**" text "**" : text }
    function words(text) { gsub("_", " ", text); return text }
    function line(title, quantity, exact, key,    cells, k) {
      cells = "| " title " | " quantity " | " exact " |"
      for (k = 1; k <= count; ++k) cells = cells " " ((key, method[k]) in cell ? cell[key, method[k]] : "–") " |"
      print cells
    }
    BEGIN { count = split(methods, method, " ") }
    FNR == 1 {
      n = cut($0, head)
      for (k = 1; k <= n; ++k) {
        at[head[k]] = k
        if (match(head[k], /^measures\..*\.value$/)) measure[++measures] = substr(head[k], 10, RLENGTH - 15)
      }
      next
    }
    {
      for (k = 1; k <= n; ++k) f[k] = ""
      cut($0, f)
      m = f[at["set.method"]]
      said = f[at["verdict"]]
      for (k = 1; k <= n; ++k)
        if (f[k] != "" && split(head[k], part, ".") > 2 && part[1] == "warnings" && !index(said, words(part[2])))
          said = said ", " words(part[2])
      cell["verdict", m] = marked(said, said != "stable")
      for (k = 1; k <= measures; ++k) {
        key = measure[k]; value = f[at["measures." key ".value"]]; reference = f[at["measures." key ".reference"]]
        if (reference == "") {
          print name ": the scene has no reference for the measure " key " with " m > "/dev/stderr"; failed = 1; exit 1
        }
        if (!(key in exact) || f[at["material_law"]] != "2d_deviator")
          exact[key] = sprintf("%.4g", reference) (f[at["measures." key ".unit"]] == "1" ? "" : " " f[at["measures." key ".unit"]])
        shown = sprintf("%.3f", reference == 0 ? value : value / reference)
        if (shown == "-0.000") shown = "0.000"
        wrong = shown - (reference != 0)
        cell[key, m] = value == "" ? "**none**" : marked(shown, wrong > 0.05 || wrong < -0.05)
      }
    }
    END {
      if (failed) exit 1
      line(name, "verdict", "", "verdict")
      for (k = 1; k <= measures; ++k) line("", words(measure[k]), exact[measure[k]], measure[k])
    }' "$2"
}

{
  echo "# Situations with known answers"
  echo
  echo "Made by \`known-answers.sh\`; do not edit. A cell is the result divided by the exact result, or the result itself"
  echo "if the exact result is 0."
  echo "\`enog\` and \`gnog\` are compared with the answer of their own material law, the others with the column \"exact\"."
  echo "Bold: a verdict other than \`stable\`, a warning, or a result that is more than 5 % (0.05) off. Dash: the method"
  echo "cannot run the scene."
  echo
  printf '| situation | quantity | exact |%s\n| --- | --- | --- |%s\n' \
    "$(printf ' `%s` |' $methods)" "$(printf ' --- |%.0s' $methods)"
  for situation in "${situations[@]}"; do
    scene=$here/known-answers/$situation.toml
    [[ -e $scene ]] || scene=$situation    # a scene of `taut list scenes`
    able=$methods
    # bodies that start under stress need a method with initial neighbours
    if [[ $situation == shrink-fit ]]; then able="oenog tl pf-jst"; fi
    "$taut" sweep "$scene" --grid method="${able// /,}" --threads 1 --out "out/known-answers/$situation" >&2
    rows "$situation" "out/known-answers/$situation/results.csv"
  done
} >"$table"
mkdir -p "$(dirname "$to")"
cat "$table" >"$to"
