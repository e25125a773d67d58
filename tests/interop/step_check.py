#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors
"""Reads STEP files (ISO 10303-21) without a CAD kernel and checks what every reader relies on.

  step_check.py WRITER FOLDER    runs WRITER on FOLDER, then checks every file in it
  step_check.py FILE...          checks files

Checked: every reference has its target; nets are rectangular; knots grow, and their multiplicities
add up to control points + degree + 1; curves begin and end at their vertices; loops close; two
faces go along a common edge in opposite directions; a closed shell has no free edge; an edge's curve
in space and its curves in the parameter planes of its faces are the same points. The file's name tells how many faces, shared edges
and closed shells it must have: NAME.FACES-SHARED-CLOSED.step.

Files with edges on no face, NAME.EDGES-VERTICES.step, have beside them NAME.EDGES-VERTICES.txt with
places on their curves (number of the curve, part of its domain, x, y, z): the curves must go through
them within 1e-12 of their size.
"""
import glob
import os
import re
import subprocess
import sys

TOKEN = re.compile(r"\s*(?:(#\d+)|('(?:[^']|'')*')|(\.[A-Z0-9_]+\.)|([-+]?\d+\.\d*(?:E[-+]?\d+)?)"
                   r"|([-+]?\d+)|([A-Z_][A-Z0-9_]*)|([(),;=$*]))")


class Fault(Exception):
    pass


def require(condition, message, *values):
    if not condition:
        raise Fault(message % values)


class Reference(int):
    pass


class Parser:
    """Turns the text of a section into {number: [(type, arguments), ...]}."""

    def __init__(self, text):
        self.tokens, at = [], 0
        text = text.rstrip()
        while at < len(text):
            found = TOKEN.match(text, at)
            require(found, "no token at %r", text[at:at + 20])
            self.tokens.append((found.lastindex, found.group(found.lastindex)))
            at = found.end()
        self.at = 0

    def peek(self):
        return self.tokens[self.at][1]

    def take(self, expected=None):
        kind, text = self.tokens[self.at]
        require(expected is None or text == expected, "%s where %s belongs", text, expected)
        self.at += 1
        return kind, text

    def value(self):
        if self.peek() == '(':
            return self.group()
        kind, text = self.take()
        if kind == 6:
            return (text, self.group())
        return {1: lambda: Reference(text[1:]), 4: lambda: float(text), 5: lambda: int(text)}.get(kind, lambda: text)()

    def group(self):
        self.take('(')
        values = []
        while self.peek() != ')':
            values.append(self.value())
            if self.peek() == ',':
                self.take()
        self.take(')')
        return values

    def record(self):
        return self.take()[1], self.group()

    def entities(self):
        found = {}
        while self.at < len(self.tokens):
            number = int(self.take()[1][1:])
            require(number not in found, "#%d stands twice", number)
            self.take('=')
            if self.peek() == '(':
                self.take()
                found[number] = []
                while self.peek() != ')':
                    found[number].append(self.record())
                self.take(')')
            else:
                found[number] = [self.record()]
            self.take(';')
        return found


def references(value):
    if isinstance(value, Reference):
        yield value
    elif isinstance(value, (list, tuple)):
        for part in value:
            yield from references(part)


def check_knots(count, degree, times, knots, what):
    require(len(times) == len(knots), "%s: %d multiplicities for %d knots", what, len(times), len(knots))
    require(all(a < b for a, b in zip(knots, knots[1:])), "%s: knots do not grow", what)
    require(sum(times) == count + degree + 1, "%s: multiplicities add up to %d for %d control points of degree %d",
            what, sum(times), count, degree)
    require(times[0] == times[-1] == degree + 1, "%s: the ends are not clamped", what)
    require(all(t < degree for t in times[1:-1]) or degree == 1, "%s: a crease inside", what)


def unfolded(times, knots):
    return [knot for time, knot in zip(times, knots) for _ in range(time)]


def spline_at(degree, knots, points, t):
    """De Boor's algorithm."""
    span = max(i for i in range(degree, len(points)) if knots[i] <= t or i == degree)
    row = [list(p) for p in points[span - degree:span + 1]]
    for level in range(1, degree + 1):
        for i in range(degree, level - 1, -1):
            low, high = knots[span - degree + i], knots[span + 1 + i - level]
            part = (t - low) / (high - low)
            row[i] = [(1 - part) * a + part * b for a, b in zip(row[i - 1], row[i])]
    return row[degree]


