#!/bin/sh
# SPDX-License-Identifier: MIT
# Everything a person can get wrong gives one clear line and the documented exit status.
. "$SOURCE/tests/cli/lib.sh"

config() { # config NAME: standard input becomes a config file
    cat >"$work/$1.yaml"
}

# --- command line ---
expect 2 "expected a command" "$IRBENCH"
expect 2 "did you mean 'run'" "$IRBENCH" rnu
expect 2 "did you mean '--backend'" "$IRBENCH" list --bakend x
expect 2 "found 'vulkan'" "$IRBENCH" doctor --backend vulkan
expect 2 "expected CONFIG, found 0 arguments" "$IRBENCH" run
expect 2 "--set: expected key=value" "$IRBENCH" run x.yaml --set frames
expect 2 "--threads" "$IRBENCH" run x.yaml --threads zero
expect 2 "--out: expected DIR, found nothing" "$IRBENCH" run x.yaml --out
expect 2 "is no method, scene, metric or config" "$IRBENCH" show nonsense
expect 2 "list: expected methods" "$IRBENCH" list colours
expect 2 "max-mb: expected 1 to 1000; found '0'" "$IRBENCH" report "$work" --max-mb 0
expect 2 "format: expected text, csv, md, json or latex, found 'html'" "$IRBENCH" table "$work" --format html

# --- config ---
expect 3 "missing.yaml: cannot open" "$IRBENCH" run "$work/missing.yaml"
config broken <<'YAML'
name: broken
scene: [cornell
trials: 3
YAML
expect 3 "broken.yaml:3:" "$IRBENCH" run "$work/broken.yaml"
config unknown <<'YAML'
scene: cornell
framse: 4
trials: [rsm]
YAML
expect 3 "unknown.yaml:2:1: config: unknown key 'framse'; did you mean 'frames'" "$IRBENCH" run "$work/unknown.yaml"
config range <<'YAML'
scene: cornell
trials:
  - rsm: {samples: 0}
YAML
expect 3 "range.yaml:3:" "$IRBENCH" run "$work/range.yaml"
config method <<'YAML'
scene: cornell
trials: [rsn]
YAML
expect 3 "did you mean 'rsm'" "$IRBENCH" run "$work/method.yaml"
config variable <<'YAML'
scene: ${IRBENCH_NO_SUCH_VARIABLE}/x.glb
light: {position: [0, 1, 0], target: [0, 0, 0], intensity: 1, cone: 30}
camera: {position: [0, 1, 2], target: [0, 0, 0], fov: 40}
trials: [rsm]
YAML
expect 3 "IRBENCH_NO_SUCH_VARIABLE" "$IRBENCH" run "$work/variable.yaml"
config good <<'YAML'
name: good
scene: cornell
seed: 1
resolution: [16, 12]
frames: 1
rsm_resolution: 16
reference: {min_samples: 4, max_samples: 4}
trials: [rsm]
YAML
expect 3 "did you mean 'noise'" "$IRBENCH" run "$work/good.yaml" --set reference.nois=1
expect 2 "--only: the config has no trial 'rsm:mode=al'" "$IRBENCH" run "$work/good.yaml" --only rsm:mode=al --out "$work/only"

# --- parameters that do not go together: before anything is rendered, and in show as well ---
together() { # together TRIAL 'words': a config of a sound trial and this one
    { grep -v "^trials" "$work/good.yaml"; printf 'trials:\n  - rsm\n  - %s\n' "$1"; } >"$work/together.yaml"
    for command in "run $work/together.yaml --out $work/together" "reference $work/together.yaml" \
        "show $work/together.yaml"; do
        IRBENCH_CACHE="$work/untouched" expect 3 "together.yaml:10:5: trial '$2" "$IRBENCH" $command
    done
    checks=$((checks + 1))
    [ ! -e "$work/together" ] && [ ! -e "$work/untouched" ] || {
        echo "FAIL: $1 is refused only after something was made"
        failures=$((failures + 1))
    }
}
factors='tessellation factors: expected 1 <= f_min <= f_max'
together 'acrsm:f_min=40' "acrsm:f_min=40': $factors"
together 'acrsm: {f_min: {keys: [[0, 4], [9, 40]]}}' "acrsm:f_min=4@0+40@9': frame 9: $factors"
together 'ism: {points: [area, tessellation], f_max: 4}' "ism:points=tessellation:f_max=4': $factors"
together 'ism:points=dynamic:f_min=33' "ism:points=dynamic:f_min=33': $factors"
together 'rsm-clustering:clusters=1025:visibility=pcss' \
    "rsm-clustering:clusters=1025:visibility=pcss': visibility=pcss takes at most 1024 clusters, found 1025"
together 'rsm-clustering: {shape: polygon, visibility: clustered}' \
    "rsm-clustering:shape=polygon:visibility=clustered': visibility=clustered takes discs only"
{ grep -v '^trials' "$work/good.yaml"; echo 'trials: [rsm-clustering:clusters=4096]'; } >"$work/sort.yaml"
check "keys of 32 bits" "$IRBENCH" show "$work/sort.yaml" --set rsm_resolution=512
expect 3 "reduction=sort: expected at most 4095 clusters of an RSM of 1024 x 1024 texels, found 4096" \
    "$IRBENCH" show "$work/sort.yaml" --set rsm_resolution=1024
# what is not looked at may be anything
for trial in 'acrsm:visibility=none:f_min=40' 'ism:f_min=40' 'ism:visibility=none:points=dynamic:f_min=40'; do
    { grep -v '^trials' "$work/good.yaml"; echo "trials: ['$trial']"; } >"$work/together.yaml"
    check "$trial" "$IRBENCH" show "$work/together.yaml"
done

# --- scenes ---
expect 3 "no-such.glb" "$IRBENCH" inspect "$work/no-such.glb"
printf 'glTF\002\000\000\000\377\377\000\000' >"$work/truncated.glb"
expect 3 "truncated.glb" "$IRBENCH" inspect "$work/truncated.glb"
echo '{"asset": {"version": "2.0"}, "scenes": [{"nodes": []}], "scene": 0}' >"$work/empty.gltf"
expect 3 "empty.gltf" "$IRBENCH" inspect "$work/empty.gltf"
echo '{"asset": ' >"$work/broken.gltf"
expect 3 "broken.gltf" "$IRBENCH" inspect "$work/broken.gltf"
# a triangle whose second vertex is NaN: positions as base64 of nine little-endian floats
nan_buffer="AAAAAAAAAAAAAAAAAADAfwAAAAAAAAAAAAAAAAAAgD8AAAAA"
triangle() { # triangle BUFFER MATERIALS
    cat <<JSON
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}$2}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                "min": [0, 0, 0], "max": [1, 1, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,$1"}]$3}
JSON
}
triangle "$nan_buffer" "" "" >"$work/nan.gltf"
expect 3 "nan.gltf" "$IRBENCH" inspect "$work/nan.gltf"
good_buffer="AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
triangle "$good_buffer" ', "material": 0' ', "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}], "images": [{"uri": "no-such-texture.png"}]' >"$work/texture.gltf"
expect 3 "no-such-texture.png" "$IRBENCH" inspect "$work/texture.gltf"
triangle "$good_buffer" "" "" >"$work/triangle.gltf"
check "a good triangle loads" "$IRBENCH" inspect "$work/triangle.gltf"

