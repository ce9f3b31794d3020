#!/bin/sh
# SPDX-License-Identifier: MIT
# Sweeps and seeds through a whole run, and what a watching program is told of it.
. "$SOURCE/tests/cli/lib.sh"
cat >"$work/sweep.yaml" <<'YAML'
name: sweep
scene: cornell
resolution: [24, 18]
frames: 2
rsm_resolution: 16
seeds: [3, 8]
reference: {min_samples: 4, max_samples: 4, bounces: 1}
trials:
  - rsm: {mode: uniform, samples: [4, 9]}
  - rsm: {matrix: [{mode: all}, {mode: importance, samples: 4}], clamp: 10}
YAML
"$IRBENCH" show "$work/sweep.yaml" >"$work/show" || failures=$((failures + 1))
expect_line() { # expect_line FILE 'text'
    checks=$((checks + 1))
    grep -qF -- "$2" "$1" && return
    echo "FAIL: '$2' is not in:"
    sed 's/^/    /' "$1"
    failures=$((failures + 1))
}
expect_line "$work/show" "seeds 3 8"
expect_line "$work/show" "4 trials with 2 seeds"
expect_line "$work/show" "  rsm:mode=uniform:samples=9"
expect_line "$work/show" "  rsm:mode=importance:samples=4:clamp=10"
need_gl

check "a run with seeds" "$IRBENCH" run "$work/sweep.yaml" --out "$work/run" --json
cp "$work/err" "$work/events"
for seed in 3 8; do
    for trial in rsm:mode=uniform:samples=4 rsm:mode=uniform:samples=9 rsm:mode=all:clamp=10; do
        checks=$((checks + 1))
        [ -s "$work/run/cornell/$trial/seed-$seed/image-0000.exr" ] || {
            echo "FAIL: no image of $trial with seed $seed"
            failures=$((failures + 1))
        }
    done
done
checks=$((checks + 1))
[ -z "$(find "$work/run" -path '*/seed-8/film')" ] || {
    echo "FAIL: a film of the second seed"
    failures=$((failures + 1))
}
rows() { # rows ARGUMENTS...: of the csv table
    "$IRBENCH" table "$work/run" --format csv "$@" | tail -n +2 | wc -l
}
checks=$((checks + 2))
[ "$(rows)" -eq 4 ] || { echo "FAIL: expected 4 rows of means, found $(rows)"; failures=$((failures + 1)); }
[ "$(rows --per-seed)" -eq 8 ] || { echo "FAIL: expected 8 rows with --per-seed"; failures=$((failures + 1)); }
"$IRBENCH" table "$work/run" >"$work/text"
expect_line "$work/text" "Means over 2 seeds"
check "LaTeX" "$IRBENCH" table "$work/run" --format latex

# one seed of several gives the numbers of a run with that seed alone, in the plain layout
check "a run with one seed" "$IRBENCH" run "$work/sweep.yaml" --seed 8 --out "$work/one"
checks=$((checks + 2))
[ -s "$work/one/cornell/rsm:mode=uniform:samples=4/image-0000.exr" ] || {
    echo "FAIL: with one seed a trial's images lie in its own folder"
    failures=$((failures + 1))
}
errors() {
    "$IRBENCH" table "$1" --format csv --per-seed | awk -F, '
        NR == 1 { for (i = 1; i <= NF; i++) { if ($i == "seed") s = i; if ($i == "indirect_rmse") e = i } }
        NR > 1 && $s == 8 { print $3, $e }'
}
[ -n "$(errors "$work/run")" ] && [ "$(errors "$work/run")" = "$(errors "$work/one")" ] || {
    echo "FAIL: seed 8 beside another one gives other numbers than alone"
    failures=$((failures + 1))
}

# A trial's own reflective shadow map is what the method would get from the config's; each has its
# own time. In the slim layout too.
for layout in full slim; do
    cat >"$work/maps.yaml" <<YAML
