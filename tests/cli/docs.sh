#!/bin/sh
# SPDX-License-Identifier: MIT
# docs/*.md are what the program prints.
. "$SOURCE/tests/cli/lib.sh"
for subject in config cli metrics methods scenes; do
    check "docs $subject" "$IRBENCH" docs $subject
    checks=$((checks + 1))
    cmp -s "$work/out" "$SOURCE/docs/$subject.md" && continue
    echo "FAIL: docs/$subject.md is not what 'irbench docs $subject' prints; run: ninja -C build docs"
    diff "$SOURCE/docs/$subject.md" "$work/out" | head -5
    failures=$((failures + 1))
done
# every option and key is there by its name
"$IRBENCH" docs cli >"$work/cli.md"
for word in --json --per-seed --set --format IRBENCH_CACHE INTERRUPTED 'export-scene'; do
    checks=$((checks + 1))
    grep -q -- "$word" "$work/cli.md" || {
        echo "FAIL: the command-line reference does not say $word"
        failures=$((failures + 1))
    }
done
expect 2 "docs: expected config, cli, metrics, methods or scenes, found 'colours'" "$IRBENCH" docs colours
expect 2 "expected SUBJECT, found 0 arguments" "$IRBENCH" docs
finish
