# SPDX-License-Identifier: MIT
# Shared by the command-line tests: sourced with IRBENCH (program) and SOURCE (checkout) set.
set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export IRBENCH_CACHE="${IRBENCH_CACHE:-$work/cache}" NO_COLOR=1
failures=0
checks=0

# expect STATUS 'words in the message' command...: the exit status, the words on stderr, exactly one
# line that begins with "error:", and no sign of a crash.
expect() {
    want=$1 words=$2
    shift 2
    checks=$((checks + 1))
    "$@" >"$work/out" 2>"$work/err" </dev/null
    got=$?
    if [ "$got" -ne "$want" ]; then
        echo "FAIL: $*: exit status $got, expected $want"
        sed 's/^/    /' "$work/err"
        failures=$((failures + 1))
    elif ! grep -qF -- "$words" "$work/err"; then
        echo "FAIL: $*: the message does not say '$words':"
        sed 's/^/    /' "$work/err"
        failures=$((failures + 1))
    elif [ "$want" -ne 0 ] && [ "$(grep -c '^error: ' "$work/err")" -ne 1 ]; then
        echo "FAIL: $*: expected one line that begins with 'error:'"
        sed 's/^/    /' "$work/err"
        failures=$((failures + 1))
    fi
}

# check 'what' command...: the command must succeed.
check() {
    what=$1
    shift
    checks=$((checks + 1))
    if ! "$@" >"$work/out" 2>"$work/err" </dev/null; then
        echo "FAIL: $what: $*"
        sed 's/^/    /' "$work/err"
        failures=$((failures + 1))
    fi
}

need_gl() {
    "$IRBENCH" doctor >"$work/doctor" 2>&1 || {
        echo "skipped: no OpenGL backend"
        exit 77
    }
}

finish() {
    echo "$checks checks, $failures failures"
    [ "$failures" -eq 0 ]
    exit
}
