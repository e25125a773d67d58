# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""Curves, surfaces and meshes."""

from __future__ import annotations

from ctypes import POINTER, c_double, c_int, cast
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._cloud import _vectors
from ._declarations import Foot, MeshFoot, Side
from ._errors import UsageError
from ._library import LIBRARY
from ._memory import Held, view
from ._targets import Path, Target, encoded, target_of
from ._work import Work


def _domain(function: Any, *arguments: Any) -> tuple[float, float]:
    domain = (c_double * 2)()
    function(*arguments, domain)
    return domain[0], domain[1]


def _order(derivative: int, most: int = 15) -> int:
    if not 0 <= derivative <= most:
        raise UsageError(f"derivative: a whole number from 0 to {most}, not {derivative}")
    return derivative


class Curve:
    """A B-spline curve in space."""

    def __init__(self, handle: Held) -> None:
        self._handle = handle

    def __repr__(self) -> str:
        return f"<crease.Curve: order {self.order}, {len(self.control_points)} control points>"

    @property
    def order(self) -> int:
        """Degree + 1."""
        return int(LIBRARY.crease_curve_order(self._handle))

    @property
    def control_points(self) -> NDArray[np.float64]:
        """n x 3."""
        return view(self._handle, LIBRARY.crease_curve_control_points(self._handle),
                    (LIBRARY.crease_curve_count(self._handle), 3))

    @property
    def knots(self) -> NDArray[np.float64]:
        """n + order of them."""
        return view(self._handle, LIBRARY.crease_curve_knots(self._handle),
                    (LIBRARY.crease_curve_count(self._handle) + self.order,))

    @property
    def domain(self) -> tuple[float, float]:
        """First and last parameter."""
        return _domain(LIBRARY.crease_curve_domain, self._handle)

    def __call__(self, t: ArrayLike, derivative: int = 0) -> NDArray[np.float64]:
        """Points of the curve, or derivatives (from the right, where they jump), at parameters t:
        the shape of t and 3."""
        parameters = np.asarray(t, dtype=np.float64)
        highest = _order(derivative)
        scratch = np.empty((highest + 1, 3))
        places = np.empty((parameters.size, 3))
        for place, parameter in zip(places, parameters.ravel()):
            LIBRARY.crease_curve_evaluate(self._handle, parameter, Side.RIGHT, highest,
                                          scratch.ctypes.data)
            place[:] = scratch[highest]
        return places.reshape(*parameters.shape, 3)

    def sample(self, count: int = 100) -> NDArray[np.float64]:
        """Points at parameters evenly spread over the domain, count x 3."""
        return self(np.linspace(*self.domain, count))


def _feet(work: Work, function: str, handle: Held, points: ArrayLike, foot: Any) -> NDArray[Any]:
    """Where points fall on an object, as a structured array."""
    places = _vectors("points", points)
    feet = np.empty(len(places), dtype=np.dtype(foot))
    work.call(function, handle, places.ctypes.data, len(places),
              cast(feet.ctypes.data, POINTER(foot)))
    return feet