class Model:
    def __init__(self, path):
        text = open(path, encoding='ascii').read()
        require(text.startswith('ISO-10303-21;') and text.rstrip().endswith('END-ISO-10303-21;'), "not a whole file")
        self.header = text[:text.index('DATA;')]
        body = text[text.index('DATA;') + 5:text.rindex('ENDSEC;')]
        self.entities = Parser(body).entities()

    def each(self, name):
        return [(n, record[1]) for n, records in self.entities.items() for record in records if record[0] == name]

    def get(self, number, *names):
        records = self.entities[number]
        require(len(records) == 1 and records[0][0] in names, "#%d is %s, not %s", number, records[0][0], names)
        return records[0][1]

    def point(self, number):
        return self.get(number, 'CARTESIAN_POINT')[1]

    def check_references(self):
        for number, records in self.entities.items():
            for target in references(records):
                require(target in self.entities, "#%d asks for #%d, which is not there", number, target)

    def check_surfaces(self):
        for number, (_, p, q, net, _, _, _, _, u_times, v_times, u, v, _) in self.each('B_SPLINE_SURFACE_WITH_KNOTS'):
            require(len({len(row) for row in net}) == 1, "#%d: rows of different lengths", number)
            check_knots(len(net), p, u_times, u, '#%d along u' % number)
            check_knots(len(net[0]), q, v_times, v, '#%d along v' % number)

    def check_curves(self):
        for number, (_, degree, points, _, _, _, times, knots, _) in self.each('B_SPLINE_CURVE_WITH_KNOTS'):
            check_knots(len(points), degree, times, knots, '#%d' % number)

    def space_curve(self, number):
        name, arguments = self.entities[number][0]
        return self.space_curve(arguments[1]) if name in ('SURFACE_CURVE', 'SEAM_CURVE') else number

    def vertex(self, number):
        return self.point(self.get(number, 'VERTEX_POINT')[1])

    def check_edges(self):
        for number, (_, first, last, curve, sense) in self.each('EDGE_CURVE'):
            points = self.get(self.space_curve(curve), 'B_SPLINE_CURVE_WITH_KNOTS')[2]
            ends = [points[0], points[-1]] if sense == '.T.' else [points[-1], points[0]]
            for vertex, end in zip((first, last), ends):
                away = max(abs(a - b) for a, b in zip(self.vertex(vertex), self.point(end)))
                require(away < 1e-7, "#%d ends %g away from its vertex", number, away)

    def curve_at(self, number, t):
        name, a = self.entities[number][0]
        if name == 'LINE':
            _, direction, length = self.get(a[2], 'VECTOR')
            return [p + t * length * d for p, d in zip(self.point(a[1]), self.get(direction, 'DIRECTION')[1])]
        _, degree, points, _, _, _, times, knots, _ = self.get(number, 'B_SPLINE_CURVE_WITH_KNOTS')
        return spline_at(degree, unfolded(times, knots), [self.point(p) for p in points], t)

    def surface_at(self, number, u, v):
        _, p, q, net, _, _, _, _, u_times, v_times, us, vs, _ = self.get(number, 'B_SPLINE_SURFACE_WITH_KNOTS')
        rows = [spline_at(q, unfolded(v_times, vs), [self.point(c) for c in row], v) for row in net]
        return spline_at(p, unfolded(u_times, us), rows, u)

    def check_curves_on_faces(self):
        for number, records in self.entities.items():
            if records[0][0] not in ('SURFACE_CURVE', 'SEAM_CURVE'):
                continue
            _, space, planes, _ = records[0][1]
            knots = self.get(space, 'B_SPLINE_CURVE_WITH_KNOTS')[7]
            for plane in planes:
                _, surface, definition = self.get(plane, 'PCURVE')
                flat = self.get(definition, 'DEFINITIONAL_REPRESENTATION')[1][0]
                for part in (0.0, 0.3, 0.8, 1.0):
                    t = knots[0] + part * (knots[-1] - knots[0])
                    there = self.surface_at(surface, *self.curve_at(flat, t))
                    away = max(abs(a - b) for a, b in zip(self.curve_at(space, t), there))
                    require(away < 1e-7, "#%d is %g away from surface #%d", number, away, surface)

    def loops(self, face):
        for bound in self.get(face, 'ADVANCED_FACE')[1]:
            _, loop, forward = self.get(bound, 'FACE_BOUND', 'FACE_OUTER_BOUND')
            if self.entities[loop][0][0] == 'VERTEX_LOOP':
                continue
            steps = []
            for oriented in self.get(loop, 'EDGE_LOOP')[1]:
                _, _, _, edge, sense = self.get(oriented, 'ORIENTED_EDGE')
                ends = self.get(edge, 'EDGE_CURVE')[1:3]
                steps.append((edge, sense == forward, ends if sense == '.T.' else ends[::-1]))
            for here, there in zip(steps, steps[1:] + steps[:1]):
                require(here[2][1] == there[2][0], "#%d: the loop is open after #%d", loop, here[0])
            yield from ((edge, along) for edge, along, _ in steps)

    def check_shells(self):
        shared = closed = 0
        for name in ('OPEN_SHELL', 'CLOSED_SHELL'):
            for number, (_, faces) in self.each(name):
                uses = {}
                for face in faces:
                    for edge, along in self.loops(face):
                        uses.setdefault(edge, []).append((along, face))
                for edge, used in uses.items():
                    require(len(used) <= 2, "#%d bounds %d faces", edge, len(used))
                    if len(used) == 2:
                        require(used[0][0] != used[1][0], "#%d: both faces go along it the same way", edge)
                        shared += 1
                    else:
                        require(name == 'OPEN_SHELL', "#%d is a free edge of a closed shell", edge)
                closed += name == 'CLOSED_SHELL'
        return shared, closed

    def check_wires(self, places):
        edges = [set_ for n, a in self.each('EDGE_BASED_WIREFRAME_MODEL') for set_ in a[1]]
        edges = [edge for set_ in edges for edge in self.get(set_, 'CONNECTED_EDGE_SET')[1]]
        curves = [self.get(edge, 'EDGE_CURVE')[3] for edge in edges]
        size = max(abs(c) for _, _, place in places for c in place)
        for number, part, place in places:
            knots = self.get(curves[number], 'B_SPLINE_CURVE_WITH_KNOTS')[7]
            there = self.curve_at(curves[number], knots[0] + part * (knots[-1] - knots[0]))
            away = max(abs(a - b) for a, b in zip(place, there))
            require(away < 1e-12 * size, "curve %d is %g away at %g", number, away, part)
        ends = {vertex for edge in edges for vertex in self.get(edge, 'EDGE_CURVE')[1:3]}
        return [len(edges), len(ends)]

    def check(self):
        require('AP242' in self.header, "the schema is not AP242")
        self.check_references()
        self.check_surfaces()
        self.check_curves()
        self.check_edges()
        self.check_curves_on_faces()
        return [len(self.each('ADVANCED_FACE')), *self.check_shells()]


