#!/bin/bash
# gltf_models_test.sh WEFT SOURCE: Khronos' sample models, where they lie beside the checkout, are
# told about and rendered; 77 (skipped) elsewhere.
set -euo pipefail
. "$(dirname "$0")/checks.sh"
models=$source/../shared/data/gltf
[ -d "$models" ] || exit 77
count=0
while read -r model; do
    "$weft" info "$model"
    "$weft" render "$model" -o "$work/picture.exr" --size 64x36 --spp 1 --progress none 2>"$work/errors" ||
        { cat "$work/errors"; exit 1; }
    if grep "not finite" "$work/errors"; then echo "$model"; exit 1; fi
    count=$((count + 1))
done < <(find -L "$models" -name '*.gltf' -o -name '*.glb' | sort)
[ "$count" -gt 0 ] || { echo "no model in $models"; exit 1; }
echo "$count models"
