#!/bin/bash
# reference_test.sh WEFT SOURCE: docs/reference is what `weft docs` writes today.
set -euo pipefail
. "$(dirname "$0")/checks.sh"
"$weft" docs "$work"
diff -r "$work" "$source/docs/reference" || { echo "docs/reference is stale: run 'make docs'"; exit 1; }
