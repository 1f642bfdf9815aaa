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
# wait_for COMMAND...: until it succeeds. Tests wait for what has to happen, however busy the machine
# is; ten minutes are no measure of speed, but say that something hangs.
wait_for() {
    local start=$SECONDS
    until "$@" 2>/dev/null; do
        if [ $((SECONDS - start)) -gt 600 ]; then
            fail "still waiting after ten minutes: $*"
            return 1
        fi
        sleep 0.05
    done
}
# start_render ARGUMENTS...: a render without end in the background, $pid, whose progress goes to
# `err` as JSON.
start_render() {
    : >err # what an earlier one wrote is not to be waited for
    "$weft" render "$@" --spp 10000000 --progress json >out 2>err &
    pid=$!
}
# Waits until every pixel has a sample.
wait_for_samples() { wait_for grep -q '"phase":"render".*"samples":[1-9]' err; }
# stop_render: as Ctrl-C does; leaves the exit code in `code`.
stop_render() {
    kill -INT $pid
    wait $pid
    code=$?
}
has() { grep -qF -- "$1" "$2" || fail "expected '$1' in $2"; }
