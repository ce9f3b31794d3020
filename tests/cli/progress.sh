#!/bin/sh
# SPDX-License-Identifier: MIT
# How far a run is, told while it is written; and runs that end after some minutes and go on later.
. "$SOURCE/tests/cli/lib.sh"
need_gl
. "$SOURCE/tests/cli/run_db.sh"

cat >"$work/long.yaml" <<'YAML'
name: long
resolution: [64, 48]
frames: 10
settle: 2
rsm_resolution: 32
seeds: [3, 8]
repeats: 2
reference: {min_samples: 16, max_samples: 16, bounces: 1}
scenes:
  - scene: cornell
  - scene: sphere
trials:
  - rsm: {mode: importance, samples: 16}
  - rsm-clustering: {clusters: 16}
YAML

# A table now and then, from another process.
checks=$((checks + 1))
db watch "$work/whole" "'$IRBENCH' table '$work/whole'" "$IRBENCH" run "$work/long.yaml" \
    --out "$work/whole" --json >"$work/tables" 2>"$work/events" || {
    echo "FAIL: the run that was watched"
    tail -3 "$work/events"
    failures=$((failures + 1))
}
tables_hold() { # tables_hold WHAT 'script that reads the tables'
    checks=$((checks + 1))
    sh -c "$2" <"$work/tables" >/dev/null 2>&1 && return
    echo "FAIL: $1; the tables are"
    head -40 "$work/tables"
    failures=$((failures + 1))
}
tables_hold "there are tables" "grep -q '^-- 0\$'"
tables_hold "no table fails" "! grep -q '^-- [^0]'"
tables_hold "the first line says how far it is" \
    "grep -Eq '^running: [0-9]+ %, (about [0-9.]+ min|less than a minute) left \\((references of|render|score) (cornell|sphere)'"
tables_hold "with seed and repeat" \
    "grep -Eq '^running: .*render (cornell|sphere), seed [12] of 2, time [12] of 2\\)'"
tables_hold "there are rows of the frames so far" \
    "grep -Eq '^  rsm-clustering:clusters=16 \\([0-9]+ of 10 frames\\)'"
tables_hold "there are whole rows of one scene while the other is made" \
    "grep -A9 '^running: .*sphere' | grep -Eq '^  rsm-clustering:clusters=16  +[0-9]'"
checks=$((checks + 1))
"$python" - "$work/events" "$work/tables" <<'PY' || failures=$((failures + 1))
import json, re, sys
events = [json.loads(line) for line in open(sys.argv[1])]
run = [e["run_fraction"] for e in events if e["event"] == "progress"]
assert run and all(0 <= f <= 1 for f in run) and run == sorted(run), run
assert all(e["run_left_s"] >= 0 for e in events if e["event"] == "progress")
told = [int(f) for f in re.findall(r"^running: (\d+) %", open(sys.argv[2]).read(), re.M)]
assert told == sorted(told) and told[-1] > told[0], told
PY
checks=$((checks + 1))
"$IRBENCH" table "$work/whole" | grep -q '^running\|^not finished\|of 10 frames' && {
    echo "FAIL: a run that is done is not said to be"
    failures=$((failures + 1))
}

# No time at all: the first round of each scene. Without a limit the same command goes on to the end.
check "a moment" "$IRBENCH" run "$work/long.yaml" --minutes 0.00001 --out "$work/parts"
checks=$((checks + 3))
grep -q 'warning: cornell: 1e-05 minutes are over: 3 of 4 rounds left out' "$work/err" &&
    grep -q 'warning: sphere: 1e-05 minutes are over: 3 of 4 rounds left out' "$work/err" || {
    echo "FAIL: nothing is said of what was left out:"
    cat "$work/err"
    failures=$((failures + 1))
}
[ "$(db rounds "$work/parts")" = "3 0 40" ] || {
    echo "FAIL: the rounds of a moment are"
    db rounds "$work/parts"
    failures=$((failures + 1))
}
grep -q '^not finished: [0-9]* % (' "$work/out" && grep -Eq '^  rsm-clustering:clusters=16  +[0-9]' "$work/out" || {
    echo "FAIL: the table of a part of a run:"
    cat "$work/out"
    failures=$((failures + 1))
}
# Again no time: one round more, else it would never end.
check "another moment" "$IRBENCH" run "$work/long.yaml" --minutes 0.00001 --out "$work/parts"
checks=$((checks + 1))
[ "$(db rounds "$work/parts")" = '3 0 40
8 0 20' ] || {
    echo "FAIL: the rounds of two moments are"
    db rounds "$work/parts"
    failures=$((failures + 1))
}
check "the rest" "$IRBENCH" run "$work/long.yaml" --minutes 60 --out "$work/parts"
same "in parts or at once" "$work/whole" "$work/parts"
expect 2 "--minutes: expected a number above 0; found '0'" \
    "$IRBENCH" run "$work/long.yaml" --minutes 0
expect 2 "--minutes: expected a number above 0; found 'soon'" \
    "$IRBENCH" run "$work/long.yaml" --minutes soon

# Stages and trials one by one: a run is not finished before all of them are.
head_of() { # head_of WHAT 'pattern' ARGUMENTS...: of the run "$work/pieces", run further with these
    what=$1 pattern=$2
    shift 2
    check "$what" "$IRBENCH" run "$work/long.yaml" --out "$work/pieces" --set repeats=1 "$@"
    checks=$((checks + 1))
    "$IRBENCH" table "$work/pieces" 2>"$work/err" | head -1 | grep -Eq "$pattern" && return
    echo "FAIL: $what: the table begins with"
    "$IRBENCH" table "$work/pieces" | head -1
    failures=$((failures + 1))
}
left='^not finished: stages or trials are left \((references of|render|score|pictures of|keep) '
head_of "one trial" "$left" --only rsm-clustering:clusters=16
head_of "the other one's frames" "$left" --stage render
head_of "and its scores" '^Indirect|^ *$|^cornell|^scene' --stage score
head_of "a stage again" '^Indirect|^ *$|^cornell|^scene' --stage render

# Ctrl-C
checks=$((checks + 2))
db SIGINT "$work/stopped" 30 "$IRBENCH" run "$work/long.yaml" --out "$work/stopped" || {
    echo "FAIL: Ctrl-C stops a run"
    failures=$((failures + 1))
}
"$IRBENCH" table "$work/stopped" | head -1 | grep -q '^not finished: ' || {
    echo "FAIL: a run that was stopped is not said to be:"
    "$IRBENCH" table "$work/stopped" | head -3
    failures=$((failures + 1))
}
finish