class Surface:
    """A tensor-product B-spline surface."""

    def __init__(self, handle: Held) -> None:
        self._handle = handle
        self._parts = LIBRARY.crease_surface_parts_of(handle)

    def __repr__(self) -> str:
        return (f"<crease.Surface: order {self.order[0]} x {self.order[1]}, "
                f"{self._parts.count[0]} x {self._parts.count[1]} control points>")

    @property
    def order(self) -> tuple[int, int]:
        """Degree + 1 along u and v."""
        return self._parts.order[0], self._parts.order[1]

    @property
    def control_points(self) -> NDArray[np.float64]:
        """Along u x along v x 3."""
        return view(self._handle, self._parts.control_points, (*self._parts.count, 3))

    @property
    def knots(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Those of u and those of v."""
        u, v = (view(self._handle, self._parts.knots[i],
                     (self._parts.count[i] + self._parts.order[i],)) for i in range(2))
        return u, v

    @property
    def domain(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """First and last parameter along u and along v."""
        return (_domain(LIBRARY.crease_surface_domain, self._handle, 0),
                _domain(LIBRARY.crease_surface_domain, self._handle, 1))

    def __call__(self, u: ArrayLike, v: ArrayLike,
                 derivative: tuple[int, int] = (0, 0)) -> NDArray[np.float64]:
        """Points of the surface, or partial derivatives (from the right, where they jump): the
        shape that u and v have together, and 3."""
        along_u, along_v = _order(derivative[0]), _order(derivative[1])
        highest = max(along_u, along_v)
        scratch = np.empty((highest + 1, highest + 1, 3))
        sides = (c_int * 2)(Side.RIGHT, Side.RIGHT)

        def evaluate(uv: Any, out: NDArray[np.float64]) -> None:
            LIBRARY.crease_surface_evaluate(self._handle, uv, sides, highest, scratch.ctypes.data)
            out[:] = scratch[along_u, along_v]
        return self._at(u, v, evaluate)

    def normal(self, u: ArrayLike, v: ArrayLike) -> NDArray[np.float64]:
        """Unit normals."""
        sides = (c_int * 2)(Side.RIGHT, Side.RIGHT)

        def evaluate(uv: Any, out: NDArray[np.float64]) -> None:
            LIBRARY.crease_surface_normal(self._handle, uv, sides, out.ctypes.data)
        return self._at(u, v, evaluate)

    @staticmethod
    def _at(u: ArrayLike, v: ArrayLike, evaluate: Any) -> NDArray[np.float64]:
        us, vs = np.broadcast_arrays(np.asarray(u, dtype=np.float64), np.asarray(v, np.float64))
        places = np.empty((us.size, 3))
        for place, one_u, one_v in zip(places, us.ravel(), vs.ravel()):
            evaluate((c_double * 2)(one_u, one_v), place)
        return places.reshape(*us.shape, 3)

    def project(self, points: ArrayLike, *, threads: int = 0) -> NDArray[Any]:
        """The closest point of the surface for each point: a structured array with the fields
        `uv`, `point` and `distance` (positive along the normal)."""
        with Work(threads=threads) as work:
            return _feet(work, "crease_surface_project", self._handle, points, Foot)


class Mesh:
    """Triangles with shared vertices."""

    def __init__(self, handle: Held) -> None:
        self._handle = handle

    def __repr__(self) -> str:
        return f"<crease.Mesh: {len(self.vertices)} vertices, {len(self.triangles)} triangles>"

    def _per_vertex(self, address: int | None) -> NDArray[np.float64]:
        return view(self._handle, address, (LIBRARY.crease_mesh_vertex_count(self._handle), 3))

    @property
    def vertices(self) -> NDArray[np.float64]:
        """n x 3."""
        return self._per_vertex(LIBRARY.crease_mesh_vertices(self._handle))

    @property
    def normals(self) -> NDArray[np.float64]:
        """Unit normals at the vertices, n x 3."""
        return self._per_vertex(LIBRARY.crease_mesh_normals(self._handle))

    @property
    def triangles(self) -> NDArray[np.uint32]:
        """Numbers of vertices, n x 3."""
        return view(self._handle, LIBRARY.crease_mesh_triangles(self._handle),
                    (LIBRARY.crease_mesh_triangle_count(self._handle), 3), np.uint32)

    @property
    def owners(self) -> NDArray[np.uint32]:
        """Number of the face that each triangle belongs to."""
        return view(self._handle, LIBRARY.crease_mesh_owners(self._handle),
                    (LIBRARY.crease_mesh_triangle_count(self._handle),), np.uint32)

    def project(self, points: ArrayLike, *, threads: int = 0) -> NDArray[Any]:
        """The closest point of the mesh for each point: a structured array with the fields
        `point`, `distance` (positive outside) and `triangle`."""
        with Work(threads=threads) as work:
            return self._project(work, points)

    def _project(self, work: Work, points: ArrayLike) -> NDArray[Any]:
        return _feet(work, "crease_mesh_project", self._handle, points, MeshFoot)

    def write(self, path: Path) -> None:
        """Writes the mesh: PLY, OBJ, STL or GLB by extension."""
        target_of(path, Target.MESH)
        with Work() as work:
            work.call("crease_mesh_write", self._handle, encoded(path))


