# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""Clouds: points with normals and fields."""

from __future__ import annotations

import os
from ctypes import byref
from typing import Any, Mapping, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._declarations import CloudParts, Field, Type
from ._errors import UsageError
from ._library import LIBRARY
from ._memory import Held, view
from ._options import fill
from ._seen import Layers, Seen
from ._targets import Path, Target, encoded
from ._work import Work

#: What a cloud is taken from: an array of n x 3, a file, or a cloud.
Points = Union[ArrayLike, "Cloud", "os.PathLike[str]"]

_DTYPES = {kind: np.dtype(kind.name.lower()) for kind in Type}
_TYPES = {dtype: kind for kind, dtype in _DTYPES.items()}
_KEPT_AS = {kind: np.dtype(name) for kind, name in
            (("b", "uint8"), ("i", "int32"), ("u", "uint32"), ("f", "float64"))}


def _vectors(name: str, values: ArrayLike) -> NDArray[np.float64]:
    try:
        array = np.ascontiguousarray(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise UsageError(f"{name}: numbers in an array of shape (n, 3); {error}") from None
    if array.ndim != 2 or array.shape[1] != 3:
        raise UsageError(f"{name}: an array of shape (n, 3), not {np.shape(values)}")
    return array


def _field_values(name: str, values: ArrayLike, count: int) -> NDArray[Any]:
    """The values as one of the element types of files, without loss."""
    array = np.asarray(values)
    if array.shape != (count,):
        raise UsageError(f"fields: {name} has the shape {array.shape}; it takes one value for each "
                         f"of the {count} points")
    native = array.dtype.newbyteorder("=")
    dtype = native if native in _TYPES else _KEPT_AS.get(array.dtype.kind)
    kept = array if dtype is None else np.ascontiguousarray(array, dtype)
    if dtype is None or not np.array_equal(kept, array, equal_nan=dtype.kind == "f"):
        raise UsageError(f"fields: {name} holds {array.dtype}, which would not be kept; use float64 "
                         "or integers of 32 bits")
    return kept


def _table(values: Mapping[str, NDArray[Any]]) -> Any:
    """The fields as the library takes them; it copies the values."""
    return (Field * len(values))(*(
        Field(name.encode(errors="surrogateescape"), _TYPES[array.dtype], array.ctypes.data)
        for name, array in values.items()))


class Cloud(Seen):
    """Points with optional unit normals and named fields; nothing of it ever changes.

    Its arrays show the library's memory: they are not copied, cannot be written to, and live on
    when the cloud is gone.
    """

    def __init__(self, points: ArrayLike, normals: ArrayLike | None = None,
                 fields: Mapping[str, ArrayLike] | None = None) -> None:
        """Copies the arrays once. A cloud of float32 is written as float32."""
        xyz = _vectors("points", points)
        directions = None if normals is None else _vectors("normals", normals)
        if directions is not None and len(directions) != len(xyz):
            raise UsageError(f"normals: {len(directions)} of them for {len(xyz)} points")
        values = {name: _field_values(name, field, len(xyz))
                  for name, field in (fields or {}).items()}
        table = _table(values)
        single = getattr(points, "dtype", None) == np.float32
        parts = CloudParts(len(xyz), xyz.ctypes.data,
                           None if directions is None else directions.ctypes.data, table,
                           len(values), Type.FLOAT32 if single else Type.FLOAT64)
        with Work() as work:
            self._handle: Held = work.make("cloud", "crease_cloud_create", byref(parts))

    @classmethod
    def _of(cls, handle: Held) -> Cloud:
        cloud = cls.__new__(cls)
        cloud._handle = handle
        return cloud

    _own_targets = Target.CLOUD

    def __len__(self) -> int:
        return int(LIBRARY.crease_cloud_count(self._handle))

    def __repr__(self) -> str:
        names = ", ".join(self.fields) or "none"
        return f"<crease.Cloud: {len(self)} points; fields: {names}>"

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        return np.array(self.points, dtype=dtype) if dtype or copy else self.points

    @property
    def points(self) -> NDArray[np.float64]:
        """Coordinates, n x 3."""
        return view(self._handle, LIBRARY.crease_cloud_points(self._handle), (len(self), 3))

    @property
    def normals(self) -> NDArray[np.float64] | None:
        """Unit normals as read, n x 3, or None."""
        address = LIBRARY.crease_cloud_normals(self._handle)
        return view(self._handle, address, (len(self), 3)) if address else None

    @property
    def fields(self) -> dict[str, NDArray[Any]]:
        """The fields by their names, in their order."""
        count = LIBRARY.crease_cloud_field_count(self._handle)
        found = (LIBRARY.crease_cloud_field(self._handle, index) for index in range(count))
        return {field.name.decode(errors="surrogateescape"):
                view(self._handle, field.values, (len(self),), _DTYPES[field.type])
                for field in found}

    def with_fields(self, **fields: ArrayLike) -> Cloud:
        """The same cloud with further fields; one of the same name is replaced."""
        values = {name: _field_values(name, field, len(self)) for name, field in fields.items()}
        with Work() as work:
            return Cloud._of(work.make("cloud", "crease_cloud_with_fields", self._handle,
                                       _table(values), len(values)))

    def _write_own(self, work: Work, kind: Target, path: Path) -> None:
        work.call("crease_cloud_write", self._handle, encoded(path))

    def _thinned(self, most: int) -> Cloud:
        """Every k-th point, so that at most so many are left."""
        step = -(-len(self) // most)
        if step <= 1:
            return self
        normals = self.normals
        return Cloud(self.points[::step], None if normals is None else normals[::step],
                     {name: values[::step] for name, values in self.fields.items()})

    def _layers(self) -> Layers:
        return Layers("cloud", cloud=self)


def as_cloud(points: Points) -> Cloud:
    """The cloud itself, that of a file, or one of these coordinates."""
    if isinstance(points, Cloud):
        return points
    if isinstance(points, (str, os.PathLike)):
        return read(points)
    return Cloud(points)


def read(path: Path, *, skip_invalid: bool = False, mesh_points: int | None = None) -> Cloud:
    """Reads a cloud: PLY, PCD, XYZ, TXT, CSV, ASC, PTS, LAS, or a mesh: OBJ, STL, OFF, PLY.

    skip_invalid: leave out points that are not finite, with a warning, instead of failing; of a
    mesh then the vertices.
    mesh_points: how many points are drawn on the triangles of a mesh; 0: its vertices; None: its
    vertices where they tell its shape, else as many as its narrowest faces ask for.
    """
    options = fill(LIBRARY.crease_read_options_default(), skip_invalid=skip_invalid,
                   mesh_points=mesh_points)
    with Work() as work:
        return Cloud._of(work.make("cloud", "crease_cloud_read", encoded(path), byref(options)))


def write(path: Path, points: ArrayLike | Cloud, normals: ArrayLike | None = None,
          fields: Mapping[str, ArrayLike] | None = None) -> None:
    """Writes a cloud by extension: see Cloud.write()."""
    if not isinstance(points, Cloud):
        points = Cloud(points, normals, fields)
    elif normals is not None:
        raise UsageError("normals: the cloud has its own; give its points instead")
    elif fields:
        points = points.with_fields(**fields)
    points.write(path)
