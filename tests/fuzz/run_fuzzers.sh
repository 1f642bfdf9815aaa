#!/bin/sh
# Builds the fuzzers with Clang and runs each for FUZZ_SECONDS (10), from the corpus beside this
# script and the files of tests/io/bad and bad_gltf. Exit code 77, "skipped", where there is no Clang.
set -eu

root=$(cd "$(dirname "$0")/../.." && pwd)
build=${FUZZ_BUILD:-$root/build/fuzz}

compiler=
for candidate in ${FUZZ_CXX:-clang++ clang++-19 clang++-18 clang++-17 clang++-16 clang++-15 clang++-14}; do
    if command -v "$candidate" >/dev/null; then compiler=$candidate; break; fi
done
if [ -z "$compiler" ]; then
    echo "skipped: no clang++" >&2
    exit 77
fi

cd "$root"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake --preset fuzz -B "$build" -DCMAKE_CXX_COMPILER="$compiler" >"$scratch/log" 2>&1 ||
    { cat "$scratch/log"; exit 1; }
cmake --build "$build" --target fuzzers >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }

for kind in scene ply gltf ies; do
    # New inputs go to the scratch folder; a crashing one is kept in the build folder.
    mkdir "$scratch/$kind"
    "$build/fuzz_$kind" -max_total_time="${FUZZ_SECONDS:-10}" -max_len=4096 -timeout=300 \
        -rss_limit_mb=1024 -malloc_limit_mb=256 -print_final_stats=1 \
        -artifact_prefix="$build/fuzz_$kind-" \
        "$scratch/$kind" tests/fuzz/corpus/"$kind" tests/io/bad tests/io/bad_gltf 2>"$scratch/log" ||
        { tail -n 40 "$scratch/log"; exit 1; }
    grep -E 'number_of_executed_units|average_exec_per_sec' "$scratch/log" |
        sed "s/^stat::/fuzz_$kind: /"
done
