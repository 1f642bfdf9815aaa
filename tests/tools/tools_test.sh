#!/usr/bin/env bash
# Tests of tools/ and of what the Makefile and the documents say about them. apt-get, dpkg-query
# and sudo are stand-ins here, so nothing is installed.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit 1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0

expect() { # expect NAME STATUS PATTERN COMMAND...: this exit status, and output that matches PATTERN
    local name=$1 status=$2 pattern=$3 output got=0
    shift 3
    output=$("$@" 2>&1) || got=$?
    if ((got == status)) && grep -qE -- "$pattern" <<<"$output"; then
        echo "ok   $name"
    else
        printf 'FAIL %s: exit status %d, wanted %d and /%s/ in:\n%s\n' \
            "$name" "$got" "$status" "$pattern" "$output"
        failures=$((failures + 1))
    fi
}

# --- layers
expect "layers: every kind of violation is found" 0 'upwards' tools/check_layers --self-test
expect "layers: this tree has none" 0 'every include points down, and every permission is used' tools/check_layers

# --- set-up
mkdir "$scratch/bin" "$scratch/no_apt"
stand_in() { printf '#!/bin/sh\n%s\n' "$2" >"$scratch/bin/$1"; }
# shellcheck disable=SC2016 # the stand-ins expand these
{
    stand_in dpkg-query 'echo "$INSTALLED"'
    stand_in apt-get 'echo "apt-get $*"'
    stand_in sudo 'exec "$@"'
}
chmod +x "$scratch"/bin/*
for program in bash awk sed grep; do ln -s "$(command -v $program)" "$scratch/no_apt/$program"; done

setup() { # setup INSTALLED ARGUMENT...: tools/setup where dpkg-query answers INSTALLED
    INSTALLED=$1 PATH=$scratch/bin:$PATH tools/setup "${@:2}"
}
setup_without_apt() { PATH=$scratch/no_apt tools/setup "$@"; }
everything=$(tools/setup --list | awk '{ print $2 " installed" }')
all_but_cmake=$(grep -v '^cmake ' <<<"$everything")

expect "set-up: silent when all is there" 0 '^$' setup "$everything" build test check fuzz
expect "set-up: --check names what is missing and why" 1 '^  cmake +configures' setup "$all_but_cmake" --check build
expect "set-up: a removed package counts as missing" 1 '^  cmake ' setup "$all_but_cmake
cmake config-files" --check build
expect "set-up: updates the lists first" 0 '^apt-get -q .*update$' setup "$all_but_cmake" build
expect "set-up: installs only what is missing" 0 '^apt-get .*install -y --no-install-recommends cmake$' setup "$all_but_cmake" build
expect "set-up: a set not asked for stays away" 0 '^$' setup "$(grep -v clang <<<"$everything")" build test
expect "set-up: an unknown set is an error" 2 'tools/setup SET' setup "$everything" bild
expect "set-up: no set is an error" 2 'tools/setup SET' setup "$everything"
expect "set-up: without apt-get it says where to look" 2 'docs/building.md' setup_without_apt build
expect "set-up: every row is a set, a package and a reason" 1 '^0$' \
    grep -cvE '^(build|test|check|fuzz|package|peers) +[a-z0-9.+-]+ +[A-Za-z].+$' <(tools/setup --list)
while read -r _ package _; do
    expect "docs/building.md names $package" 0 '' grep -qF -- "\`$package\`" docs/building.md
done < <(tools/setup --list)

# --- format: on a repository of its own
if command -v "${CLANG_FORMAT:-clang-format}" >/dev/null; then
    mkdir -p "$scratch/repo/tools" "$scratch/repo/src/base"
    cp tools/check_format "$scratch/repo/tools/"
    cp .clang-format "$scratch/repo/"
    git -C "$scratch/repo" init -q
    expect "format: no C++ file is an error" 1 'found no C\+\+ file' "$scratch/repo/tools/check_format"
    printf 'int   answer( ) ;\n' >"$scratch/repo/src/base/a.h"
    expect "format: a violation is found" 1 'a.h:1:.*clang-format' "$scratch/repo/tools/check_format"
    expect "format: --fix repairs it" 0 '^$' "$scratch/repo/tools/check_format" --fix
    expect "format: repaired" 0 '1 files in shape' "$scratch/repo/tools/check_format"
else
    echo "skip format: no clang-format here (tools/setup check installs it)"
fi

# --- Makefile
read -ra targets < <(sed -n 's/^\.PHONY: //p' Makefile)
for target in "${targets[@]}"; do
    expect "make help tells of $target" 0 "^make $target " make --no-print-directory
done
expect "make: every preset that is not hidden has a target" 0 '^$' comm -13 \
    <(printf '%s\n' release "${targets[@]}" | sort) <(cmake --list-presets | sed -nE 's/^ *"([a-z]+)".*/\1/p' | sort)

if ((failures > 0)); then
    echo "$failures failed"
    exit 1
fi
