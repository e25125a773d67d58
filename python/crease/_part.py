# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""Parts: a face for every smooth region, closed to a solid where the points allow."""

from __future__ import annotations

import threading
from ctypes import byref
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ._cloud import Cloud
from ._declarations import NONE, PartOptions, PartState, RegionsOptions
from ._detect import Region, Snap, regions_of, snaps_of, write_curves
from ._deviation import Deviation, summarise
from ._facts import Facts, deviation_facts, surface_facts
from ._library import LIBRARY, require_cad
from ._memory import Borrowed, Handle, borrowed, view
from ._seen import Layers, Seen
from ._spline import Curve, Mesh
from ._targets import Path, Target, encoded, target_of
from ._work import Work

#: The library builds one part at a time.
_BUILDING = threading.Lock()


@dataclass(frozen=True)
class Face:
    """A face of a part."""
    region: Region  #: on whose surface it lies
    points: int  #: of the cloud, nearest to it
    area: float
    deviation: Deviation  #: of those points


@dataclass(frozen=True)
class Edge:
    """An edge of a part."""
    curve: Curve
    faces: tuple[int, ...]  #: numbers of its two faces; one: it is free; the same twice: a seam
    smooth: bool  #: its faces join without an angle
    length: float
    angle: float  #: mean dihedral angle in degrees, through the material: 180 = flat; 0 when free

    @property
    def sharp(self) -> bool:
        """Whether it is a crease: two faces meet in it at an angle."""
        return not self.smooth and len(set(self.faces)) == 2


class Part(Seen):
    """What crease.fit() brings with the methods part and shell. Arrays have one value for each point, in their
    order; they show the library's memory, cannot be written to, and live on when this object is
    gone."""

    _own_targets = Target.CAD | Target.MESH

    def __init__(self, cloud: Cloud, handle: Handle, method: str) -> None:
        self._cloud, self._handle, self.method = cloud, handle, method
        used = Borrowed(LIBRARY.crease_part_regions(handle), handle)
        self._noise = float(LIBRARY.crease_regions_sigma(used))
        self.regions: list[Region] = regions_of(used)
        self.snapped: list[Snap] = snaps_of(used)

    def __repr__(self) -> str:
        return (f"<crease.Part: {self.state}, {len(self.faces)} faces, {len(self.creases)} "
                f"creases; deviation rms {self.deviation.rms:.3g}>")

    @property
    def state(self) -> str:
        """solid: closed and valid; shell: valid, with free edges; faces: they do not all join."""
        return PartState(LIBRARY.crease_part_state_of(self._handle)).name.lower()

    @property
    def message(self) -> str:
        """What is missing, and why; empty for a solid that lacks nothing."""
        sentence: bytes = LIBRARY.crease_part_message(self._handle)
        return sentence.decode(errors="replace")

    @property
    def solids(self) -> int:
        """Bodies side by side, each a solid of its own; 0 unless the part is solid."""
        return int(LIBRARY.crease_part_solid_count(self._handle))

    @property
    def volume(self) -> float:
        """Of all solids; 0 unless the part is solid."""
        return float(LIBRARY.crease_part_volume(self._handle))

    @property
    def noise(self) -> float:
        """Standard deviation of the points along the normal."""
        return self._noise

    @cached_property
    def faces(self) -> list[Face]:
        """The faces."""
        found = (LIBRARY.crease_part_face_at(self._handle, index)
                 for index in range(LIBRARY.crease_part_face_count(self._handle)))
        return [Face(self.regions[one.region], one.point_count, one.area,
                     Deviation(one.mean, one.rms, one.p95, one.most)) for one in found]

    @cached_property
    def edges(self) -> list[Edge]:
        """All edges."""
        count = LIBRARY.crease_part_edge_count(self._handle)
        curves = borrowed(self._handle, LIBRARY.crease_part_curves(self._handle), count)
        found = []
        for index, curve in enumerate(curves):
            one = LIBRARY.crease_part_edge_at(self._handle, index)
            faces = tuple(face for face in one.faces if face != NONE)
            found.append(Edge(Curve(curve), faces, one.smooth, one.length, one.angle))
        return found

    @property
    def creases(self) -> list[Edge]:
        """The edges in which two faces meet at an angle."""
        return [edge for edge in self.edges if edge.sharp]

    @property
    def mesh(self) -> Mesh:
        """Triangles within 1/100000 of the diagonal of the faces."""
        return Mesh(Borrowed(LIBRARY.crease_part_mesh(self._handle), self._handle))

    @property
    def deviations(self) -> NDArray[np.float64]:
        """Signed distance of every point from the part, positive outside."""
        return view(self._handle, LIBRARY.crease_part_deviations(self._handle),
                    (len(self._cloud),))

    @property
    def deviation(self) -> Deviation:
        """The deviations in four numbers."""
        return summarise(self.deviations)

    @property
    def face(self) -> NDArray[np.int32]:
        """Number of the nearest face for every point."""
        return view(self._handle, LIBRARY.crease_part_nearest_faces(self._handle),
                    (len(self._cloud),), np.int32)

    @cached_property
    def projected(self) -> NDArray[np.float64]:
        """Every point projected onto the part, n x 3."""
        places: NDArray[np.float64] = self.mesh.project(self._cloud.points)["point"]
        return places

    @cached_property
    def cloud(self) -> Cloud:
        """The cloud with the fields `deviation` and `face`."""
        return self._cloud.with_fields(deviation=self.deviations, face=self.face)

    def write_creases(self, path: Path) -> None:
        """Writes the creases: as lines to .ply .obj .csv, as the curves that they are to .step .stp
        .iges .igs .brep."""
        with Work() as work:
            write_curves(work, [edge.curve for edge in self.creases], path)

    def write_points(self, path: Path) -> None:
        """Writes the cloud projected onto the part, with the fields `deviation` and `face`."""
        target_of(path, Target.CLOUD)
        Cloud(self.projected, fields={"deviation": self.deviations, "face": self.face}).write(path)

    def _write_own(self, work: Work, kind: Target, path: Path) -> None:
        if kind is Target.MESH:
            work.call("crease_mesh_write", self.mesh._handle, encoded(path))
        else:
            work.call("crease_part_write", self._handle, encoded(path))

    def _layers(self) -> Layers:
        return Layers("fit", cloud=self.cloud, mesh=self.mesh._handle, colour_by="deviation",
                      curves=[edge.curve._handle for edge in self.creases],
                      of_faces=[_face_facts(face) for face in self.faces],
                      of_curves=[_edge_facts(edge) for edge in self.creases])


def _face_facts(face: Face) -> Facts:
    return {**surface_facts(face.region.type, face.region.parameters), "area": face.area,
            "points": face.points, **deviation_facts(face.deviation)}


def _edge_facts(edge: Edge) -> Facts:
    return {"faces": edge.faces, "length": edge.length, "angle": edge.angle}


def build_part(work: Work, cloud: Cloud, method: str, splitting: RegionsOptions,
               options: PartOptions, *, snap: bool) -> Part:
    """The part that the points lie on."""
    require_cad(f"method {method}")
    regions = work.make("regions", "crease_regions_find", cloud._handle, byref(splitting))
    if snap:
        work.call("crease_regions_snap", regions)
    network = work.make("network", "crease_network_find", regions, None)
    with _BUILDING:
        handle = work.make("part", "crease_part_build", cloud._handle, regions, network,
                           byref(options))
        return Part(cloud, handle, method)