name: maps
scene: cornell
resolution: [24, 18]
frames: 2
rsm_resolution: 16
rsm_layout: $layout
seed: 1
reference: {min_samples: 4, max_samples: 4, bounces: 1}
trials:
  - rsm: {mode: all, rsm_resolution: [8, 32, 16]}
  - rsm: {mode: all}
YAML
    check "own maps" "$IRBENCH" run "$work/maps.yaml" --out "$work/maps-$layout"
    check "the config's map" "$IRBENCH" run "$work/maps.yaml" --set rsm_resolution=32 --only rsm:mode=all \
        --out "$work/map-$layout"
    "$IRBENCH" table "$work/maps-$layout" --format csv >"$work/maps.csv"
    column() { # column FILE NAME TRIAL
        awk -F, -v name="$2" -v trial="$3" '
            NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) c = i }
            NR > 1 && $3 == trial { print $c }' "$1"
    }
    "$IRBENCH" table "$work/map-$layout" --format csv >"$work/map.csv"
    checks=$((checks + 3))
    own=$(column "$work/maps.csv" indirect_rmse rsm:mode=all:rsm_resolution=32)
    [ -n "$own" ] && [ "$own" = "$(column "$work/map.csv" indirect_rmse rsm:mode=all)" ] || {
        echo "FAIL: $layout: a trial's own map gives $own, not what the config's does"
        failures=$((failures + 1))
    }
    same=$(column "$work/maps.csv" full_rmse rsm:mode=all:rsm_resolution=16)
    [ "$same" = "$(column "$work/maps.csv" full_rmse rsm:mode=all)" ] && [ "$same" != "$(column "$work/maps.csv" full_rmse rsm:mode=all:rsm_resolution=8)" ] || {
        echo "FAIL: $layout: of the config's resolution it is the config's"
        failures=$((failures + 1))
    }
    [ "$(column "$work/maps.csv" stage_rsm_ms rsm:mode=all:rsm_resolution=8)" != "$(column "$work/maps.csv" stage_rsm_ms rsm:mode=all)" ] || {
        echo "FAIL: $layout: maps have one time"
        failures=$((failures + 1))
    }
done
checks=$((checks + 1))
"$IRBENCH" table "$work/maps-full" --format json | grep -q '"rsm_resolution": 32' || {
    echo "FAIL: the parameter is not in the table"
    failures=$((failures + 1))
}

# every line on stderr is an object that says what it is, and the last one says where the run is
if command -v python3 >/dev/null; then
    checks=$((checks + 1))
    python3 - "$work/events" "$work/run" <<'PY' || failures=$((failures + 1))
import json, sys
events = [json.loads(line) for line in open(sys.argv[1])]
kinds = {e["event"] for e in events}
assert kinds <= {"info", "warning", "debug", "progress", "done"}, kinds
assert events[-1] == {"event": "done", "run": sys.argv[2]}, events[-1]
progress = [e for e in events if e["event"] == "progress"]
assert {"render", "score"} <= {e["what"] for e in progress}, progress
assert all(0 <= e["fraction"] <= 1 for e in progress), progress
assert any(e["what"] == "render" and e["fraction"] == 1 for e in progress), progress
PY
fi
checks=$((checks + 1))
"$IRBENCH" run "$work/missing.yaml" --json 2>"$work/err"
grep -q '^{"event": "error", "code": "INPUT", "message": ".*missing.yaml: cannot open' "$work/err" || {
    echo "FAIL: an error is no JSON line:"
    cat "$work/err"
    failures=$((failures + 1))
}
checks=$((checks + 1))
"$IRBENCH" rnu --json 2>"$work/err"
grep -q '^{"event": "error", "code": "USAGE"' "$work/err" || {
    echo "FAIL: an error of the command line is no JSON line:"
    cat "$work/err"
    failures=$((failures + 1))
}
finish
