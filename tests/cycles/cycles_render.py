# SPDX-License-Identifier: MIT
"""Renders an exported scene with Cycles: its spot light, pure Lambert surfaces, direct light and one
diffuse bounce apart.

    blender -b --factory-startup --python-exit-code 1 --python cycles_render.py -- \\
        IN.glb OUT.exr WIDTH HEIGHT SAMPLES SEED

OUT.exr has the passes DiffDir and DiffInd, which Blender divides by the surface's colour (so they
are irradiance / pi, W/(m2 sr)), and DiffCol, that colour. Written for Blender 3.4.

The spot of Cycles 3.4 sends out P/(4 pi) cos(theta) W/sr at the angle theta from its axis, whatever
its cone and blend. That is the falloff `cosine`, I cos(theta)/cos(omega_s), with P = 4 pi I /
cos(omega_s); no setting gives the other falloffs.
"""
import math
import os
import sys

import bpy
import numpy

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import glb  # noqa: E402

TOLERANCE = 1e-5  # relative, of what the importer made of camera and light


def import_scene(path):
    # The importer of Blender 3.4 uses a name that NumPy 1.24 no longer has.
    if 'bool' not in numpy.__dict__:
        numpy.bool = bool
    bpy.ops.wm.read_factory_settings(use_empty=True)
    # COMPAT takes W/sr as W/sr; the default takes lumens and divides by 683.
    bpy.ops.import_scene.gltf(filepath=path, convert_lighting_mode='COMPAT')


def only(kind):
    found = [o for o in bpy.data.objects if o.type == kind]
    if len(found) != 1:
        raise SystemExit(f'expected one {kind.lower()}, found {len(found)}')
    return found[0]


def require(what, found, expected):
    """Numbers or triples of them."""
    found, expected = numpy.atleast_1d(found), numpy.atleast_1d(expected)
    error = numpy.abs(found - expected).max()
    if not error <= TOLERANCE * max(1, numpy.abs(expected).max()):
        raise SystemExit(f'{what}: expected {expected}, found {found}')


def to_blender(v):
    """glTF has y up, Blender z."""
    return (v[0], -v[2], v[1])


def set_camera(view):
    camera = only('CAMERA')
    matrix = camera.matrix_world
    require('camera position', matrix.translation, to_blender(view['eye']))
    require('camera direction', -matrix.col[2].xyz, to_blender(view['forward']))
    require('camera up', matrix.col[1].xyz, to_blender(view['up']))
    require('vertical field of view', camera.data.angle_y, view['vertical_fov'])
    require('camera shift', (camera.data.shift_x, camera.data.shift_y), (0, 0))
    camera.data.sensor_fit = 'VERTICAL'
    camera.data.dof.use_dof = False
    bpy.context.scene.camera = camera


def set_light(view):
    light = only('LIGHT')
    matrix = light.matrix_world
    require('light position', matrix.translation, to_blender(view['light']))
    require('light direction', -matrix.col[2].xyz, to_blender(view['direction']))
    require('light colour', light.data.color, view['colour'])
    require('cone', light.data.spot_size, 2 * view['cone'])
    # What the importer makes of W/sr is right for the axis.
    require('power', light.data.energy, 4 * math.pi * view['intensity'])
    light.data.energy /= math.cos(view['cone'])
    light.data.spot_blend = 0  # a hard edge
    light.data.shadow_soft_size = 0  # a point
    light.data.cycles.use_multiple_importance_sampling = True


def base_colour(material):
    """Colour and texture node of the importer's surface shader."""
    for node in material.node_tree.nodes:
        if node.type == 'BSDF_PRINCIPLED':
            socket = node.inputs['Base Color']
            textures = [n for n in material.node_tree.nodes if n.type == 'TEX_IMAGE']
            if socket.is_linked and len(textures) != 1:
                raise SystemExit(f'material {material.name}: expected one texture')
            return list(socket.default_value), textures[0] if socket.is_linked else None
    raise SystemExit(f'material {material.name}: expected a Principled BSDF')


def make_lambert(material):
    colour, texture = base_colour(material)
    tree = material.node_tree
    for node in list(tree.nodes):
        if node != texture:
            tree.nodes.remove(node)
    diffuse = tree.nodes.new('ShaderNodeBsdfDiffuse')  # roughness 0: Lambert
    output = tree.nodes.new('ShaderNodeOutputMaterial')
    diffuse.inputs['Roughness'].default_value = 0
    diffuse.inputs['Color'].default_value = colour
    if texture:
        texture.interpolation = 'Linear'
        tree.links.new(texture.outputs['Color'], diffuse.inputs['Color'])
    tree.links.new(diffuse.outputs['BSDF'], output.inputs['Surface'])
    material.use_backface_culling = False


def set_surfaces():
    for material in bpy.data.materials:
        if material.node_tree and material.users:
            make_lambert(material)
    for item in bpy.data.objects:
        if item.type == 'MESH':  # shadow rays start at the surface itself, for any normals
            item.cycles.shadow_terminator_offset = 0
            item.cycles.shadow_terminator_geometry_offset = 0


def set_integrator(scene, samples, seed):
    scene.render.engine = 'CYCLES'
    cycles = scene.cycles
    cycles.device = 'CPU'
    cycles.samples = samples
    cycles.seed = seed
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    # light - diffuse - eye and light - diffuse - diffuse - eye, nothing else
    cycles.max_bounces = cycles.diffuse_bounces = 1
    cycles.glossy_bounces = cycles.transmission_bounces = cycles.volume_bounces = 0
    cycles.transparent_max_bounces = 0
    cycles.use_fast_gi = False
    # no clamp, no cut-off: unbiased
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.light_sampling_threshold = 0
    cycles.film_exposure = 1
    # pixel centres, as far as the least width goes; BOX would be a pixel wide whatever the width
    cycles.pixel_filter_type = 'GAUSSIAN'
    cycles.filter_width = 0.01
    scene.world = None


def set_output(scene, path, width, height):
    render = scene.render
    render.resolution_x, render.resolution_y = width, height
    render.resolution_percentage = 100
    render.pixel_aspect_x = render.pixel_aspect_y = 1
    render.use_motion_blur = render.use_simplify = render.use_border = False
    render.dither_intensity = 0
    render.filepath = path
    render.image_settings.file_format = 'OPEN_EXR_MULTILAYER'
    render.image_settings.color_depth = '32'
    render.image_settings.exr_codec = 'ZIP'
    scene.view_settings.view_transform = 'Raw'
    scene.view_settings.look = 'None'
    scene.view_settings.exposure = 0
    scene.view_settings.gamma = 1
    layer = scene.view_layers[0]
    layer.use_pass_diffuse_direct = True
    layer.use_pass_diffuse_indirect = True
    layer.use_pass_diffuse_color = True


def main():
    source, path, width, height, samples, seed = sys.argv[sys.argv.index('--') + 1:]
    import_scene(source)
    scene = bpy.context.scene
    view = glb.view(source)
    bpy.context.view_layer.update()
    set_camera(view)
    set_light(view)
    set_surfaces()
    set_integrator(scene, int(samples), int(seed))
    set_output(scene, path, int(width), int(height))
    bpy.ops.render.render(write_still=True)


main()
