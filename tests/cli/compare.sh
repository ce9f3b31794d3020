#!/bin/sh
# SPDX-License-Identifier: MIT
# irbench compare: bounds and their exit status, layers, maps, and what is refused.
. "$SOURCE/tests/cli/lib.sh"

python=$(command -v python3) || {
    echo "skipped: no python3 to write the images with"
    exit 77
}

# Images by formulas, through the writers of tests/score/oracle.py.
"$python" - "$SOURCE/tests/score" "$work" <<'PY' || exit 1
import sys
sys.path.insert(0, sys.argv[1])
sys.dont_write_bytecode = True
import oracle
work = sys.argv[2]
for name, size, changed in (("a", (40, 30), True), ("b", (40, 30), False), ("small", (8, 6), False)):
    oracle.write_exr(f"{work}/{name}.exr", oracle.radiance(*size, changed))
black = [[(0.0, 0.0, 0.0)] * 40 for _ in range(30)]
oracle.write_exr(f"{work}/black.exr", black)
broken = [[(float("nan"), 1.0, 1.0)] * 40 for _ in range(30)]
oracle.write_exr(f"{work}/nan.exr", broken)
oracle.write_png(f"{work}/a.png", oracle.flip_ldr("testA"))
oracle.write_png(f"{work}/b.png", oracle.flip_ldr("ref8"))
PY
cd "$work" || exit 1

field() { # field NAME: a number of the JSON object in $work/out
    sed -n "s/.*\"$1\": \([^,}]*\).*/\1/p" "$work/out"
}
expect_field() { # expect_field NAME VALUE
    checks=$((checks + 1))
    [ "$(field "$1")" = "$2" ] && return
    echo "FAIL: $1 is '$(field "$1")', expected '$2'"
    failures=$((failures + 1))
}

# --- figures ---
check "two images" "$IRBENCH" compare a.exr b.exr
check "as JSON" "$IRBENCH" compare a.exr b.exr --format json
check "equal images" "$IRBENCH" compare b.exr b.exr --format json --max rmse=0 --min ssim=1 --max flip=0
expect_field rmse 0
expect_field psnr null # infinite
expect_field energy_ratio 1
check "a black reference" "$IRBENCH" compare a.exr black.exr --format json
expect_field flip null
expect_field psnr null
expect_field energy_ratio null
check "an image without one good pixel" "$IRBENCH" compare nan.exr b.exr --format json
expect_field rmse null
expect_field non_finite 1200
check "images smaller than SSIM's window" "$IRBENCH" compare small.exr small.exr --format json
expect_field ssim null
if "$IRBENCH" --version | grep -q images; then
    check "display-referred images" "$IRBENCH" compare a.png b.png --format json --max ldr_flip=0.0659
    expect_field exposure 0
    expect 1 "ldr_flip is 0.065781, expected at most 0.065" "$IRBENCH" compare a.png b.png --max ldr_flip=0.065
fi

# --- bounds ---
check "bounds that hold" "$IRBENCH" compare a.exr b.exr --max relmse=0.1 --min ssim=0.5 --min psnr=20
expect 1 "relmse is " "$IRBENCH" compare a.exr b.exr --max relmse=0.001
expect 1 "expected at least 90" "$IRBENCH" compare a.exr b.exr --min psnr=90
expect 1 "ssim is " "$IRBENCH" compare a.exr b.exr --max relmse=0.001 --min ssim=0.9999
expect 1 "flip is nan, expected at most 1" "$IRBENCH" compare a.exr black.exr --max flip=1
expect 2 "unknown metric 'relmsee'; did you mean relmse?" "$IRBENCH" compare a.exr b.exr --max relmsee=1
expect 2 "expected one of rmse, relmse" "$IRBENCH" compare a.exr b.exr --max xyzzyxyzzy=1
expect 2 "--max: expected METRIC=VALUE; found 'relmse'" "$IRBENCH" compare a.exr b.exr --max relmse
expect 2 "expected a number; found 'x'" "$IRBENCH" compare a.exr b.exr --min psnr=x
expect 2 "expected a number; found 'nan'" "$IRBENCH" compare a.exr b.exr --max rmse=nan

# --- maps and layers ---
check "maps" "$IRBENCH" compare a.exr b.exr --out maps
check "a layer" "$IRBENCH" compare maps/maps.exr maps/maps.exr --layer flip --max rmse=0
check "maps where FLIP is not defined" "$IRBENCH" compare a.exr black.exr --out dark/er
checks=$((checks + 1))
if "$IRBENCH" --version | grep -q images; then
    for name in difference difference_x8 relmse flip ldr_flip dissimilarity; do
        [ -s "maps/$name.png" ] || {
            echo "FAIL: no maps/$name.png"
            failures=$((failures + 1))
        }
    done
fi
# maps do not depend on the threads
check "on one thread" "$IRBENCH" compare a.exr b.exr --out one --threads 1
check "the same maps" cmp maps/maps.exr one/maps.exr

# --- what is refused ---
expect 3 "a.exr, small.exr: the images differ in size: 40 x 30 and, for the reference, 8 x 6" \
    "$IRBENCH" compare a.exr small.exr
expect 3 "a.exr: expected a channel 'indirect.R', found none" "$IRBENCH" compare a.exr b.exr --layer indirect
expect 2 "a.png: --layer: only OpenEXR files" "$IRBENCH" compare a.png b.exr --layer indirect
expect 3 "nowhere.exr: no such file" "$IRBENCH" compare nowhere.exr b.exr
echo "this is no image" >text.exr
echo "this is no image" >text.png
expect 3 "text.exr: expected an OpenEXR file" "$IRBENCH" compare text.exr b.exr
expect 3 "text.png" "$IRBENCH" compare text.png b.exr
head -c 3000 a.exr >cut.exr
expect 3 "cut.exr" "$IRBENCH" compare cut.exr b.exr
expect 3 "$work: " "$IRBENCH" compare "$work" b.exr
expect 2 "compare: expected IMAGE REFERENCE, found 1 argument" "$IRBENCH" compare a.exr
expect 2 "compare: --format: expected text or json; found 'md'" "$IRBENCH" compare a.exr b.exr --format md
: >a-file
expect 5 "a-file" "$IRBENCH" compare a.exr b.exr --out a-file/maps
finish
