#!/bin/sh
# SPDX-License-Identifier: MIT
# What a run stores beside the main columns: regions, masked pixels, lag, constants.
. "$SOURCE/tests/cli/lib.sh"
need_gl
python=$(command -v python3) || {
    echo "skipped: no python3 to read the tables with"
    exit 77
}

cat >"$work/scores.yaml" <<'YAML'
name: scores
scene: cornell
seed: 1
resolution: [40, 30]
frames: 8
settle: 1
rsm_resolution: 64
reference: {min_samples: 64, max_samples: 64}
light:
  keys:
    - {frame: 0, position: [0.25, 0.5, 0.12], target: [0.45, 0.0, 0.1], intensity: 1, cone: 30}
    - {frame: 7, position: [0.25, 0.5, 0.12], target: [0.55, 0.25, 0.35], intensity: 1, cone: 30}
regions:
  - {name: all, box: [0, 0, 1, 1]}
  - {name: left, box: [0, 0, 0.5, 1]}
  - {name: right, box: [20, 0, 40, 30]}
  - {name: patch, box: [10, 8, 14, 12]}
trials:
  - rsm: {mode: all, clamp: 100}
YAML
json() { # json RUN: the table, as a Python expression's `row`
    "$IRBENCH" table "$1" --format json
}
holds() { # holds WHAT EXPRESSION: on standard input a table of one row, and `before` of an earlier run
    checks=$((checks + 1))
    "$python" -c '
import json, math, sys
row = json.load(open(sys.argv[1]))[0]
before = json.load(open(sys.argv[2]))[0]
def near(a, b, tolerance=1e-6):
    return abs(a - b) <= tolerance * max(abs(a), abs(b))
if not eval(sys.argv[3]):
    sys.exit("does not hold")
' "$work/now.json" "$work/before.json" "$2" 2>"$work/err" && return
    echo "FAIL: $1: $2"
    sed 's/^/    /' "$work/err"
    failures=$((failures + 1))
}

check "a run" "$IRBENCH" run "$work/scores.yaml" --out "$work/plain"
json "$work/plain" >"$work/now.json"
cp "$work/now.json" "$work/before.json"
for metric in rmse relmse bias flip flicker pop_share temporal_flip; do
    for image in indirect full; do
        holds "the region of the whole image" "near(row['${image}_$metric@all'], row['${image}_$metric'])"
    done
done
# A mean over the image is that of two halves, weighed by their pixels with geometry: one share for
# all metrics.
share="(row['full_bias'] - row['full_bias@right']) / (row['full_bias@left'] - row['full_bias@right'])"
for metric in full_relmse full_flip indirect_relmse indirect_bias indirect_flip indirect_pop_share indirect_temporal_flip; do
    holds "two halves make a whole" "0.4 < $share < 0.6 and near(row['$metric'], row['$metric@left'] * $share + row['$metric@right'] * (1 - $share), 1e-5)"
done
holds "a patch is no whole" "not near(row['full_rmse@patch'], row['full_rmse'], 1e-3)"
holds "noise makes a part of FLIP" "0 < row['indirect_flip_noise'] < row['indirect_flip']"
holds "nothing is masked" "row['masked_share'] == 0"
holds "a method without history has no lag" "row['lag'] == 0"
holds "shares and similarities" "0 < row['indirect_smape'] < 1 and 0 < row['indirect_ssim'] < 1 and 0 < row['full_ldr_flip'] < 1 and 0 < row['full_temporal_flip'] < 1"
"$IRBENCH" table "$work/plain" >"$work/text"
checks=$((checks + 1))
peak=$(sed -n 's/.*PSNR peak \([^ ]*\) and.*/\1/p' "$work/text")
[ -n "$peak" ] && holds "PSNR from RMSE and the printed peak" \
    "abs(row['indirect_psnr'] - 20 * math.log10($peak / row['indirect_rmse'])) < 0.05" || {
    echo "FAIL: the table does not print PSNR's peak"
    failures=$((failures + 1))
}

