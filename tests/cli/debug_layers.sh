#!/bin/sh
# SPDX-License-Identifier: MIT
# Methods with debug layers and with parameters that change over the sequence: what a run keeps, that
# it changes no number, and that a run that was stopped goes on with the same values.
. "$SOURCE/tests/cli/lib.sh"
need_gl

cat >"$work/debug.yaml" <<'YAML'
name: debug
scene: cornell
seed: 1
resolution: [24, 18]
frames: 7
settle: 3
rsm_resolution: 16
reference: {min_samples: 4, max_samples: 4, bounces: 1}
trials:
  - test-debug: {clusters: {keys: [[0, 64], [4, 128]]}}
YAML
sed 's/test-debug/test-history/' "$work/debug.yaml" >"$work/history.yaml"
with() { # with MODULE ARGUMENTS...
    module=$1
    shift
    "$IRBENCH" "$@" --module "$MODULES/module_$module.so"
}
trial='cornell/test-debug:clusters=64@0+128@4'
kept() { # kept FOLDER: the files of a trial, but for the pictures of the whole sequence
    (cd "$1/$trial" && ls | grep -v '^film$\|^profile\.\|^flicker\.')
}
there() { # there FOLDER FILES...: just these are in the trial's folder
    folder=$1
    shift
    checks=$((checks + 1))
    kept "$folder" >"$work/files"
    printf '%s\n' "$@" | sort | cmp -s - "$work/files" && return
    echo "FAIL: in $folder there are"
    cat "$work/files"
    failures=$((failures + 1))
}
images() {
    for stem in image cluster-map split ism-atlas; do
        for frame in "$@"; do
            case $stem in
            image) printf 'image-%s.exr\nimage-%s.png\n' "$frame" "$frame" ;;
            cluster-map) echo "debug-$stem-$frame.png" ;;
            *) printf "debug-$stem-%s.exr\ndebug-$stem-%s.png\n" "$frame" "$frame" ;;
            esac
        done
    done
}
numbers() { # every number but the times and the bytes
    with "$1" table "$2" --format csv | awk -F, '
        NR == 1 { for (i = 1; i <= NF; i++) keep[i] = $i !~ /_ms|gl_bytes/ }
        { line = ""; for (i = 1; i <= NF; i++) if (keep[i]) line = line "," $i; print line }'
}

with debug show "$work/debug.yaml" >"$work/show"
checks=$((checks + 1))
grep -q 'clusters=64@0+128@4 distance=2' "$work/show" || {
    echo "FAIL: show does not print the keys"
    failures=$((failures + 1))
}

# without the request: no layer, neither between the stages nor after them
check "prepared" with debug run "$work/debug.yaml" --out "$work/plain" --stage prepare
check "rendered" with debug run "$work/debug.yaml" --out "$work/plain" --stage render
there "$work/plain" $(seq -f 'frame-%04g.exr' 0 6)
check "scored" with debug run "$work/debug.yaml" --out "$work/plain" --stage score

# with it, stage by stage: those of the kept frames stay, the others go with their frames
check "prepared" with debug run "$work/debug.yaml" --out "$work/debug" --stage prepare
check "with layers" with debug run "$work/debug.yaml" --out "$work/debug" --stage render --debug-layers
checks=$((checks + 1))
[ "$(cd "$work/debug/$trial" && ls debug-* | wc -l)" -eq 14 ] || {
    echo "FAIL: between the stages every frame has the layers that are no image's size"
    failures=$((failures + 1))
}
check "scored" with debug run "$work/debug.yaml" --out "$work/debug" --stage score
kept=$(cd "$work/plain/$trial" && ls image-*.exr | sed 's/image-\(.*\).exr/\1/')
there "$work/debug" $(images $kept)
numbers debug "$work/plain" >"$work/a.csv"
numbers debug "$work/debug" >"$work/b.csv"
checks=$((checks + 1))
[ -s "$work/a.csv" ] && cmp -s "$work/a.csv" "$work/b.csv" || {
    echo "FAIL: debug layers change numbers"
    diff "$work/a.csv" "$work/b.csv"
    failures=$((failures + 1))
}
check "all frames" with debug run "$work/debug.yaml" --out "$work/all" --set debug_layers=true --keep all
there "$work/all" $(images 0000 0001 0002 0003 0004 0005 0006)
expect 0 "7 frames are rendered already and get no more debug layers" \
    with debug run "$work/debug.yaml" --out "$work/plain" --debug-layers
there "$work/plain" $(kept "$work/plain")

# what is in the files: the layer of the image's size in the frame's own, by the frame's parameters
if command -v python3 >/dev/null; then
    checks=$((checks + 1))
    python3 - "$SOURCE/tests/cycles" "$work/all/$trial" <<'PY' || failures=$((failures + 1))
