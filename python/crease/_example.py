# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""Clouds to try the rest on."""

from __future__ import annotations

from ctypes import byref
from typing import Literal

from ._cloud import Cloud
from ._errors import UsageError
from ._library import LIBRARY
from ._options import fill
from ._work import Work


def example(name: Literal["cube", "sample", "panel", "bracket"], *, noise: float | None = None,
            count: int | None = None, seed: int = 1) -> Cloud:
    """Makes a cloud: the paper's cube (6146 points), the paper's sample of 51 points at one edge, a
    scanned panel with one crease, or a scanned bracket. noise: standard deviation in spacings.
    count: points of the panel or the bracket."""
    with Work(threads=1, seed=seed) as work:
        if name == "cube" and noise is None and count is None:
            return Cloud._of(work.make("cloud", "crease_shape_cube", 32))
        if name in ("panel", "bracket"):
            options = fill(getattr(LIBRARY, f"crease_{name}_options_default")(), noise=noise,
                           count=count)
        elif name == "sample" and count is None:
            options = fill(LIBRARY.crease_sample_options_default(), noise=noise)
        else:
            raise UsageError(f"example: cube (without noise and count), sample (without count), "
                             f"panel or bracket, not {name!r}")
        return Cloud._of(work.make("cloud", f"crease_shape_{name}", byref(options)))
