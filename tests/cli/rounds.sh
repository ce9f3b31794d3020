#!/bin/sh
# SPDX-License-Identifier: MIT
# Seeds and repeats as rounds: what is stored of each, and that a run that was killed in any of them
# ends as if nothing had happened.
. "$SOURCE/tests/cli/lib.sh"
need_gl
. "$SOURCE/tests/cli/run_db.sh"

cat >"$work/rounds.yaml" <<'YAML'
name: rounds
scene: cornell
resolution: [32, 24]
frames: 4
settle: 2
rsm_resolution: 32
seeds: [3, 8]
repeats: 2
reference: {min_samples: 4, max_samples: 4, bounces: 1}
light:
  keys:
    - {frame: 0, position: [0.2, 0.4, 0.15], target: [0.3, 0.1, 0.55], intensity: 1, cone: 30}
    - {frame: 3, position: [0.2, 0.4, 0.15], target: [0.55, 0.2, 0.3], intensity: 1, cone: 30}
trials:
  - rsm: {mode: importance, samples: 16}
  - acrsm: {clusters: 16}
  - rsm: {mode: all}
YAML
rounds() { # rounds RUN 'lines': "seed repeat frames" of each
    checks=$((checks + 1))
    found=$(db rounds "$1")
    [ "$found" = "$2" ] && return
    echo "FAIL: $1 has the rounds"
    echo "$found"
    failures=$((failures + 1))
}
whole='3 0 12
8 0 12
3 1 12
8 1 12'

check "a run" "$IRBENCH" run "$work/rounds.yaml" --out "$work/whole"
rounds "$work/whole" "$whole"
checks=$((checks + 1))
"$IRBENCH" table "$work/whole" --format json --per-seed | "$python" -c '
import json, sys
rows = json.load(sys.stdin)
assert len(rows) == 6, len(rows)
for row in rows:
    assert 0 < row["precompute_ms"] < 1e5, row
    assert row["frame_ms"] <= row["frame_ms_worst"] and row["frame_ms_mean"] <= row["frame_ms_worst"], row
' || {
    echo "FAIL: what is paid once, and means"
    failures=$((failures + 1))
}

# In the first seed, in the second, in the repeats; a history begins again from its settle frames.
for frames in 5 16 20 30 41; do
    checks=$((checks + 1))
    db SIGKILL "$work/killed-$frames" "$frames" "$IRBENCH" run "$work/rounds.yaml" --out "$work/killed-$frames" || {
        echo "FAIL: a run was not killed at frame $frames"
        failures=$((failures + 1))
    }
    check "a killed run goes on" "$IRBENCH" run "$work/rounds.yaml" --out "$work/killed-$frames"
    same "killed after $frames frames and resumed gives the same" "$work/whole" "$work/killed-$frames"
done

# Repeats are added to a run that has been scored; they change nothing but times.
check "once" "$IRBENCH" run "$work/rounds.yaml" --set repeats=1 --out "$work/more"
rounds "$work/more" '3 0 12
8 0 12'
check "once more" "$IRBENCH" run "$work/rounds.yaml" --out "$work/more"
same "repeats that are added" "$work/whole" "$work/more"

# The bits of a repeat must be those of the first time.
checks=$((checks + 1))
"$python" -c '
import sqlite3, sys
db = sqlite3.connect(sys.argv[1])
assert db.execute("UPDATE meta SET value = \"x\" WHERE name = \"trial/3/last_image\"").rowcount == 1
db.commit()
' "$work/more/results.sqlite" || failures=$((failures + 1))
expect 4 "repeat 2 is not the image of repeat 0, bit for bit" \
    "$IRBENCH" run "$work/rounds.yaml" --set repeats=3 --out "$work/more"
finish
