# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""How far points are from a CAD model, or from a fitted one."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Union

import numpy as np
from numpy.typing import NDArray

from ._cloud import Cloud, Points, as_cloud
from ._declarations import RegionType
from ._deviation import Deviation, summarise
from ._facts import deviation_facts
from ._library import LIBRARY, require_cad
from ._memory import Borrowed
from ._part import Part
from ._seen import Layers, Seen
from ._sheet import Sheet
from ._spline import Mesh
from ._targets import Path, Target, encoded
from ._work import ProgressCallback, Work

#: A CAD file, or what crease.fit() has brought.
Model = Union[str, "os.PathLike[str]", Sheet, Part]

#: Triangles stay within this share of the diagonal of a sheet.
_FINE = 1e-5


@dataclass(frozen=True)
class ComparedFace:
    """A face of the model."""
    type: str  #: plane, sphere, cylinder, cone, torus or freeform
    area: float
    points: int  #: nearest to it
    deviation: Deviation  #: of those points


class Comparison(Seen):
    """What crease.compare() brings. Arrays have one value for each point, in their order."""

    _own_targets = Target.CLOUD

    def __init__(self, cloud: Cloud, mesh: Mesh, deviations: NDArray[np.float64],
                 face: NDArray[np.int32], kinds: list[tuple[str, float]]) -> None:
        self._cloud = cloud
        #: The model as triangles.
        self.mesh = mesh
        #: Signed distance of every point from the model, positive outside.
        self.deviations = deviations
        #: Number of the nearest face, in the order of the model.
        self.face = face
        #: The faces.
        self.faces = [ComparedFace(kind, area, int((face == index).sum()),
                                   summarise(deviations[face == index]))
                      for index, (kind, area) in enumerate(kinds)]

    def __repr__(self) -> str:
        return (f"<crease.Comparison: {len(self._cloud)} points, {len(self.faces)} faces; "
                f"deviation rms {self.deviation.rms:.3g}, max {self.deviation.max:.3g}>")

    @property
    def deviation(self) -> Deviation:
        """The deviations in four numbers."""
        return summarise(self.deviations)

    @property
    def cloud(self) -> Cloud:
        """The cloud with the fields `deviation` and `face`."""
        return self._cloud.with_fields(deviation=self.deviations, face=self.face)

    def _write_own(self, work: Work, kind: Target, path: Path) -> None:
        self.cloud._write_own(work, kind, path)

    def _layers(self) -> Layers:
        return Layers("compare", cloud=self.cloud, mesh=self.mesh._handle, colour_by="deviation",
                      of_faces=[{"type": face.type.replace("freeform", "free form"),
                                 "area": face.area, "points": face.points,
                                 **deviation_facts(face.deviation)} for face in self.faces])


def _triangles(work: Work, model: Model) -> tuple[Mesh, list[tuple[str, float]]]:
    """The model as triangles, and type and area of each face."""
    if isinstance(model, Part):
        return model.mesh, [(face.region.type, face.area) for face in model.faces]
    if isinstance(model, Sheet):
        mesh = model._mesh(_FINE * float(np.linalg.norm(np.ptp(model.projected, axis=0))))
        return mesh, [("freeform", area) for area in _areas(mesh, len(model.faces))]
    require_cad(os.fsdecode(model))
    handle = work.make("cad_model", "crease_cad_model_read", encoded(model), 0.0)
    faces = (LIBRARY.crease_cad_model_face(handle, index)
             for index in range(LIBRARY.crease_cad_model_face_count(handle)))
    return (Mesh(Borrowed(LIBRARY.crease_cad_model_mesh(handle), handle)),
            [(RegionType(face.type).name.lower(), face.area) for face in faces])


def _areas(mesh: Mesh, faces: int) -> list[float]:
    """The area of the triangles of each face."""
    first, second, third = (mesh.vertices[mesh.triangles[:, corner]] for corner in range(3))
    areas = 0.5 * np.linalg.norm(np.cross(second - first, third - first), axis=1)
    return [float(area) for area in np.bincount(mesh.owners, areas, faces)]


def compare(model: Model, points: Points, *, threads: int = 0,
            progress: ProgressCallback | None = None) -> Comparison:
    """Measures the distance of every point from the nearest face of a model. Both must lie in the
    same place, and be in the same unit.

    model: a STEP, IGES or BREP file, or what crease.fit() has brought.
    points: an array of n x 3, a crease.Cloud, or the path of a file.
    threads, progress: as in crease.detect().
    """
    cloud = as_cloud(points)
    with Work(threads=threads, progress=progress) as work:
        mesh, kinds = _triangles(work, model)
        feet = mesh._project(work, cloud.points)
    return Comparison(cloud, mesh, np.ascontiguousarray(feet["distance"]),
                      mesh.owners[feet["triangle"]].astype(np.int32), kinds)