# The film: every frame's pictures, once they are scored.
trial=cornell/rsm:mode=all:clamp=100
pictures() { # pictures RUN STEM...: how many there are of each
    run=$1
    shift
    for stem; do
        printf '%s ' "$(find "$run" -path "*/$stem-*.jpg" -type f -size +0 | wc -l)"
    done
}
film() { # film WHAT RUN EXPECTED
    checks=$((checks + 1))
    found=$(pictures "$2" cornell/film/reference cornell/film/direct cornell/film/direct_reference \
        "$trial/film/indirect" "$trial/film/flip" "$trial/film/residual")
    [ "$found" = "$3 " ] && return
    echo "FAIL: $1: found '$found' pictures, expected '$3'"
    failures=$((failures + 1))
}
images() { # whether this build has them
    "$IRBENCH" doctor | grep -q '^images .*: built in'
}
if images; then
    film "a film" "$work/plain" "8 8 8 8 8 7"
    # a frame whose picture can't be written is not scored, and is made up for
    for stage in prepare render; do
        check "$stage" "$IRBENCH" run "$work/scores.yaml" --out "$work/torn" --stage $stage
    done
    mkdir -p "$work/torn/$trial/film/flip-0003.jpg/in-the-way"
    expect 5 "flip-0003.jpg" "$IRBENCH" run "$work/scores.yaml" --out "$work/torn"
    film "what was scored has its pictures" "$work/torn" "4 4 4 4 3 2"
    rm -r "$work/torn/$trial/film/flip-0003.jpg"
    check "a torn film goes on" "$IRBENCH" run "$work/scores.yaml" --out "$work/torn"
    film "a torn film is made up for" "$work/torn" "8 8 8 8 8 7"
    checks=$((checks + 1))
    for run in plain torn; do
        (cd "$work/$run" && find . -name '*.jpg' | sort | xargs md5sum) >"$work/$run.md5"
    done
    cmp -s "$work/plain.md5" "$work/torn.md5" || {
        echo "FAIL: a film in pieces has other pictures than one in a row"
        failures=$((failures + 1))
    }
fi
check "without a film" "$IRBENCH" run "$work/scores.yaml" --out "$work/dark" --set film=false
film "none was wanted" "$work/dark" "0 0 0 0 0 0"
json "$work/dark" >"$work/now.json"
holds "pictures change no number" "all(row[k] == before[k] for k in row if not k.endswith('_ms') and 'frame_ms' not in k)"

check "prepared" "$IRBENCH" run "$work/scores.yaml" --out "$work/again" --stage prepare
check "rendered" "$IRBENCH" run "$work/scores.yaml" --out "$work/again" --stage render

# Pixels that are masked between rendering and scoring: the region `patch`, in all frames, for the
# camera rests.
"$python" - "$SOURCE/tests/score" "$work/again/cornell/mask-0000.exr" <<'PY'
import sys
sys.path.insert(0, sys.argv[1])
sys.dont_write_bytecode = True
import oracle
mask = [[(float(10 <= x < 14 and 8 <= y < 12),) for x in range(40)] for y in range(30)]
oracle.write_exr(sys.argv[2], mask, ("mask.Y",))
PY
check "scored with a mask" "$IRBENCH" run "$work/scores.yaml" --out "$work/again" --stage score
json "$work/again" >"$work/now.json"
holds "the share of 16 pixels" "16 / 1200 <= row['masked_share'] <= 16 / 300"
holds "a region without a pixel has no score" "row.get('full_rmse@patch') is None and row.get('full_flip@patch') is None"
holds "the other pixels count" "row['indirect_rmse'] > 0 and row['indirect_rmse'] != before['indirect_rmse']"

# A frame that is kept after the one before it has gone: without the layers that need both.
for stage in prepare render; do
    check "$stage" "$IRBENCH" run "$work/scores.yaml" --out "$work/gap" --stage $stage
done
cp -r "$work/gap/cornell" "$work/frames"
check "scored" "$IRBENCH" run "$work/scores.yaml" --out "$work/gap" --stage score
kept="$work/gap/$trial/image-0007.exr"
layers() { # layers OF WHICH: how many channels of the file have that name
    head -c 4096 "$1" | grep -ac "$2"
}
checks=$((checks + 2))
[ "$(layers "$kept" 'residual\.Y')$(layers "$kept" 'temporal_flip\.Y')" = 11 ] || {
    echo "FAIL: a kept frame lacks the layers residual and temporal_flip"
    failures=$((failures + 1))
}
cp "$work/frames"/direct-* "$work/gap/cornell"
cp "$work/frames/${trial#*/}/frame-0007.exr" "$work/gap/$trial"
check "kept again" "$IRBENCH" run "$work/scores.yaml" --out "$work/gap" --stage score
grep -q 'warning: cornell: .*: the file of frame 6 is gone: frame 7 is kept without' "$work/err" &&
    [ "$(layers "$kept" 'residual\.Y')$(layers "$kept" 'temporal_flip\.Y')" = 00 ] || {
    echo "FAIL: a frame without the one before it has layers of both, or there is no warning"
    failures=$((failures + 1))
}

# A light at rest: no lag.
sed 's/^    - {frame: 7.*//' "$work/scores.yaml" >"$work/rest.yaml"
check "a light at rest" "$IRBENCH" run "$work/rest.yaml" --out "$work/rest"
json "$work/rest" >"$work/now.json"
holds "no lag where nothing changes" "row['lag'] is None"
holds "no flicker either" "row['indirect_temporal_flip'] == 0 and row['indirect_flicker'] == 0"
finish