import math, sys
sys.path.insert(0, sys.argv[1])
sys.dont_write_bytecode = True
import exr
for frame in range(7):
    clusters = 64 if frame < 4 else 128
    width, height, image = exr.read(f"{sys.argv[2]}/image-{frame:04}.exr")
    assert (width, height) == (24, 18)
    assert set(image["debug.cluster-map.R"]) == {clusters / 512}, frame
    assert set(image["debug.cluster-map.B"]) == {0.5}
    # indirect = albedo/pi E, E = clusters/64: twice as bright from frame 4 on
    if frame == 3:
        before = image
    if frame == 4:
        assert max(before["indirect.R"]) > 0
        assert all(abs(a * 2 - b) <= 1e-6 * b for a, b in zip(before["indirect.R"], image["indirect.R"]))
    width, height, split = exr.read(f"{sys.argv[2]}/debug-split-{frame:04}.exr")
    assert (width, height) == (12, 9) and set(split["R"]) == {clusters / 512}
    width, height, atlas = exr.read(f"{sys.argv[2]}/debug-ism-atlas-{frame:04}.exr")
    assert (width, height, list(atlas)) == (16, 8, ["Y"])
    assert list(atlas["Y"]) == ([2.0] * 8 + [math.inf] * 8) * 8
    png = open(f"{sys.argv[2]}/debug-ism-atlas-{frame:04}.png", "rb").read()
    assert png[16:24] == bytes([0, 0, 0, 16, 0, 0, 0, 8]), png[16:24]
PY
fi

# The pictures of the sequence, and the residual's layers, from the frames' own layers: a light that
# jumps once, on a reference at rest.
if command -v python3 >/dev/null; then
    checks=$((checks + 1))
    python3 - "$SOURCE/tests/cycles" "$work/all" "$trial" <<'PY' || failures=$((failures + 1))
import math, sqlite3, sys
sys.path.insert(0, sys.argv[1])
sys.dont_write_bytecode = True
import exr
run, trial = sys.argv[2:]
meta = dict(sqlite3.connect(run + "/results.sqlite").execute("select name, value from meta"))
row = int(meta["scene/cornell/profile_row"])
mean = float(meta["scene/cornell/mean_indirect"])
assert row == 9, row  # nothing changes: the middle one
images = [exr.read(f"{run}/{trial}/image-{frame:04}.exr")[2] for frame in range(7)]
width, height, profile = exr.read(f"{run}/{trial}/profile.exr")
assert (width, height) == (24, 7)
for frame, image in enumerate(images):
    for c in "RGB":
        here, there = slice(24 * frame, 24 * frame + 24), slice(24 * row, 24 * row + 24)
        assert profile["result." + c][here] == image["indirect." + c][there], frame
        assert profile["reference." + c][here] == image["reference_indirect." + c][there], frame
# geometry is where there is albedo, and with it indirect light
_, _, flicker = exr.read(f"{run}/{trial}/flicker.exr")
lit = 0
for p in range(24 * 18):
    jump = math.sqrt(sum((images[4]["indirect." + c][p] - images[3]["indirect." + c][p]) ** 2 for c in "RGB") / 3)
    level = math.sqrt(sum(images[4]["reference_indirect." + c][p] ** 2 for c in "RGB") / 3)
    pairs = flicker["pairs.Y"][p]
    assert pairs in (0, 6)
    if jump > 0:
        assert pairs == 6
        lit += 1
    assert abs(flicker["flicker.Y"][p] - jump / math.sqrt(6) / mean) <= 1e-5 * jump / mean, p
    assert flicker["pops.Y"][p] == (pairs > 0 and jump > 0.1 * max(level, 0.1 * mean)), p
    for frame, image in enumerate(images):
        residual = jump / mean if frame == 4 else 0
        assert abs(image["residual.Y"][p] - residual) <= 1e-5 * residual, (frame, p)
        assert frame == 4 or image["temporal_flip.Y"][p] == 0, (frame, p)
assert lit > 100 and max(images[4]["temporal_flip.Y"]) > 0.1
for name, size in ("profile", (52, 7 * 16)), ("flicker", (24, 18)):
    png = open(f"{run}/{trial}/{name}.png", "rb").read()
    assert png[16:24] == b"".join(n.to_bytes(4, "big") for n in size), name
PY
fi

# the tables of stages, statistics and frames
column() { # column NAME ARGUMENTS...: of the csv table
    name=$1
    shift
    "$IRBENCH" table "$work/debug" --format csv "$@" |
        awk -F, -v name="$name" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) c = i; next }
            { printf "%s ", c ? $c : "no column" }'
}
says() { # says 'what' FOUND EXPECTED
    checks=$((checks + 1))
    [ "$2" = "$3" ] && return
    echo "FAIL: $1: found '$2', expected '$3'"
    failures=$((failures + 1))
}
says "stages in the order in which they run" "$("$IRBENCH" table "$work/debug" --stages --format csv | head -1)" \
    "scene,method,trial,params,seed,seeds,stage_gbuffer_ms,stage_rsm_ms,stage_direct_ms,stage_warp_ms,stage_average_ms,stage_light_ms,frame_ms"