def read_places(path):
    rows = [line.split() for line in open(path, encoding='ascii')]
    return [(int(r[0]), float(r[1]), [float(c) for c in r[2:]]) for r in rows]


def check_file(path):
    model = Model(path)
    found = model.check()
    told = os.path.basename(path).split('.')[1]
    if re.fullmatch(r'\d+-\d+', told):
        wires = model.check_wires(read_places(path[:-len('step')] + 'txt'))
        require(wires == [int(n) for n in told.split('-')], "edges, vertices: %s", wires)
        return '%d edges, %d vertices' % tuple(wires)
    wanted = [int(n) for n in told.split('-')] if re.fullmatch(r'\d+-\d+-\d+', told) else found
    require(found == wanted, "faces, shared edges, closed shells: %s, expected %s", found, wanted)
    return '%d faces, %d shared edges, %d closed shells' % tuple(found)


def main(arguments):
    if len(arguments) == 2 and os.path.isdir(arguments[1]):
        for old in glob.glob(os.path.join(arguments[1], '*.step')):
            os.remove(old)
        subprocess.run(arguments, check=True)
        arguments = sorted(glob.glob(os.path.join(arguments[1], '*.step')))
        if not arguments:
            sys.exit('nothing was written')
    faults = 0
    for path in arguments:
        try:
            print('%s: %s' % (os.path.basename(path), check_file(path)))
        except Fault as fault:
            print('%s: %s' % (path, fault))
            faults += 1
    sys.exit(faults > 0)


if __name__ == '__main__':
    main(sys.argv[1:])
