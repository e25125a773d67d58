# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""Finds the shared library and declares its functions."""

from __future__ import annotations

import os
from ctypes import CDLL
from pathlib import Path
from typing import Any, Iterator

from ._declarations import CAD_FUNCTIONS, FUNCTIONS, INTERFACE, TRIM_FUNCTIONS
from ._errors import Failure

_PACKAGED = Path(__file__).with_name("libcrease.so")


def _candidates() -> Iterator[str]:
    """CREASE_LIBRARY, when it is set; then the library in the wheel; then that of the system."""
    named = os.environ.get("CREASE_LIBRARY")
    if named:
        yield named
        return
    if _PACKAGED.exists():
        yield str(_PACKAGED)
    yield f"libcrease.so.{INTERFACE}"


def _load() -> CDLL:
    reasons = []
    for path in _candidates():
        try:
            return CDLL(path)
        except OSError as error:
            reasons.append(str(error))
    raise ImportError("crease: its shared library cannot be loaded: " + "; ".join(reasons))


def _declare(library: CDLL, functions: dict[str, tuple[Any, ...]]) -> None:
    for name, (result, *arguments) in functions.items():
        function = getattr(library, name)
        function.restype, function.argtypes = result, arguments


def _open() -> tuple[CDLL, bool]:
    library = _load()
    _declare(library, {"crease_version": FUNCTIONS["crease_version"]})
    version = library.crease_version().decode()
    if not version.startswith(INTERFACE + "."):
        raise ImportError(f"crease: the shared library is of version {version}, and this package "
                          f"is for {INTERFACE}; install both from the same source")
    _declare(library, FUNCTIONS)
    _declare(library, TRIM_FUNCTIONS)
    has_cad = hasattr(library, "crease_cad_write")
    if has_cad:
        _declare(library, CAD_FUNCTIONS)
    return library, has_cad


LIBRARY, HAS_CAD = _open()


def require_cad(what: str) -> None:
    """Fails when the library was built without OpenCASCADE."""
    if not HAS_CAD:
        raise Failure(f"{what}: this build does without CAD files; build with OpenCASCADE "
                      "(CREASE_CAD=ON)", "UNSUPPORTED")
