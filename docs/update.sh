#!/bin/sh
# SPDX-License-Identifier: MIT
# Usage: update.sh IRBENCH SUBJECT...: writes docs/SUBJECT.md
set -eu
irbench=$1
shift
cd "$(dirname "$0")"
for subject; do
    "$irbench" docs "$subject" >"$subject.md.new"
    mv "$subject.md.new" "$subject.md"
done
