# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""Distances in four numbers, as the program tells them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Deviation:
    """How far points are from a surface."""
    mean: float  #: signed
    rms: float
    p95: float  #: 95 % are below
    max: float


def summarise(deviations: NDArray[np.float64]) -> Deviation:
    """The summary of signed distances; zeros when there are none."""
    if not len(deviations):
        return Deviation(0.0, 0.0, 0.0, 0.0)
    size = np.sort(np.abs(deviations))
    return Deviation(float(deviations.mean()), float(np.sqrt(np.mean(size * size))),
                     float(size[(len(size) - 1) * 95 // 100]), float(size[-1]))
