#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors
"""Opens fitted parts in gmsh, as a user's CAD or mesh program would.

  gmsh_check.py PROGRAM FOLDER    PROGRAM: crease; FOLDER: for its files. 77 without gmsh: skipped

A cube and a stepped shaft, as clouds, are fitted. gmsh must find in the STEP file what `crease info`
and the report say: one volume, as many faces, edges and vertices, the same volume; and a surface
mesh made there must be closed: two triangles at each of its edges.
"""
import collections
import json
import math
import os
import random
import re
import subprocess
import sys

try:
    import gmsh
except ImportError:
    print("no gmsh for this Python: skipped")
    sys.exit(77)

SPACING = 0.04


def cells(width, height):
    """A random place in each cell of a grid over a rectangle."""
    columns, rows = max(1, round(width / SPACING)), max(1, round(height / SPACING))
    for i in range(columns):
        for j in range(rows):
            yield ((i + random.random()) * width / columns, (j + random.random()) * height / rows)


def cube():
    for axis in range(3):
        for side in (0.0, 1.0):
            for u, v in cells(1, 1):
                point = [u, v]
                point.insert(axis, side)
                yield point


def wall(radius, low, high):
    for s, z in cells(2 * math.pi * radius, high - low):
        yield [radius * math.cos(s / radius), radius * math.sin(s / radius), low + z]


def ring(inner, outer, z):
    """Equal areas: the square of the radius is even."""
    width = math.sqrt(math.pi * (outer**2 - inner**2))
    for u, v in cells(width, width):
        radius = math.sqrt(inner**2 + (outer**2 - inner**2) * u / width)
        yield [radius * math.cos(2 * math.pi * v / width),
               radius * math.sin(2 * math.pi * v / width), z]


def shaft():
    for part in (ring(0, 0.6, 0), wall(0.6, 0, 0.8), ring(0.35, 0.6, 0.8), wall(0.35, 0.8, 1.7),
                 ring(0, 0.35, 1.7)):
        yield from part


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def fit(program, folder, name, points):
    """The STEP file, its volume by the report, and how many faces, edges and vertices it has."""
    cloud, step, report = (os.path.join(folder, name + end) for end in (".xyz", ".step", ".json"))
    with open(cloud, "w", encoding="ascii") as file:
        file.writelines("%.9g %.9g %.9g\n" % tuple(point) for point in points)
    run(program, "fit", cloud, "--method", "part", "-o", step, "--report", report)
    with open(report, encoding="utf-8") as file:
        part = json.load(file)["part"]
    assert part["state"] == "solid", part
    found = re.search(r"(\d+) faces, (\d+) edges, (\d+) vertices", run(program, "info", step))
    return step, part["volume"], [int(count) for count in found.groups()]


def open_edges():
    """Edges of the triangles of the mesh that do not have exactly two."""
    counts = collections.Counter()
    for kind, _, nodes in zip(*gmsh.model.mesh.getElements(2)):
        assert kind == 2, "not a triangle"
        for i in range(0, len(nodes), 3):
            for a, b in ((0, 1), (1, 2), (2, 0)):
                counts[frozenset((int(nodes[i + a]), int(nodes[i + b])))] += 1
    assert counts, "no mesh"
    return sum(count != 2 for count in counts.values())


def check(step, volume, counts):
    gmsh.clear()
    gmsh.model.occ.importShapes(step)
    gmsh.model.occ.synchronize()
    there = [len(gmsh.model.getEntities(dimension)) for dimension in (3, 2, 1, 0)]
    assert there == [1] + counts, (there, counts)
    found = gmsh.model.occ.getMass(3, gmsh.model.getEntities(3)[0][1])
    assert abs(found / volume - 1) < 1e-6, (found, volume)
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.2)
    gmsh.model.mesh.generate(2)
    assert open_edges() == 0, open_edges()


def main():
    program, folder = sys.argv[1:]
    os.makedirs(folder, exist_ok=True)
    random.seed(4)
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    for name, points, faces in (("cube", cube(), 6), ("shaft", shaft(), 5)):
        step, volume, counts = fit(program, folder, name, points)
        assert counts[0] == faces, counts
        check(step, volume, counts)
        print("%s: %d faces, %d edges, %d vertices, volume %.6g, in gmsh as here; its mesh closes"
              % (name, *counts, volume))
    gmsh.finalize()


main()
