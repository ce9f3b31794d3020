#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Holds the reference to an independent renderer: Cycles, as Debian's Blender 3.4 has it.

    IRBENCH=build/irbench tests/cycles/check.py [--keep FOLDER] [--size WxH] [--samples N]
                                                [SCENE...]

or, as a test that is off by default since it takes minutes,

    apt-get install --no-install-recommends blender python3-numpy
    meson setup build -Dcycles=enabled && meson test -C build --suite optional

Each scene (cornell, doorway, hall) is exported as a .glb with its view, and rendered by Cycles and
by `irbench reference`, each with two seeds: its spot light with the falloff `cosine`, Lambert
surfaces, one diffuse bounce. Compared are

  direct    radiance W/(m2 sr) of light - diffuse - eye
  indirect  radiance W/(m2 sr) of light - diffuse - diffuse - eye: bounce 1, the target of scores

Units: the .glb has W/sr, which becomes a Blender spot of 4 pi / cos(omega_s) times as many watts,
as Cycles has a falloff of cos(theta) (cycles_render.py), so `cosine` is what can be held to it. Its
diffuse passes are irradiance / pi; times the colour they are radiance. The reference has irradiance in
W/m2; times k_d / pi it is radiance.

Indirect light must have the same sum within 1 % and may differ by at most 1.5 times what the two
renderers' noise explains, pixel by pixel and in means over blocks of 8 x 8 (compare.py). Direct
light has hardly any noise: its sum must be the same within 1 %, and no more than 0.5 % of the
values may differ by more than 1 % (of the mean at least), which those that a shadow's edge runs through
do. Pixels at silhouettes and creases are left out; how many is printed. There a rasteriser, which
places vertices in steps of 1/256 pixel, and a ray may see different surfaces.

Measured with Blender 3.4.1 and Embree 3.13 at the defaults (160x120 pixels, 1024 samples a pixel
and seed; 12 minutes on two busy cores); the noise is that of the mean of both seeds, relative to the
mean radiance:

            ratio of sums       difference / noise             noise, pixel
            direct   indirect   pixel           8 x 8          Cycles   reference
  cornell   1.0004   0.9999     2.50 / 2.51 %   0.30 / 0.32 %   2.2 %    1.2 %
  doorway   1.0000   0.9985     25.3 / 25.6 %   3.77 / 3.58 %   25  %    5.2 %
  hall      1.0006   0.9990     4.71 / 4.68 %   0.76 / 0.67 %   3.9 %    2.6 %

Exit status: 0 all agree, 1 some do not, 77 no Blender, 2 anything else.
"""
import argparse
import glob
import math
import os
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import compare  # noqa: E402
import exr  # noqa: E402
import glb  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
SEEDS = (1, 2)
SUM_TOLERANCE = 0.01
NOISE_FACTOR = 1.5
DIRECT_TOLERANCE = 0.01
DIRECT_SHARE = 0.005
LAYER = 'ViewLayer'

CONFIG = """name: cycles-{name}
seed: 1
resolution: [{width}, {height}]
frames: 1
settle: 0
reference: {{min_samples: {samples}, max_samples: {samples}, noise: 0, bounces: 1}}
scenes:
  - scene: {name}
    camera:
      keys:
        - {{frame: 0, position: {eye}, target: {target}, up: {up}, fov: {fov}}}
    light:
      type: spot
      falloff: cosine
      keys:
        - {{frame: 0, position: {light}, target: {lit}, intensity: {intensity}, cone: {cone}}}
trials:
  - rsm: {{}}
