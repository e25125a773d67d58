#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors
"""Opens fitted parts in gmsh, as a user's CAD or mesh program would.

  gmsh_check.py PROGRAM FOLDER    PROGRAM: crease; FOLDER: for its files. 77 without gmsh: skipped

A cube and a stepped shaft, as clouds, are fitted. gmsh must find in the STEP file what `crease info`
and the report say: one volume, as many faces, edges and vertices, the same volume; and a surface
mesh made there must be closed: two triangles at each of its edges. A roof with a round hole over its
ridge, as a trimmed sheet, must be there with its area, and its mesh must end at its border alone.
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
HOLE = 0.25


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


def roof():
    """A square with its ridge in the middle, and a hole there."""
    for u, v in cells(1, 1):
        if math.hypot(u - 0.5, v - 0.5) > HOLE:
            yield [u, v, -abs(u - 0.5)]


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def counts_in(program, step):
    """Faces, edges and vertices."""
    found = re.search(r"faces: (\d+), edges: (\d+), vertices: (\d+)", run(program, "info", step))
    return [int(count) for count in found.groups()]


def fit(program, folder, name, points, method):
    """The STEP file, the report, and how many faces, edges and vertices there are."""
    cloud, step, report = (os.path.join(folder, name + end) for end in (".xyz", ".step", ".json"))
    with open(cloud, "w", encoding="ascii") as file:
        file.writelines("%.9g %.9g %.9g\n" % tuple(point) for point in points)
    run(program, "fit", cloud, "--method", method, "-o", step, "--report", report)
    with open(report, encoding="utf-8") as file:
        return step, json.load(file), counts_in(program, step)


def triangles_at_edges():
    """How many triangles each edge of the mesh has."""
    counts = collections.Counter()
    for kind, _, nodes in zip(*gmsh.model.mesh.getElements(2)):
        assert kind == 2, "not a triangle"
        for i in range(0, len(nodes), 3):
            for a, b in ((0, 1), (1, 2), (2, 0)):
                counts[frozenset((int(nodes[i + a]), int(nodes[i + b])))] += 1
    assert counts, "no mesh"
    return counts


def read(step, volumes, counts):
    gmsh.clear()
    gmsh.model.occ.importShapes(step)
    gmsh.model.occ.synchronize()
    there = [len(gmsh.model.getEntities(dimension)) for dimension in (3, 2, 1, 0)]
    assert there == [volumes] + counts, (there, counts)


def check(step, volume, counts):
    read(step, 1, counts)
    found = gmsh.model.occ.getMass(3, gmsh.model.getEntities(3)[0][1])
    assert abs(found / volume - 1) < 1e-6, (found, volume)
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.2)
    gmsh.model.mesh.generate(2)
    assert set(triangles_at_edges().values()) == {2}


def check_sheet(step, counts):
    read(step, 0, counts)
    area = sum(gmsh.model.occ.getMass(2, face) for _, face in gmsh.model.getEntities(2))
    expected = math.sqrt(2) * (1 - math.pi * HOLE**2)
    assert abs(area / expected - 1) < 0.03, (area, expected)
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.02)
    gmsh.model.mesh.generate(2)
    tags, places, _ = gmsh.model.mesh.getNodes()
    place = {int(tag): places[3 * i:3 * i + 3] for i, tag in enumerate(tags)}
    for edge, triangles in triangles_at_edges().items():
        u, v, _ = (sum(place[node][c] for node in edge) / 2 for c in range(3))
        border = min(u, 1 - u, v, 1 - v, math.hypot(u - 0.5, v - 0.5) - HOLE)
        assert triangles == 2 or triangles == 1 and border < SPACING, (u, v, triangles)


def main():
    program, folder = sys.argv[1:]
    os.makedirs(folder, exist_ok=True)
    random.seed(4)
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    for name, points, faces in (("cube", cube(), 6), ("shaft", shaft(), 5)):
        step, report, counts = fit(program, folder, name, points, "part")
        volume = report["part"]["volume"]
        assert counts[0] == faces and report["part"]["state"] == "solid", report
        check(step, volume, counts)
        print("%s: %d faces, %d edges, %d vertices, volume %.6g, in gmsh as here; its mesh closes"
              % (name, *counts, volume))
    step, report, counts = fit(program, folder, "roof", roof(), "sheet")
    assert counts[0] == 2 and len(report["trim"]["faces"]) == 2, counts
    check_sheet(step, counts)
    print("roof: a trimmed sheet of %d faces, %d edges, %d vertices; its mesh ends at its border"
          % tuple(counts))
    gmsh.finalize()


main()