# --- output ---
: >"$work/a-file"
expect 5 "a-file" "$IRBENCH" run "$work/good.yaml" --out "$work/a-file/run"
expect 3 "no-run" "$IRBENCH" table "$work/no-run"
expect 3 "no-run" "$IRBENCH" report "$work/no-run"
mkdir "$work/garbage" && head -c 5000 /dev/zero >"$work/garbage/results.sqlite"
expect 3 "results.sqlite" "$IRBENCH" table "$work/garbage"

# --- OpenGL ---
expect 4 "" env __EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent "$IRBENCH" run "$work/good.yaml" --backend egl --out "$work/no-egl"
expect 4 "" "$IRBENCH" run "$work/good.yaml" --backend null --out "$work/null"
if "$IRBENCH" doctor >/dev/null 2>&1; then
    cp -r "$SOURCE/shaders" "$work/shaders"
    echo 'this is no GLSL' >>"$work/shaders/frame/gbuffer.frag"
    line=$(wc -l <"$work/shaders/frame/gbuffer.frag")
    expect 3 "frame/gbuffer.frag:$line" "$IRBENCH" run "$work/good.yaml" --shader-dir "$work/shaders" --out "$work/shader"
    expect 3 "no-such-dir" "$IRBENCH" run "$work/good.yaml" --shader-dir "$work/no-such-dir" --out "$work/shader2"
    check "the good config runs" "$IRBENCH" run "$work/good.yaml" --out "$work/good"
    cp -r "$SOURCE/shaders" "$work/other-shaders"
    echo '// another comment' >>"$work/other-shaders/frame/rsm.frag"
    expect 2 "was rendered with another shader_hash" "$IRBENCH" run "$work/good.yaml" --shader-dir "$work/other-shaders" --out "$work/good"
    expect 2 "holds another experiment" "$IRBENCH" run "$work/good.yaml" --out "$work/good" --set seed=9
fi

# --- a run of schema 1 that is another experiment stays what it is ---
if python=$(command -v python3); then
    mkdir "$work/old"
    "$python" - "$work/old/results.sqlite" <<'PY'
import sqlite3, sys
db = sqlite3.connect(sys.argv[1])
db.executescript('CREATE TABLE meta(name TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID;'
                 'CREATE TABLE stage_time(trial INTEGER, frame INTEGER, stage TEXT, ms REAL);'
                 'PRAGMA application_id = 1769103970; PRAGMA user_version = 1;'
                 "INSERT INTO meta VALUES('config_key', 'another');")
PY
    expect 2 "holds another experiment" "$IRBENCH" run "$work/good.yaml" --out "$work/old"
    check "it is of schema 1 still" "$python" -c '
import sqlite3, sys
assert sqlite3.connect(sys.argv[1]).execute("PRAGMA user_version").fetchone() == (1,)
' "$work/old/results.sqlite"
fi
finish
