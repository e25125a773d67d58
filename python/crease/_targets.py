# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""What is written to a file, by its extension: as the program has it."""

from __future__ import annotations

import os
from enum import Flag, auto
from typing import Union

from ._errors import UsageError
from ._library import require_cad

Path = Union[str, "os.PathLike[str]"]


class Target(Flag):
    """Kinds of files."""
    CAD = auto()
    CLOUD = auto()
    MESH = auto()
    LINES = auto()
    FIGURE = auto()
    PAGE = auto()


_EXTENSIONS = {
    Target.CAD: (".step", ".stp", ".iges", ".igs", ".brep"),
    Target.CLOUD: (".ply", ".pcd", ".xyz", ".txt", ".csv", ".asc", ".pts"),
    Target.MESH: (".ply", ".obj", ".stl", ".glb"),
    Target.LINES: (".ply", ".obj", ".csv"),
    Target.FIGURE: (".png", ".svg", ".pdf"),
    Target.PAGE: (".html",),
}


def encoded(path: Path) -> bytes:
    """The path as the library takes it."""
    name = os.fsencode(path)
    if b"\0" in name:
        raise UsageError(f"{path!r}: a path has no zero in it")
    return name


def target_of(path: Path, allowed: Target) -> Target:
    """The kind of file; fails when nothing of that kind is written here."""
    name = os.fsdecode(path)
    kinds = {kind: ends for kind, ends in _EXTENSIONS.items() if kind in allowed}
    for kind, ends in kinds.items():
        if name.lower().endswith(ends):
            if kind is Target.CAD:
                require_cad(name)
            return kind
    known = " ".join(end for ends in kinds.values() for end in ends)
    raise UsageError(f"{name}: nothing is known to write there; use one of {known}")
