#!/bin/bash
# readme_test.sh WEFT SOURCE: runs every command that README.md shows, with the scene that it shows.
# Those that install, build or test everything are run by people and by continuous integration.
set -euo pipefail
. "$(dirname "$0")/checks.sh"
cd "$work"

blocks() { awk -v fence="^\`\`\`$1\$" '$0 ~ fence {on = 1; next} /^```/ {on = 0} on' "$source/README.md"; }
blocks xml >first.xml
[ -s first.xml ] || { echo "README.md shows no scene"; exit 1; }

count=0
while read -r line; do
    case $line in
    "make demo" | "make test") continue ;;
    "weft "*) ;;
    *) echo "do not know how to test: $line"; exit 1 ;;
    esac
    # The same command on few samples: the last --spp counts.
    case $line in "weft render"*) extra="--spp 2 --size 25%"; line=${line/--spp 16/}; line=${line/--size 50%/} ;; *) extra= ;; esac
    # shellcheck disable=SC2086
    "$weft" ${line#weft } $extra >log 2>&1 || { echo "failed: $line"; cat log; exit 1; }
    count=$((count + 1))
done < <(blocks sh)
[ $count -ge 5 ] || { echo "README.md shows only $count commands"; exit 1; }
[ -s first.png ] && [ -s first.exr ] && [ -s difference.png ] || { echo "a picture is missing"; exit 1; }
echo "$count commands of README.md work"
