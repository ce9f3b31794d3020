# SPDX-License-Identifier: MIT
"""The camera and the spot light of an exported scene, in glTF's axes: metres, y up, radians, W/sr.
"""
import json
import struct


def _unit(v):
    length = sum(x * x for x in v) ** 0.5
    return [x / length for x in v]


def _frame(nodes, key):
    """Position, direction (-z) and up (y) of the node that holds a camera or light."""
    for node in nodes:
        if key(node):
            m = node['matrix']
            return m[12:15], _unit([-x for x in m[8:11]]), _unit(m[4:7])
    raise ValueError('the scene has no camera or no light')


def view(path):
    with open(path, 'rb') as file:
        data = file.read()
    (size,) = struct.unpack_from('<I', data, 12)
    gltf = json.loads(data[20:20 + size])
    camera = gltf['cameras'][0]['perspective']
    light = gltf['extensions']['KHR_lights_punctual']['lights'][0]
    if light['type'] != 'spot':
        raise ValueError(f"expected a spot light, found {light['type']}")
    eye, forward, up = _frame(gltf['nodes'], lambda n: 'camera' in n)
    position, direction, _ = _frame(
        gltf['nodes'], lambda n: 'KHR_lights_punctual' in n.get('extensions', {}))
    return {
        'eye': eye, 'forward': forward, 'up': up, 'vertical_fov': camera['yfov'],
        'light': position, 'direction': direction, 'cone': light['spot']['outerConeAngle'],
        'intensity': light['intensity'], 'colour': light['color'],
    }
