#!/bin/sh
# SPDX-License-Identifier: MIT
# Error against cost: run and answer in one, answer again from the run that is there.
. "$SOURCE/tests/cli/lib.sh"
cat >"$work/trade.yaml" <<'YAML'
name: trade
scene: cornell
resolution: [24, 18]
frames: 2
rsm_resolution: 16
seeds: 3
reference: {min_samples: 4, max_samples: 4, bounces: 1}
trials:
  - rsm: {mode: uniform, samples: [4, 64]}
  - ism: {vpls: 16, point_count: 4096}
YAML
has() { # has FILE 'text'
    checks=$((checks + 1))
    grep -qF -- "$2" "$1" && return
    echo "FAIL: '$2' is not in:"
    sed 's/^/    /' "$1"
    failures=$((failures + 1))
}
expect 2 "--metric: expected flip, relmse, rmse or flicker" "$IRBENCH" tradeoff "$work/trade.yaml" --metric ssim
expect 2 "--time: expected a number above 0" "$IRBENCH" tradeoff "$work/trade.yaml" --time fast
expect 2 "answers are printed as text or md" "$IRBENCH" tradeoff "$work/trade.yaml" --format csv
need_gl
check "a run and its answers" "$IRBENCH" tradeoff "$work/trade.yaml" --out "$work/run"
for file in answers.md answers.csv equal-time.csv equal-error.csv pareto.csv; do
    checks=$((checks + 1))
    [ -s "$work/run/tradeoff/$file" ] || {
        echo "FAIL: no $file"
        failures=$((failures + 1))
    }
done
"$IRBENCH" tradeoff "$work/run" --time 0.000001 --metric rmse >"$work/answers"
has "$work/answers" "- least RMSE within 1.00e-06 ms: no measured trial; the nearest is "
has "$work/answers" "cornell: equal error, at most "
"$IRBENCH" tradeoff "$work/run" --error 1e9 --format md >"$work/answers.md"
has "$work/answers.md" "- least time for FLIP at most 1.00e+09: "
# a table of ratios, and the numbers of a figure, from the same run
"$IRBENCH" table "$work/run" --ratio ism:vpls=16:point_count=4096 >"$work/ratios"
has "$work/ratios" "cornell: ratios to ism:vpls=16:point_count=4096"
expect 2 "did you mean 'ism:vpls=16:point_count=4096'" "$IRBENCH" table "$work/run" --ratio ism:vpls=16:point_count=409
"$IRBENCH" table "$work/run" --figure convergence >"$work/convergence"
has "$work/convergence" "cornell,rsm,rsm:mode=uniform,samples,64,"
"$IRBENCH" table "$work/run" --figure convergence --scene cornell >"$work/scene"
check "a figure's numbers of one scene" cmp "$work/convergence" "$work/scene"
expect 3 "attic" "$IRBENCH" table "$work/run" --figure convergence --scene attic
expect 2 "--figure goes with --scene alone" "$IRBENCH" table "$work/run" --figure convergence --ratio ism:vpls=16:point_count=4096
expect 2 "--figure goes with --scene alone" "$IRBENCH" table "$work/run" --figure pareto --per-seed
expect 2 "--scene: a table has all scenes" "$IRBENCH" table "$work/run" --scene cornell
expect 2 "figure: expected pareto" "$IRBENCH" table "$work/run" --figure pie
finish