"""


def vector(values):
    return '[' + ', '.join(f'{v:.9g}' for v in values) + ']'


def add(a, b):
    return [x + y for x, y in zip(a, b)]


def write_config(path, name, view, options):
    with open(path, 'w', encoding='utf-8') as file:
        file.write(CONFIG.format(
            name=name, width=options.width, height=options.height, samples=options.samples,
            eye=vector(view['eye']), target=vector(add(view['eye'], view['forward'])),
            up=vector(view['up']), fov=math.degrees(view['vertical_fov']),
            light=vector(view['light']), lit=vector(add(view['light'], view['direction'])),
            intensity=vector([view['intensity'] * c for c in view['colour']]),
            cone=math.degrees(view['cone'])))


def run(command, log, **settings):
    with open(log, 'ab') as file:
        status = subprocess.run(command, stdout=file, stderr=file, check=False, **settings)
    if status.returncode:
        with open(log, encoding='utf-8', errors='replace') as file:
            sys.stderr.write(file.read())
        raise SystemExit(2)


def rgb(channels, layer):
    return [channels[f'{layer}.{c}'] for c in 'RGB']


def times(a, b, scale=1.0):
    return [[scale * x * y for x, y in zip(p, q)] for p, q in zip(a, b)]


def render_cycles(folder, scene, options):
    """Direct and indirect radiance for each seed."""
    images = []
    # Blender takes the modules of the first python3 in PATH; those it was built for come first.
    environment = dict(os.environ, PATH='/usr/bin:/bin:' + os.environ.get('PATH', ''))
    for seed in SEEDS:
        path = f'{folder}/cycles-{seed}.exr'
        run([options.blender, '-b', '--factory-startup', '--python-exit-code', '1', '--python',
             f'{HERE}/cycles_render.py', '--', scene, path, str(options.width),
             str(options.height), str(options.samples), str(seed)],
            f'{folder}/cycles.log', env=environment)
        channels = exr.read(path)[2]
        colour = rgb(channels, f'{LAYER}.DiffCol')
        images.append([times(rgb(channels, f'{LAYER}.{p}'), colour)
                       for p in ('DiffDir', 'DiffInd')])
    return images


def render_reference(folder, config, options):
    """Likewise, and the G-buffer."""
    images = []
    for seed in SEEDS:
        cache = f'{folder}/cache-{seed}'
        shutil.rmtree(cache, ignore_errors=True)  # of an earlier check with --keep
        run([options.irbench, 'reference', config, '--set', f'reference.seed={seed}'],
            f'{folder}/irbench.log', env=dict(os.environ, IRBENCH_CACHE=cache))
        (path,) = glob.glob(f'{cache}/reference-*.exr')
        (gbuffer_path,) = glob.glob(f'{cache}/gbuffer-*.exr')
        channels, gbuffer = exr.read(path)[2], exr.read(gbuffer_path)[2]
        albedo = rgb(gbuffer, 'diffuse')
        images.append([rgb(channels, 'direct'),
                       times(rgb(channels, 'bounce1'), albedo, 1 / math.pi)])
    return images, gbuffer


def describe(what, result):
    print(f'  {what:17} ratio of sums {result.ratio:.5f}, difference {100 * result.difference:.3f} %'
          f', noise {100 * result.noise[0]:.3f} % Cycles, {100 * result.noise[1]:.3f} % reference'
          f': {result.factor:.3f} times the noise')


def check_direct(a, b):
    """a, b: radiance of the first seed."""
    mean = sum(b) / len(b)
    differ = sum(abs(x - y) > DIRECT_TOLERANCE * max(y, mean) for x, y in zip(a, b)) / len(b)
    ratio = sum(a) / sum(b)
    print(f'  {"direct":17} ratio of sums {ratio:.5f}, {100 * differ:.3f} % of the values differ by '
          f'more than {100 * DIRECT_TOLERANCE:g} %')
    return abs(ratio - 1) <= SUM_TOLERANCE and differ <= DIRECT_SHARE


def check_scene(name, folder, options):
    os.makedirs(folder, exist_ok=True)
    scene, config = f'{folder}/{name}.glb', f'{folder}/{name}.yaml'
    run([options.irbench, 'export-scene', name, scene], f'{folder}/irbench.log')
    write_config(config, name, glb.view(scene), options)
    cycles = render_cycles(folder, scene, options)
    ours, gbuffer = render_reference(folder, config, options)
    size = options.width, options.height
    mask = compare.interior([gbuffer[f'position.{c}'] for c in 'XYZA'],
                            [gbuffer[f'normal.{c}'] for c in 'XYZD'], *size)
    covered = sum(c > 0 for c in gbuffer['position.A'])
    print(f'{name}: {sum(mask)} pixels compared, {covered - sum(mask)} of {covered} at edges left out')
    good = check_direct(compare.pixels(cycles[0][0], mask), compare.pixels(ours[0][0], mask))
    a, b = [i[1] for i in cycles], [i[1] for i in ours]
    for what, values in (
            ('indirect', lambda i: compare.pixels(i, mask)),
            (f'indirect, {compare.BLOCK}x{compare.BLOCK}', lambda i: compare.blocks(i, mask, *size))):
        result = compare.compare([values(i) for i in a], [values(i) for i in b])
        describe(what, result)
        good &= abs(result.ratio - 1) <= SUM_TOLERANCE and result.factor <= NOISE_FACTOR
    print(f'  {"agree" if good else "DO NOT AGREE"}', flush=True)
    return good


def read_options():
    parser = argparse.ArgumentParser(description='Compares the reference with Cycles.')
    parser.add_argument('scenes', nargs='*', default=['cornell', 'doorway', 'hall'])
    parser.add_argument('--keep', metavar='FOLDER', help='for scenes, images and logs')
    parser.add_argument('--size', default='160x120', metavar='WxH')
    parser.add_argument('--samples', type=int, default=1024, help='a pixel and seed')
    options = parser.parse_args()
    options.width, options.height = (int(v) for v in options.size.split('x'))
    options.irbench = os.environ.get('IRBENCH', 'build/irbench')
    options.blender = shutil.which(os.environ.get('BLENDER', 'blender'))
    return options


def main():
    options = read_options()
    if not options.blender:
        print('skipped: Blender is not installed (apt-get install --no-install-recommends blender '
              'python3-numpy)')
        return 77
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or temporary
        good = [check_scene(name, f'{folder}/{name}', options) for name in options.scenes]
    return 0 if all(good) else 1


if __name__ == '__main__':
    sys.exit(main())
