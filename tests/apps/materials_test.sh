#!/bin/bash
# materials_test.sh WEFT SOURCE: every file of scenes/materials loads, is listed and printed by
# `weft help`, and stands with its swatch in docs/materials.md, which is up to date.
set -uo pipefail
. "$(dirname "$0")/checks.sh"

# info BSDF: what `weft info` says of a ball with this material, into $work/out.
info() {
    cat >"$work/scene.xml" <<X
<scene>
  <camera type="perspective" width="8" height="8"><transform><translate z="-4"/></transform></camera>
  <light type="envmap"/>
  <instance><shape type="mesh" filename="$source/scenes/swatch/ball.ply"/>$1</instance>
</scene>
X
    [ -z "${2:-}" ] || sed -i "s|<scene>|<include filename=\"$2\"/>&|" "$work/scene.xml"
    "$weft" info "$work/scene.xml" >"$work/out" 2>&1 || fail "$1: $(cat "$work/out")"
    if grep -i warning "$work/out"; then fail "$1: a warning"; fi
}

"$weft" help >"$work/topics" || fail "weft help"
grep -q '^  materials ' "$work/topics" || fail "weft help does not list the topic 'materials'"
"$weft" help materials >"$work/materials" || fail "weft help materials"

count=0
for file in "$source"/scenes/materials/*.xml; do
    name=$(basename "$file" .xml)
    info "<ref id=\"$name\"/>" "$file"
    grep -q "^  $name " "$work/materials" || fail "weft help materials does not list $name"
    "$weft" help "$name" | cmp -s - "$file" || fail "weft help $name is not $file"
    [ -s "$source/docs/materials/$name.jpg" ] || fail "no swatch of $name: tools/render_swatches"
    count=$((count + 1))
done
[ $count -ge 24 ] || fail "only $count materials"

# The values for words are ones that `disney` takes.
words=0
while read -r values; do
    info "<bsdf type=\"disney\" $values/>"
    words=$((words + 1))
done < <(sed '/^Materials of/,$d' "$work/materials" | grep '^      [a-zA-Z]*="')
[ $words -ge 12 ] || fail "only $words ways to feel"

"$weft" help materials --markdown | cmp - "$source/docs/materials.md" ||
    fail "docs/materials.md is stale: run 'make docs'"
"$weft" help denin >"$work/out" 2>&1
grep -q "did you mean 'denim'" "$work/out" || fail "no suggestion"
"$weft" help disney --markdown >/dev/null 2>&1 && fail "--markdown alone"

[ $failures = 0 ] && echo "$count materials and $words words work"
exit $((failures > 0))
