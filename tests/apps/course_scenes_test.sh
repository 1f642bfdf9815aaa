#!/bin/bash
# course_scenes_test.sh WEFT SOURCE: lightwave's course scenes against their reference images,
# where they lie beside the checkout; 77 (skipped) elsewhere.
set -euo pipefail
scenes=$2/../shared/lightwave
[ -d "$scenes" ] || exit 77
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp -r "$scenes/." "$work"
chmod -R u+w "$work"
"$1" test "$work"/practical_*/*.xml
