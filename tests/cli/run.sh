#!/bin/sh
# SPDX-License-Identifier: MIT
# The whole path on a small experiment: the table, the same bits twice and on both backends, a run
# that is stopped and goes on, stages one by one.
. "$SOURCE/tests/cli/lib.sh"
need_gl

cat >"$work/small.yaml" <<'YAML'
name: small
scene: cornell
seed: 1
resolution: [48, 36]
frames: 3
rsm_resolution: 32
reference: {min_samples: 8, max_samples: 8, bounces: 3}
light:
  falloff: smooth
  keys:
    - {frame: 0, position: [0.2, 0.4, 0.15], target: [0.3, 0.1, 0.55], intensity: 1, cone: 30}
    - {frame: 2, position: [0.2, 0.4, 0.15], target: [0.55, 0.2, 0.3], intensity: 1, cone: 30}
camera:
  keys:
    - {frame: 0, position: [0.278, 0.273, -0.8], target: [0.278, 0.273, 0], fov: 39}
    - {frame: 2, position: [0.30, 0.273, -0.8], target: [0.278, 0.273, 0], fov: 39}
objects:
  - name: short block
    keys:
      - {frame: 0}
      - {frame: 2, translate: [0.05, 0.02, 0], rotate: [0, 1, 0, 20]}
trials:
  - rsm: {mode: uniform, samples: 64}
  - rsm: {mode: importance, samples: 64}
  - rsm: {mode: all}
YAML

# every number but the times
numbers() {
    "$IRBENCH" table "$1" --format csv | awk -F, '
        NR == 1 { for (i = 1; i <= NF; i++) keep[i] = $i !~ /_ms/ }
        { line = ""; for (i = 1; i <= NF; i++) if (keep[i]) line = line "," $i; print line }'
}
images() {
    (cd "$1" && find . -name 'image-*' | sort | xargs md5sum)
}
same() { # same WHAT A B: the runs in folders A and B agree in every number and image
    checks=$((checks + 1))
    numbers "$2" >"$work/a.csv"
    numbers "$3" >"$work/b.csv"
    images "$2" >"$work/a.md5"
    images "$3" >"$work/b.md5"
    [ -s "$work/a.csv" ] && [ -s "$work/a.md5" ] && cmp -s "$work/a.csv" "$work/b.csv" &&
        cmp -s "$work/a.md5" "$work/b.md5" && return
    failures=$((failures + 1))
    echo "FAIL: $1"
    diff "$work/a.csv" "$work/b.csv" | head -5
    diff "$work/a.md5" "$work/b.md5" | head -5
}

check "a first run" "$IRBENCH" run "$work/small.yaml" --out "$work/first"
check "a second run" "$IRBENCH" run "$work/small.yaml" --out "$work/second"
same "the same run twice gives the same bits" "$work/first" "$work/second"

IRBENCH_CACHE="$work/cache-1" check "one thread, own references" \
    "$IRBENCH" run "$work/small.yaml" --threads 1 --out "$work/one-thread"
same "references and scores do not depend on the threads" "$work/first" "$work/one-thread"

for stage in prepare render score; do
    check "stage $stage alone" "$IRBENCH" run "$work/small.yaml" --stage $stage --out "$work/stages"
done
same "stage by stage gives the same" "$work/first" "$work/stages"

check "one trial first" "$IRBENCH" run "$work/small.yaml" --only rsm:mode=all --out "$work/parts"
check "then the rest" "$IRBENCH" run "$work/small.yaml" --out "$work/parts"
checks=$((checks + 1))
numbers "$work/first" | sort >"$work/a.csv"
numbers "$work/parts" | sort >"$work/b.csv"
cmp -s "$work/a.csv" "$work/b.csv" || {
    echo "FAIL: a run in two parts gives other numbers"
    failures=$((failures + 1))
}

# Stopped after a while, at several moments, then resumed: as if nothing had happened.
for delay in 0.2 0.6 1; do
    rm -rf "$work/killed" "$work/cache-2"
    IRBENCH_CACHE="$work/cache-2" timeout -s KILL "$delay" "$IRBENCH" run "$work/small.yaml" \
        --out "$work/killed" >/dev/null 2>&1
    IRBENCH_CACHE="$work/cache-2" check "a killed run goes on" \
        "$IRBENCH" run "$work/small.yaml" --out "$work/killed"
    same "killed after $delay s and resumed gives the same" "$work/first" "$work/killed"
done

checks=$((checks + 1))
timeout -s INT 0.4 "$IRBENCH" run "$work/small.yaml" --out "$work/stopped" \
    --set reference.max_samples=512 --set reference.min_samples=512 >"$work/out" 2>"$work/err"
"$IRBENCH" run "$work/small.yaml" --out "$work/stopped" --set reference.max_samples=512 \
    --set reference.min_samples=512 >"$work/out" 2>"$work/err" || {
    echo "FAIL: a run stopped with Ctrl-C does not go on"
    cat "$work/err"
    failures=$((failures + 1))
}

if "$IRBENCH" doctor --backend osmesa >"$work/osmesa" 2>&1 &&
    "$IRBENCH" doctor --backend egl >"$work/egl" 2>&1 && grep -q llvmpipe "$work/egl"; then
    check "OSMesa" "$IRBENCH" run "$work/small.yaml" --backend osmesa --out "$work/osmesa-run"
    check "EGL" "$IRBENCH" run "$work/small.yaml" --backend egl --out "$work/egl-run"
    same "OSMesa and EGL on llvmpipe give the same bits" "$work/osmesa-run" "$work/egl-run"
fi

for format in text csv md json; do
    check "table as $format" "$IRBENCH" table "$work/first" --format $format
done
checks=$((checks + 1))
if command -v python3 >/dev/null; then
    "$IRBENCH" table "$work/first" --format json | python3 -c '
import json, sys
rows = json.load(sys.stdin)
assert len(rows) == 3, len(rows)
for row in rows:
    for key in ("scene", "method", "trial", "params", "indirect_relmse", "full_flip", "frame_ms",
                "stage_gather_ms", "indirect_flicker"):
        assert key in row, key
    assert row["non_finite"] == 0 and row["indirect_rmse"] > 0 and row["frame_ms"] > 0
' || {
        echo "FAIL: the JSON table"
        failures=$((failures + 1))
    }
fi
check "reference --key" "$IRBENCH" reference "$work/small.yaml" --key
finish
