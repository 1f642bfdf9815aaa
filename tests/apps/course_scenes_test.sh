#!/bin/bash
# course_scenes_test.sh WEFT SOURCE: lightwave's course scenes against their reference images,
# where they lie beside the checkout; 77 (skipped) elsewhere.
set -euo pipefail
. "$(dirname "$0")/checks.sh"
scenes=$source/../shared/lightwave
[ -d "$scenes" ] || exit 77
cp -r "$scenes/." "$work"
chmod -R u+w "$work"
"$weft" test "$work"/practical_*/*.xml
