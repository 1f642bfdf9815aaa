#!/bin/bash
# gltf_models_test.sh WEFT SOURCE: Khronos' sample models, where they lie beside the checkout, are
# told about and rendered; 77 (skipped) elsewhere. Those that cannot be understood without an extension
# that is not supported are refused by its name.
set -euo pipefail
. "$(dirname "$0")/checks.sh"
models=$source/../shared/data/gltf
[ -d "$models" ] || exit 77
count=0
refused='extensionsRequired\[[0-9]+\]: the file cannot be understood without the extension .*, which is not supported'
while read -r model; do
    if ! "$weft" info "$model" 2>"$work/errors"; then
        grep -E "$refused" "$work/errors" || { cat "$work/errors"; exit 1; }
        continue
    fi
    "$weft" render "$model" -o "$work/picture.exr" --size 64x36 --spp 1 --progress none 2>"$work/errors" ||
        { cat "$work/errors"; exit 1; }
    if grep "not finite" "$work/errors"; then echo "$model"; exit 1; fi
    count=$((count + 1))
done < <(find -L "$models" -name '*.gltf' -o -name '*.glb' | sort)
[ "$count" -gt 0 ] || { echo "no model in $models"; exit 1; }
echo "$count models"
