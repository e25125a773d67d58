# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""Less noise, edges kept, outliers set aside."""

from __future__ import annotations

from ctypes import byref

import numpy as np
from numpy.typing import NDArray

from ._cloud import Cloud, Points, as_cloud
from ._library import LIBRARY
from ._memory import Borrowed, Handle, view
from ._options import fill
from ._seen import Layers, Seen
from ._targets import Path, Target
from ._work import ProgressCallback, Work


class Filtered(Seen):
    """What crease.filter() brings."""

    _own_targets = Target.CLOUD

    def __init__(self, handle: Handle, count: int) -> None:
        self._handle = handle
        self._count = count

    def __repr__(self) -> str:
        return (f"<crease.Filtered: {self._count} points, {int(self.outliers.sum())} outliers; "
                f"noise {self.noise_before:.2g} before, {self.noise_after:.2g} after>")

    @property
    def cloud(self) -> Cloud:
        """All points in their order with the field `outlier`, or, with remove_outliers, the
        others in their order."""
        return Cloud._of(Borrowed(LIBRARY.crease_filtered_cloud(self._handle), self._handle))

    @property
    def points(self) -> NDArray[np.float64]:
        """Coordinates of that cloud."""
        return self.cloud.points

    @property
    def outliers(self) -> NDArray[np.bool_]:
        """Whether the point is an outlier, for every point of the input."""
        return view(self._handle, LIBRARY.crease_filtered_outliers(self._handle), (self._count,),
                    np.bool_)

    @property
    def spacing(self) -> float:
        """Mean spacing of the points."""
        return float(LIBRARY.crease_filtered_spacing(self._handle))

    @property
    def noise_before(self) -> float:
        """Noise along the normal before: given or estimated."""
        return float(LIBRARY.crease_filtered_sigma(self._handle))

    @property
    def noise_after(self) -> float:
        """The roughness that is left."""
        return float(LIBRARY.crease_filtered_sigma_after(self._handle))

    @property
    def movement(self) -> float:
        """Root mean square of the distances that points were moved by."""
        return float(LIBRARY.crease_filtered_movement(self._handle))

    def _write_own(self, work: Work, kind: Target, path: Path) -> None:
        self.cloud._write_own(work, kind, path)

    def _layers(self) -> Layers:
        colour = "outlier" if "outlier" in self.cloud.fields else None
        return Layers("filter", cloud=self.cloud, colour_by=colour)


def filter(points: Points, *, window: int | None = None, passes: int | None = None,
           outlier_sigmas: float | None = None, remove_outliers: bool = False,
           sigma: float | None = None, threads: int = 0,
           progress: ProgressCallback | None = None) -> Filtered:
    """Finds outliers, and moves every other point onto the surface that the points on its own side
    of any edge suggest. Nothing needs to be set; the options are those of `crease filter`.

    points: an array of n x 3, a crease.Cloud, or the path of a file.
    window: points among which a point's surface is sought. passes: times every point is moved.
    outlier_sigmas: an outlier is further from the surface than this many times the noise.
    remove_outliers: leave outliers out instead of marking them.
    sigma, threads, progress: as in crease.detect().
    """
    options = fill(LIBRARY.crease_filter_options_default(), neighbours=window, passes=passes,
                   outlier_sigmas=outlier_sigmas, remove_outliers=remove_outliers, sigma=sigma)
    cloud = as_cloud(points)
    with Work(threads=threads, progress=progress) as work:
        handle = work.make("filtered", "crease_cloud_filter", cloud._handle, byref(options))
    return Filtered(handle, len(cloud))
