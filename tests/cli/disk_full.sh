#!/bin/sh
# SPDX-License-Identifier: MIT
# A full disk: one clear line, exit status 5, nothing lost; the same command goes on once there is
# room. On a small tmpfs where it may be mounted, and with a limit on the size of a file everywhere.
. "$SOURCE/tests/cli/lib.sh"
need_gl
disk="$work/disk"
mkdir "$disk"
trap 'umount "$disk" 2>/dev/null; rm -rf "$work"' EXIT

cat >"$work/small.yaml" <<'YAML'
name: small
scene: cornell
seed: 1
resolution: [64, 48]
frames: 4
rsm_resolution: 16
reference: {min_samples: 4, max_samples: 4, bounces: 1}
trials:
  - rsm: {mode: uniform, samples: [4, 9, 16]}
YAML
check "the reference run" "$IRBENCH" run "$work/small.yaml" --out "$work/whole"

numbers() { # every number but the times
    "$IRBENCH" table "$1" --format csv | awk -F, '
        NR == 1 { for (i = 1; i <= NF; i++) keep[i] = $i !~ /_ms/ }
        { line = ""; for (i = 1; i <= NF; i++) if (keep[i]) line = line "," $i; print line }'
}
goes_on() { # goes_on WHAT FOLDER: the run is finished now, with the numbers of the whole one
    check "$1: goes on" "$IRBENCH" run "$work/small.yaml" --out "$2"
    checks=$((checks + 1))
    [ "$(numbers "$2")" = "$(numbers "$work/whole")" ] && return
    echo "FAIL: $1: other numbers than a run that had room"
    failures=$((failures + 1))
}
run() {
    "$IRBENCH" run "$work/small.yaml" --out "$1"
}
no_temporaries() {
    checks=$((checks + 1))
    left=$(find "$1" -name '*.tmp.*')
    [ -z "$left" ] && return
    echo "FAIL: left behind: $left"
    failures=$((failures + 1))
}

# Sizes from next to nothing, where even the database does not fit, to nearly enough.
mounted=0
for size in 16k 400k; do
    mount -t tmpfs -o size=$size irbench-test "$disk" 2>/dev/null || break
    mounted=1
    expect 5 "" run "$disk/run"
    checks=$((checks + 1))
    grep -qE '^error: .*(No space left on device|disk is full|disk I/O error)' "$work/err" || {
        echo "FAIL: a disk of $size: the message does not say that it is full:"
        cat "$work/err"
        failures=$((failures + 1))
    }
    no_temporaries "$disk"
    mount -o remount,size=64m "$disk"
    goes_on "a disk of $size" "$disk/run"
    umount "$disk"
done
if [ $mounted -eq 1 ] && mount -t tmpfs -o size=40k irbench-test "$disk"; then
    # the cache on the full disk
    IRBENCH_CACHE="$disk/cache" expect 5 "No space left on device" run "$work/cached"
    mount -o remount,size=64m "$disk"
    IRBENCH_CACHE="$disk/cache" goes_on "a full cache" "$work/cached"
    umount "$disk"
fi
[ $mounted -eq 1 ] || echo "no tmpfs may be mounted here; files of bounded size only"

# No file above so many blocks of 512 bytes: results.sqlite, then the images.
for blocks in 8 90; do
    checks=$((checks + 1))
    (ulimit -f $blocks && run "$work/limit-$blocks") >"$work/out" 2>"$work/err"
    status=$?
    if [ $status -ne 5 ] || [ "$(grep -c '^error: ' "$work/err")" -ne 1 ]; then
        echo "FAIL: files of at most $blocks blocks: exit status $status, expected 5 and one line:"
        cat "$work/err"
        failures=$((failures + 1))
    fi
    no_temporaries "$work/limit-$blocks"
    goes_on "files of at most $blocks blocks" "$work/limit-$blocks"
done
finish
