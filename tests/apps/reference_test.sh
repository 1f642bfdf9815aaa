#!/bin/bash
# reference_test.sh WEFT SOURCE: docs/reference is what `weft docs` writes today.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$1" docs "$work"
diff -r "$work" "$2/docs/reference" || { echo "docs/reference is stale: run 'make docs'"; exit 1; }
