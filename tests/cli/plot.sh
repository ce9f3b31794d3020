#!/bin/sh
# SPDX-License-Identifier: MIT
# irbench plot: every figure of a real run in every format, and what is refused.
. "$SOURCE/tests/cli/lib.sh"
need_gl
command -v gnuplot >/dev/null || {
    echo "skipped: no gnuplot"
    exit 77
}
cat >"$work/plots.yaml" <<'YAML'
name: plots
scenes:
  - {name: a_b, scene: cornell}
  - {name: other-1.x, scene: cornell}
seeds: 2
resolution: [32, 24]
frames: 3
settle: 1
rsm_resolution: 32
reference: {min_samples: 16, max_samples: 16}
trials:
  - rsm: {mode: uniform, samples: [10, 40]}
  - rsm: {mode: all}
YAML
check "the run" "$IRBENCH" run "$work/plots.yaml" --out "$work/run"
magic() { # magic FORMAT FILE
    case $1 in
    svg) head -c 5 "$2" | grep -q '<?xml' ;;
    png) head -c 4 "$2" | grep -q 'PNG' ;;
    pdf) head -c 5 "$2" | grep -q '%PDF-' ;;
    esac
}
export TMPDIR="$work/tmp"
mkdir "$TMPDIR"
for kind in pareto stages timeline convergence flicker; do
    for format in svg png pdf; do
        check "$kind as $format" "$IRBENCH" plot "$work/run" --kind $kind --format $format
        check "$kind is $format" magic $format "$work/run/$kind.$format"
    done
    check "$kind of one scene" "$IRBENCH" plot "$work/run" --kind $kind --scene a_b
    check "its name" grep -q '>a_b<' "$work/run/$kind-a_b.svg"
    checks=$((checks + 1))
    if grep -q '>other-1.x<' "$work/run/$kind-a_b.svg"; then
        echo "FAIL: $kind: --scene a_b shows the other scene too"
        failures=$((failures + 1))
    fi
done
check "nothing left behind" rmdir "$TMPDIR"
mkdir "$TMPDIR"
for metric in indirect_flip indirect_rmse indirect_relmse indirect_flicker; do
    check "pareto of $metric" "$IRBENCH" plot "$work/run" --kind pareto --metric $metric --cost bytes
    check "its file" test -s "$work/run/pareto-$metric-bytes.svg"
done
check "a format by its ending" "$IRBENCH" plot "$work/run" --kind stages --out "$work/x.pdf"
check "a PDF" magic pdf "$work/x.pdf"
check "trials of one's choice" "$IRBENCH" plot "$work/run" --kind timeline --only rsm:mode=all \
    --only rsm:mode=uniform:samples=10 --out "$work/t.svg"
check "both" grep -q '>rsm:mode=uniform:samples=10<' "$work/t.svg"

# --- what is refused ---
expect 2 "expected pareto, stages, timeline, convergence or flicker, found 'cake'" \
    "$IRBENCH" plot "$work/run" --kind cake
expect 2 "--kind: figure: expected pareto" "$IRBENCH" plot "$work/run"
expect 2 "--format: expected svg, png or pdf; found 'gif'" \
    "$IRBENCH" plot "$work/run" --kind stages --out "$work/x.gif"
expect 2 "--metric: expected indirect_flip, indirect_rmse" \
    "$IRBENCH" plot "$work/run" --kind pareto --metric psnr
expect 2 "--metric: the figure 'stages' has no such choice" \
    "$IRBENCH" plot "$work/run" --kind stages --metric indirect_flip
expect 2 "--cost: expected ms or bytes" "$IRBENCH" plot "$work/run" --kind pareto --cost euros
expect 3 "no trial 'ism'" "$IRBENCH" plot "$work/run" --kind timeline --only ism
expect 3 "nowhere" "$IRBENCH" plot "$work/run" --kind pareto --scene nowhere
expect 3 "$work/none" "$IRBENCH" plot "$work/none" --kind pareto
expect 5 "no/folder" "$IRBENCH" plot "$work/run" --kind pareto --out "$work/no/folder.svg"
checks=$((checks + 1))
[ -e "$work/no" ] && failures=$((failures + 1))
expect 3 "apt install gnuplot-nox" env PATH=/nonexistent "$IRBENCH" plot "$work/run" --kind pareto
expect 5 "cannot create the folder" env TMPDIR="$work/none" "$IRBENCH" plot "$work/run" --kind pareto
finish
