#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How many virtual lights one method needs for the error of another, and what that saves.

    irbench table RUN --per-seed --format csv > run.csv
    plots/equal_error.py run.csv --curve acrsm clusters --target ism:vpls=512

For each scene the error of the curve's trials (one method, all its parameters but one the same) is
taken over that parameter; where it first falls to the target trial's error is found by linear
interpolation of log error over log parameter, and from where on it stays there, which is later where
the curve rises again. Intervals are 95 % bootstrap percentiles; the unit of
resampling is a seed, drawn for curve and target together. Times are interpolated at that number in
the same way and compared with the target's, as medians over the seeds: whole frame, and the stages
that --stages names (default: splat and pull-push). Python's standard library is all that it needs.
"""
import argparse
import csv
import math
import random
import statistics
import sys

RESAMPLES = 2000


def read(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def parameters(row):
    return dict(item.split("=", 1) for item in row["params"].split(";") if "=" in item)


def number(row, column):
    try:
        return float(row[column])
    except (KeyError, ValueError):
        return math.nan


def interpolate(xs, ys, x):
    """log-log, held at the ends"""
    if x <= xs[0]:
        return ys[0]
    for i in range(1, len(xs)):
        if x <= xs[i]:
            t = math.log(x / xs[i - 1]) / math.log(xs[i] / xs[i - 1])
            if ys[i] <= 0 or ys[i - 1] <= 0:
                return ys[i - 1] + t * (ys[i] - ys[i - 1])
            return ys[i - 1] * (ys[i] / ys[i - 1]) ** t
    return ys[-1]


def between(xs, ys, i, target):
    t = math.log(ys[i - 1] / target) / math.log(ys[i - 1] / ys[i])
    return xs[i - 1] * (xs[i] / xs[i - 1]) ** t


def first(xs, ys, target):
    """The least x at which the curve is at or below the target, or infinity."""
    if ys[0] <= target:
        return xs[0]
    for i in range(1, len(xs)):
        if ys[i] <= target:
            return between(xs, ys, i, target)
    return math.inf


def lasting(xs, ys, target):
    """The least x from which on it is, up to the last, or infinity."""
    if not ys[-1] <= target:
        return math.inf
    for i in range(len(xs) - 1, 0, -1):
        if ys[i - 1] > target:
            return between(xs, ys, i, target)
    return xs[0]


def mean(rows, seeds, column):
    return statistics.fmean(number(rows[seed], column) for seed in seeds)


def find(crossing, curve, target, seeds, metric):
    xs = sorted(curve)
    return crossing(xs, [mean(curve[x], seeds, metric) for x in xs], mean(target, seeds, metric))


def stage_time(row, stages):
    if not stages:
        return number(row, "frame_ms")
    times = [number(row, "stage_%s_ms" % stage) for stage in stages]
    return sum(t for t in times if not math.isnan(t))


def saving(curve, target, lights, stages):
    """target time / curve time at that many lights, medians over the seeds"""
    xs = sorted(curve)
    times = [statistics.median(stage_time(row, stages) for row in curve[x].values()) for x in xs]
    mine = interpolate(xs, times, min(max(lights, xs[0]), xs[-1]))
    theirs = statistics.median(stage_time(row, stages) for row in target.values())
    return theirs / mine if mine > 0 else math.nan


def percentile(values, share):
    values = sorted(values)
    return values[min(len(values) - 1, max(0, round(share * (len(values) - 1))))]


def text(lights, xs):
    if lights == math.inf:
        return "> %g" % xs[-1]
    return ("<= %g" if lights <= xs[0] else "%.0f") % lights


def scene_lines(rows, scene, args, out):
    method, parameter = args.curve
    curve, targets = {}, {}
    for row in (r for r in rows if r["scene"] == scene):
        if row["method"] == method and (not args.only or args.only in row["trial"]):
            curve.setdefault(float(parameters(row)[parameter]), {})[row["seed"]] = row
        if row["trial"] in args.target:
            targets.setdefault(row["trial"], {})[row["seed"]] = row
    for name in args.target:
        target = targets.get(name)
        if not target or len(curve) < 2:
            print("%s: no trial '%s' or no curve" % (scene, name), file=sys.stderr)
            continue
        seeds = sorted(set(target).intersection(*[set(c) for c in curve.values()]))
        xs = sorted(curve)
        for metric in args.metric:
            lights = find(first, curve, target, seeds, metric)
            stays = find(lasting, curve, target, seeds, metric)
            dice = random.Random(1)
            drawn = [find(first, curve, target, [dice.choice(seeds) for _ in seeds], metric)
                     for _ in range(RESAMPLES if len(seeds) > 1 else 0)]
            low, high = ((percentile(drawn, 0.025), percentile(drawn, 0.975)) if drawn
                         else (lights, lights))
            errors = " ".join("%.4g" % mean(curve[x], seeds, metric) for x in xs)
            reached = lights if lights < math.inf else xs[-1]
            out.append([scene, metric.replace("indirect_", ""), name,
                        "%.4g" % mean(target, seeds, metric), errors, text(lights, xs),
                        "%s .. %s" % (text(low, xs), text(high, xs)) if drawn else "one seed",
                        text(stays, xs),
                        "%.2f" % saving(curve, target, reached, args.stages),
                        "%.2f" % saving(curve, target, reached, [])])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("csv")
    parser.add_argument("--curve", nargs=2, required=True, metavar=("METHOD", "PARAMETER"))
    parser.add_argument("--target", action="append", required=True, help="name of a trial")
    parser.add_argument("--only", help="text that the names of the curve's trials hold")
    parser.add_argument("--metric", action="append", help="default: indirect_relmse, indirect_flip")
    parser.add_argument("--stages", nargs="*", default=["splat", "pull-push"])
    args = parser.parse_args()
    args.metric = args.metric or ["indirect_relmse", "indirect_flip"]
    rows, lines = read(args.csv), []
    for scene in dict.fromkeys(row["scene"] for row in rows):
        scene_lines(rows, scene, args, lines)
    head = ["scene", "metric", "target", "its error", "errors of the curve", args.curve[1],
            "95 %", "from there on", "stage time x", "frame time x"]
    print("| " + " | ".join(head) + " |")
    print("|" + "---|" * len(head))
    for line in lines:
        print("| " + " | ".join(line) + " |")


if __name__ == "__main__":
    main()
