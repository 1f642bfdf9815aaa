# What the tests of the program share; to be sourced. They count in `failures`.
failures=0

# Goes to an empty folder, $work, that is gone when the test ends.
enter_new_folder() {
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
    cd "$work" || exit 1
}

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
