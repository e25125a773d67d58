# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""Sheets: one surface for the whole cloud, sharp along its creases."""

from __future__ import annotations

from ctypes import byref, c_double, c_size_t, c_void_p
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._cloud import Cloud
from ._detect import write_curves
from ._deviation import Deviation, summarise
from ._errors import Failure
from ._library import HAS_CAD, LIBRARY
from ._memory import Borrowed, Handle, addresses, borrowed, view
from ._seen import Layers, Seen
from ._spline import Curve, Mesh, Surface
from ._targets import Path, Target, encoded, target_of
from ._work import Work


@dataclass(frozen=True)
class Line:
    """A line of constant parameter along which a sheet is sharp."""
    curve: Curve
    constant: str  #: "u" or "v": which parameter is constant
    parameter: float
    angle: float  #: mean dihedral angle in degrees: 180 = flat
    standard_error: float  #: of the line's place across itself; 0 when not known


class Sheet(Seen):
    """What crease.fit() brings with the methods sheet and averaging. Arrays have one value for each
    point, in their order; they show the library's memory, cannot be written to, and live on when
    this object is gone."""

    _own_targets = Target.CAD | Target.MESH

    def __init__(self, cloud: Cloud, handle: Handle, method: str, trim: bool = False) -> None:
        self._cloud, self._handle, self._trim = cloud, handle, trim
        self.method = method

    def __repr__(self) -> str:
        across, along = self.surface.control_points.shape[:2]
        return (f"<crease.Sheet: {across} x {along} control points, {len(self.faces)} faces, "
                f"{len(self.creases)} creases; deviation rms {self.deviation.rms:.3g}>")

    def _per_point(self, address: int | None, *width: int) -> NDArray[np.float64]:
        count = LIBRARY.crease_sheet_point_count(self._handle)
        return view(self._handle, address, (count, *width))

    @property
    def surface(self) -> Surface:
        """The whole sheet."""
        return Surface(Borrowed(LIBRARY.crease_sheet_surface(self._handle), self._handle))

    @cached_property
    def faces(self) -> list[Surface]:
        """The smooth surfaces between the creases; neighbours share their border exactly."""
        array, count = c_void_p(), c_size_t()
        with Work() as work:
            work.call("crease_sheet_faces", self._handle, byref(array), byref(count))
        assert array.value is not None
        number = count.value
        owner = Handle(array.value, lambda at: LIBRARY.crease_surfaces_free(at, number))
        return [Surface(each) for each in borrowed(owner, array.value, number)]

    @cached_property
    def _trimmed(self) -> tuple[Handle, Mesh | None] | None:
        """What is left when the sheet ends where the points do, and its triangles; None when it is
        whole."""
        if not self._trim:
            return None
        with Work() as work:
            trimmed = work.make("trim", "crease_sheet_trim", self._handle)
            if LIBRARY.crease_trim_is_whole(trimmed):
                return None
            if not HAS_CAD:
                return trimmed, None
            try:
                return trimmed, Mesh(work.make("mesh", "crease_cad_trim_mesh", trimmed, 0.0))
            except Failure:
                return None

    @cached_property
    def loops(self) -> list[list[list[Curve]]] | None:
        """Of every face of the trimmed sheet its loops, the first one around it and the others
        around its holes: curves in u and v, x and y of their points, not all of which run the way
        the loop does. None when the whole sheet is written."""
        if self._trimmed is None:
            return None
        trimmed, found = self._trimmed[0], []
        for face in range(LIBRARY.crease_trim_face_count(trimmed)):
            loops = []
            for loop in range(LIBRARY.crease_trim_loop_count(trimmed, face)):
                count = c_size_t()
                halves = LIBRARY.crease_trim_loop(trimmed, face, loop, byref(count))
                loops.append([Curve(Borrowed(
                    LIBRARY.crease_trim_edge_at(trimmed, halves[i].edge).curve, trimmed))
                    for i in range(count.value)])
            found.append(loops)
        return found

    def _crease_curves(self) -> list[Curve]:
        """The creases as far as the sheet goes."""
        if self._trimmed is None:
            return [line.curve for line in self.creases]
        trimmed = self._trimmed[0]
        return [Curve(each) for each in borrowed(
            trimmed, LIBRARY.crease_trim_creases(trimmed),
            LIBRARY.crease_trim_crease_count(trimmed))]

    @cached_property
    def creases(self) -> list[Line]:
        """The lines along which the sheet is sharp."""
        found = []
        with Work() as work:
            for index in range(LIBRARY.crease_sheet_line_count(self._handle)):
                one = LIBRARY.crease_sheet_line(self._handle, index)
                curve = work.make("curve", "crease_sheet_line_curve", self._handle, index)
                found.append(Line(Curve(curve), "uv"[one.direction], one.parameter, one.angle,
                                  one.standard_error))
        return found

    @property
    def deviations(self) -> NDArray[np.float64]:
        """Signed distance of every point to the sheet."""
        return self._per_point(LIBRARY.crease_sheet_deviations(self._handle))

    @property
    def deviation(self) -> Deviation:
        """The deviations in four numbers."""
        return summarise(self.deviations)

    @property
    def projected(self) -> NDArray[np.float64]:
        """Every point projected onto the sheet, n x 3."""
        return self._per_point(LIBRARY.crease_sheet_projected(self._handle), 3)

    @property
    def variance(self) -> NDArray[np.float64] | None:
        """Bootstrap variance of every point, or None when the method needed none."""
        address = LIBRARY.crease_sheet_variance(self._handle)
        return self._per_point(address) if address else None

    @property
    def standard_errors(self) -> NDArray[np.float64] | None:
        """Standard error of the sheet at the foot of every point, along its normal, or None where it
        is not known: curved creases, nets of more than 4096 control points, averaging."""
        address = LIBRARY.crease_sheet_standard_errors(self._handle)
        return self._per_point(address) if address else None

    def _frame(self) -> tuple[Any, Any]:
        rotation, origin = (c_double * 9)(), (c_double * 3)()
        LIBRARY.crease_sheet_frame(self._handle, rotation, origin)
        return rotation, origin

    @property
    def rotation(self) -> NDArray[np.float64]:
        """M of local = M (point - origin), 3 x 3."""
        return np.array(self._frame()[0]).reshape(3, 3)

    @property
    def origin(self) -> NDArray[np.float64]:
        """The origin of that frame."""
        return np.array(self._frame()[1])

    @cached_property
    def mesh(self) -> Mesh:
        """Triangles within 1/2000 of the diagonal of the faces, as far as the points go."""
        if self._trimmed is not None and self._trimmed[1] is not None:
            return self._trimmed[1]
        return self._mesh(0.0)

    def _mesh(self, tolerance: float) -> Mesh:
        faces = self.faces
        with Work() as work:
            return Mesh(work.make("mesh", "crease_mesh_create", self._face_pointers(), len(faces),
                                  tolerance))

    def _face_pointers(self) -> Any:
        return addresses([face._handle for face in self.faces])

    @cached_property
    def cloud(self) -> Cloud:
        """The cloud with the field `deviation`, and with `standard_error` and `variance` where there
        are such."""
        return self._cloud.with_fields(**self._fields())

    def _fields(self) -> dict[str, NDArray[np.float64]]:
        fields = {"deviation": self.deviations, "standard_error": self.standard_errors,
                  "variance": self.variance}
        return {name: values for name, values in fields.items() if values is not None}

    def write_creases(self, path: Path) -> None:
        """Writes the creases: as lines to .ply .obj .csv, as the curves that they are to .step .stp
        .iges .igs .brep."""
        with Work() as work:
            write_curves(work, self._crease_curves(), path)

    def write_points(self, path: Path) -> None:
        """Writes the cloud projected onto the surface, with the field `deviation`."""
        target_of(path, Target.CLOUD)
        Cloud(self.projected, fields=self._fields()).write(path)

    def _write_own(self, work: Work, kind: Target, path: Path) -> None:
        if kind is Target.MESH:
            work.call("crease_mesh_write", self.mesh._handle, encoded(path))
        elif self._trimmed is not None:
            work.call("crease_cad_trim_write", self._trimmed[0], encoded(path))
        else:
            work.call("crease_cad_write", self._face_pointers(), len(self.faces), encoded(path))

    def _layers(self) -> Layers:
        surface = self.surface
        rows, columns = surface.control_points.shape[:2]
        layers = Layers("fit", cloud=self.cloud, surfaces=[surface._handle],
                        control_points=rows * columns,
                        curves=[curve._handle for curve in self._crease_curves()])
        if self._trimmed is not None and self._trimmed[1] is not None:
            layers.surfaces, layers.nets = [], [surface._handle]
            layers.mesh = self._trimmed[1]._handle
        return layers
