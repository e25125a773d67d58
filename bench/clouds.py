# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors
"""Clouds of known shapes for the benchmark scripts, and PLY files. Needs numpy and scipy.

A shape is faces, each (area, function of random numbers in the unit square), and edges: points."""
import sys

import numpy as np
from scipy.spatial import cKDTree

PLY_TYPES = {'char': 'i1', 'uchar': 'u1', 'short': '<i2', 'ushort': '<u2', 'int': '<i4', 'uint': '<u4',
             'float': '<f4', 'double': '<f8', 'int8': 'i1', 'uint8': 'u1', 'int16': '<i2', 'uint16': '<u2',
             'int32': '<i4', 'uint32': '<u4', 'float32': '<f4', 'float64': '<f8'}


def plane(origin, along, across):
    o, a, b = (np.array(v, float) for v in (origin, along, across))
    return np.linalg.norm(np.cross(a, b)), lambda uv: o + uv[:, :1] * a + uv[:, 1:] * b


def segment(a, b):
    t = np.linspace(0, 1, 2001)[:, None]
    return np.array(a, float) + t * (np.array(b, float) - np.array(a, float))


def circle(radius, height):
    t = np.linspace(0, 2 * np.pi, 8001)
    return np.stack([radius * np.cos(t), radius * np.sin(t), np.full_like(t, height)], 1)


def wedge(turn):
    half = np.radians(turn / 2)
    faces = [plane((0, 0, 0), (side * np.cos(half), 0, -np.sin(half)), (0, 1, 0)) for side in (-1, 1)]
    return faces, [segment((0, 0, 0), (0, 1, 0))]


def extruded(outline, height):
    """A prism over a polygon that every ray from the origin meets once."""
    faces, edges = [], []
    for p, q in zip(outline, np.roll(outline, -1, axis=0)):
        faces.append(plane((*p, 0), (*(q - p), 0), (0, 0, height)))
        edges.append(segment((*p, 0), (*p, height)))
        for z in (0, height):
            edges.append(segment((*p, z), (*q, z)))
            triangle = np.array([(0, 0, z), (*p, z), (*q, z)], float)
            fold = lambda uv, t=triangle: t[0] + np.where(uv.sum(1, keepdims=True) > 1, 1 - uv, uv) @ (t[1:] - t[0])
            faces.append((abs(p[0] * q[1] - p[1] * q[0]) / 2, fold))
    return faces, edges


def cube():
    return extruded(np.array([(-.5, -.5), (.5, -.5), (.5, .5), (-.5, .5)]), 1.0)


def bracket():
    return extruded(np.array([(-.4, -.4), (1.2, -.4), (1.2, .4), (.4, .4), (.4, 1.2), (-.4, 1.2)]), 0.8)


def gear(teeth=12):
    outline = [(r * np.cos(a), r * np.sin(a)) for i in range(teeth)
               for r, part in ((0.8, 0.0), (1.0, 0.2), (1.0, 0.5), (0.8, 0.7))
               for a in [2 * np.pi * (i + part) / teeth]]
    return extruded(np.array(outline), 0.5)


def cylinder(radius=0.5, height=1.2):
    around = lambda uv: np.stack([radius * np.cos(2 * np.pi * uv[:, 0]), radius * np.sin(2 * np.pi * uv[:, 0]), height * uv[:, 1]], 1)
    faces = [(2 * np.pi * radius * height, around)]
    for z in (0, height):
        faces.append((np.pi * radius ** 2, lambda uv, z=z: np.stack(
            [radius * np.sqrt(uv[:, 1]) * np.cos(2 * np.pi * uv[:, 0]), radius * np.sqrt(uv[:, 1]) * np.sin(2 * np.pi * uv[:, 0]), np.full(len(uv), z)], 1)))
    return faces, [circle(radius, 0), circle(radius, height)]


SHAPES = {'wedge 30': lambda: wedge(30), 'wedge 90': lambda: wedge(90), 'cube': cube, 'bracket': bracket, 'cylinder': cylinder, 'gear': gear}


def random_points(faces, count, random):
    areas = np.array([area for area, _ in faces])
    shares = random.multinomial(count, areas / areas.sum())
    return random.permutation(np.concatenate([place(random.random((n, 2))) for n, (_, place) in zip(shares, faces) if n]))


def even_points(faces, count, random):
    """About count points with no two nearer than 0.7 spacings, which is the root of the area that each
    of count points has: random ones, thinned in their order."""
    points = random_points(faces, 8 * count, random)
    pairs = cKDTree(points).query_pairs(0.7 * np.sqrt(area_of(faces) / count), output_type='ndarray')
    pairs = np.sort(pairs, axis=1)
    pairs = pairs[np.lexsort((pairs[:, 0], pairs[:, 1]))]
    kept = np.ones(len(points), bool)
    starts = np.searchsorted(pairs[:, 1], np.arange(len(points) + 1))
    for i in range(len(points)):
        kept[i] = not kept[pairs[starts[i]:starts[i + 1], 0]].any()
    return random.permutation(points[kept])[:count]


def area_of(faces):
    return sum(area for area, _ in faces)


def roof(count):
    """Random points over a unit square of a roof whose ridge is turned by 20 degrees."""
    turn = np.radians(20)
    x, y = np.random.default_rng(1).random((2, count)) - 0.5
    return np.stack([x, y, -np.abs(np.cos(turn) * x + np.sin(turn) * y)], 1)


# -------------------------------------------------------------------------------------- PLY files

def read_vertices(path):
    data = open(path, 'rb').read()
    end = data.index(b'\n', data.index(b'end_header')) + 1
    lines = [line.split() for line in data[:end].decode('latin-1').split('\n')]
    if ['format', 'binary_little_endian', '1.0'] not in lines:
        sys.exit('%s: only binary little-endian PLY is read here' % path)
    first = next(i for i, w in enumerate(lines) if w[:2] == ['element', 'vertex'])
    fields = []
    for w in lines[first + 1:]:
        if w[:1] != ['property']:
            break
        fields.append((w[2], PLY_TYPES[w[1]]))
    return np.frombuffer(data, np.dtype(fields), int(lines[first][2]), end)


def coordinates(path):
    v = read_vertices(path)
    return np.stack([v['x'], v['y'], v['z']], 1).astype(float)


def write_cloud(path, points):
    head = 'ply\nformat binary_little_endian 1.0\nelement vertex %d\n' % len(points)
    head += ''.join('property double %s\n' % c for c in 'xyz') + 'end_header\n'
    with open(path, 'wb') as file:
        file.write(head.encode() + points.astype('<f8').tobytes())
