#!/bin/sh
# SPDX-License-Identifier: MIT
# Benchmark: share of a run that is neither rendering, reference nor scoring (start-up, scene
# loading, database and image files), from nothing and with the references cached. Ratios of one
# process; fails above 10 %.
. "$SOURCE/tests/cli/lib.sh"
need_gl
status=0
for state in cold cached; do
    "$IRBENCH" run "$SOURCE/experiments/quick.yaml" --out "$work/$state" >"$work/out" 2>"$work/err" || {
        cat "$work/err"
        exit 1
    }
    # time: startup 0.1 s, reference 24.2 s, render 2.4 s, score 6.3 s, store 0.1 s
    awk -v state="$state" '/^time: / {
        startup = $3; reference = $6; render = $9; score = $12; store = $15
        total = startup + reference + render + score + store
        share = (startup + store) / total
        printf "%-6s start-up %.2f s, reference %.2f s, render %.2f s, score %.2f s, store %.2f s, total %.2f s: other work %.1f %%\n",
            state, startup, reference, render, score, store, total, 100 * share
        exit share > 0.1
    }' "$work/err" || status=1
done
exit $status
