# What the tests of the program share; to be sourced. They count in `failures`. The arguments of the
# test are the program and, where it needs them, the sources; $work is an empty folder that is gone
# when the test ends.
failures=0
weft=$(realpath "$1")
source=$(realpath "${2:-.}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# To be called where files with equal pixels have to be equal: they hold no time.
without_dates() { export SOURCE_DATE_EPOCH=0; }

# expect CODE COMMAND...: runs it, keeping its output in `out` and `err`.
expect() {
    local code=$1
    shift
    "$@" >out 2>err
    local got=$?
    [ $got = "$code" ] || fail "expected exit code $code, found $got: $*"
}
fail() {
    echo "FAIL: $1"
    if [ -f err ]; then tail -n 20 err; fi
    failures=$((failures + 1))
}
has() { grep -qF -- "$1" "$2" || fail "expected '$1' in $2"; }
