#!/bin/bash
# figures_test.sh WEFT SOURCE: tools/render_figures renders every figure, and docs/figures.md shows
# and names each one.
set -euo pipefail
. "$(dirname "$0")/checks.sh"
export WEFT=$weft
"$source/tools/render_figures" "$work" --spp 1 --size 5% --progress none >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }

count=0
for scene in "$source"/scenes/figures/*.xml; do
    name=$(basename "$scene" .xml)
    head -1 "$scene" | grep -q '^<!-- ' || { echo "$name.xml does not open with what it shows"; exit 1; }
    [ "$name" != studio ] || continue
    [ -s "$work/$name.png" ] || { echo "$name.png is missing"; exit 1; }
    grep -qF "images/figures/$name.jpg" "$source/docs/figures.md" || { echo "docs/figures.md does not show $name"; exit 1; }
    [ -s "$source/docs/images/figures/$name.jpg" ] || { echo "$name.jpg is missing"; exit 1; }
    count=$((count + 1))
done
grep -qx "$count figures in $work" "$work/log" || { echo "not $count figures:"; cat "$work/log"; exit 1; }
"$source/tools/make_figure_meshes" "$work/meshes" >/dev/null
diff -r "$work/meshes" "$source/scenes/figures/meshes" || { echo "the meshes are not what their tool makes"; exit 1; }
echo "$count figures render"