says "a stage that does not run" "$(column stage_average_ms --stages)" "0 "
says "flux without a light" "$(column uncovered_flux)" "0.25 "
says "what the clamp took, where it is measured" "$(column clamped_light)" "0.5 "
says "a mean over frames" "$(column statistic_clusters --statistics)" "91.4285714 "
says "a series" "$(column statistic_clusters --frames)" "64 64 64 64 128 128 128 "
says "another one" "$(column statistic_split_share --frames)" "0.25 0.5 0.25 0.5 0.25 0.5 0.25 "
says "frames" "$(column frame --frames)" "0 1 2 3 4 5 6 "
says "csv by default" "$("$IRBENCH" table "$work/debug" --frames | md5sum)" \
    "$("$IRBENCH" table "$work/debug" --frames --format csv | md5sum)"
for format in text md latex json; do
    check "stages as $format" "$IRBENCH" table "$work/debug" --stages --format $format
    check "statistics as $format" "$IRBENCH" table "$work/debug" --statistics --format $format
done
expect 2 "format: frames are printed as csv or json, not as md" "$IRBENCH" table "$work/debug" --frames --format md
expect 2 "--stages, --statistics, --frames and --ratio are four tables" "$IRBENCH" table "$work/debug" --frames --stages

# more than there is room for: one line that names the method, be it statistics or layers
few() { # few EXTRA
    sed -e "s/test-debug:.*/test-debug: {extra: $1}/" -e 's/frames: 7/frames: 1/' "$work/debug.yaml" >"$work/few.yaml"
}
few 13
check "16 layers and 15 statistics" with debug run "$work/few.yaml" --out "$work/few-13" --debug-layers
few 14
check "16 statistics" with debug run "$work/few.yaml" --out "$work/few-14"
says "all of them" "$(with debug table "$work/few-14" --frames | head -1 | tr ',' '\n' | grep -c '^statistic_\(extra\|clusters\|split\)')" 16
few 60
expect 3 "test-debug:extra=60: frame -1: expected at most 16 statistics of a method, found 62" \
    with debug run "$work/few.yaml" --out "$work/few-60"
few 14
expect 3 "test-debug:extra=14: frame 0: expected at most 16 debug layers, found 17" \
    with debug run "$work/few.yaml" --out "$work/few-17" --debug-layers

# a history through keys: settling has frame 0's value, and a run in pieces is as one in a row
check "a history" with history run "$work/history.yaml" --out "$work/whole" --debug-layers
for lost in '*-000[0-6]' '*-000[25]'; do
    rm -rf "$work/pieces"
    for stage in prepare render; do
        check "$stage" with history run "$work/history.yaml" --out "$work/pieces" --debug-layers --stage $stage
    done
    (cd "$work/pieces/$(echo "$trial" | sed s/debug/history/)" && rm $lost.exr)
    check "a stopped run goes on" with history run "$work/history.yaml" --out "$work/pieces" --debug-layers
    checks=$((checks + 1))
    for run in whole pieces; do
        (cd "$work/$run" && find . -name '*-0*' -o -name 'profile.*' -o -name 'flicker.*' | sort |
            xargs md5sum) >"$work/$run.md5"
        numbers history "$work/$run" >"$work/$run.csv"
    done
    [ -s "$work/whole.csv" ] && cmp -s "$work/whole.md5" "$work/pieces.md5" &&
        cmp -s "$work/whole.csv" "$work/pieces.csv" || {
        echo "FAIL: without $lost and resumed, the history is another one"
        diff "$work/whole.md5" "$work/pieces.md5" | head -5
        failures=$((failures + 1))
    }
done
if command -v python3 >/dev/null; then
    checks=$((checks + 1))
    python3 - "$SOURCE/tests/cycles" "$work/whole" <<'PY' || failures=$((failures + 1))
import sys
sys.path.insert(0, sys.argv[1])
sys.dont_write_bytecode = True
import exr
folder = sys.argv[2] + "/cornell/test-history:clusters=64@0+128@4"
light, expected = 0, {}
for frame in range(-3, 7):
    light = 0.5 * light + 0.5 * (1 if frame < 4 else 2)
    expected[frame] = light
first = exr.read(folder + "/image-0000.exr")[2]["indirect.R"]
last = exr.read(folder + "/image-0006.exr")[2]["indirect.R"]
ratio = expected[6] / expected[0]
assert max(first) > 0
assert all(abs(a * ratio - b) <= 1e-5 * b for a, b in zip(first, last)), (max(first), max(last), ratio)
PY
fi
finish
