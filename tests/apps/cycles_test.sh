#!/bin/bash
# cycles_test.sh WEFT SOURCE: pictures of bent normals beside those of Cycles. Skips without Blender.
set -uo pipefail
. "$(dirname "$0")/checks.sh"
command -v blender >/dev/null || {
    echo "Blender is not installed: tools/setup peers"
    exit 77
}
cd "$work"

if ! blender -b -noaudio --python-exit-code 1 --python "$source/tests/apps/bent_normals.py" -- "$work" \
    >blender.log 2>&1; then
    tail -n 20 blender.log
    fail "Blender did not render"
    exit 1
fi
scenes=0
for scene in *.xml; do
    name=${scene%.xml}
    expect 0 "$weft" render "$scene" -o "$name.exr"
    expect 0 "$weft" compare "$name.exr" "${name}_cycles.exr" --channels RGB --flip 0.02
    echo "$name: $(grep FLIP out)"
    scenes=$((scenes + 1))
done
[ $scenes = 7 ] || fail "expected 7 scenes, found $scenes"
exit $((failures > 0))
