# SPDX-License-Identifier: MIT
# Databases of runs: sourced behind lib.sh.
python=$(command -v python3) || {
    echo "skipped: no python3 to read the database with"
    exit 77
}
db() {
    "$python" -B "$SOURCE/tests/cli/run_db.py" "$@"
}

images() {
    (cd "$1" && find . -name '*.exr' -o -name '*.png' | sort | xargs md5sum)
}
same() { # same WHAT A B: all that is no time agrees
    checks=$((checks + 1))
    db dump "$2" >"$work/a.txt"
    db dump "$3" >"$work/b.txt"
    images "$2" >"$work/a.md5"
    images "$3" >"$work/b.md5"
    [ -s "$work/a.txt" ] && [ -s "$work/a.md5" ] && cmp -s "$work/a.txt" "$work/b.txt" &&
        cmp -s "$work/a.md5" "$work/b.md5" && return
    failures=$((failures + 1))
    echo "FAIL: $1"
    diff "$work/a.txt" "$work/b.txt" | head -5
    diff "$work/a.md5" "$work/b.md5" | head -5
}
