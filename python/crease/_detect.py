# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""The sharp edges of a cloud, as curves and as labels of its points."""

from __future__ import annotations

from ctypes import byref
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ._cloud import Cloud, Points, as_cloud
from ._declarations import Detector, RegionType, SnapKind
from ._facts import Facts, surface_facts
from ._library import LIBRARY
from ._memory import Handle, Held, addresses, borrowed, view
from ._options import choose, fill
from ._seen import Layers, Seen
from ._spline import Curve
from ._targets import Path, Target, encoded, target_of
from ._work import ProgressCallback, Work

_DETECTORS = {kind.name.lower().replace("_", "-"): kind for kind in Detector}


@dataclass(frozen=True)
class Region:
    """A smooth piece of the surface of a cloud."""
    type: str  #: plane, sphere, cylinder, cone, torus or freeform
    parameters: tuple[float, ...]  #: of that type, as crease.h lists them
    points: int  #: how many lie on it
    rms: float  #: their root mean square distance from it
    chi: float  #: their mean squared distance over the squared noise: about 1 when it explains them
    tangent: tuple[int, ...]  #: of a fillet: the two regions that it is exactly tangent to
    place_error: float  #: standard error of its place: see crease.h
    direction_error: float  #: of its normal or axis, in degrees
    radius_error: float
    shape_error: float  #: of a cone's slope, of the radius of a torus' tube


@dataclass(frozen=True)
class Corner:
    """Where creases end together, or one at a third region."""
    position: tuple[float, float, float]
    valence: int  #: how many ends of creases


@dataclass(frozen=True)
class Crease:
    """A curve in which two smooth regions meet at an angle."""
    curve: Curve
    regions: tuple[int, int]  #: numbers of the regions
    corners: tuple[int, int]  #: numbers of the corners at its ends, or -1
    closed: bool
    length: float
    angle: float  #: mean dihedral angle in degrees: 180 = flat
    angle_error: float  #: its standard error
    position_error: float  #: standard error of the curve's place, across it


def regions_of(handle: Held) -> list[Region]:
    """All regions in the order of their numbers."""
    found = []
    for index in range(LIBRARY.crease_regions_count(handle)):
        one = LIBRARY.crease_regions_at(handle, index)
        found.append(Region(RegionType(one.type).name.lower(),
                            tuple(one.parameters[:one.parameter_count]), one.point_count, one.rms,
                            one.chi, tuple(one.tangent) if one.tangent[0] >= 0 else (),
                            one.place_error, one.direction_error, one.radius_error,
                            one.shape_error))
    return found


@dataclass(frozen=True)
class Snap:
    """Regions whose surfaces were made to have something exactly in common."""
    to: str  #: parallel, perpendicular, coaxial, equal_radii or symmetric
    regions: tuple[int, ...]  #: their numbers


def snaps_of(handle: Held) -> list[Snap]:
    """What was snapped."""
    found = (LIBRARY.crease_regions_snap_at(handle, index)
             for index in range(LIBRARY.crease_regions_snap_count(handle)))
    return [Snap(SnapKind(one.kind).name.lower(), tuple(one.regions[:one.region_count]))
            for one in found]


def write_curves(work: Work, curves: list[Curve], path: Path) -> None:
    """Writes curves: as lines, or as the curves that they are to CAD files."""
    pointers = addresses([curve._handle for curve in curves])
    if target_of(path, Target.LINES | Target.CAD) is Target.CAD:
        work.call("crease_cad_curves_write", pointers, len(curves), encoded(path))
    else:
        work.call("crease_curves_write", pointers, len(curves), 0.0, encoded(path))


class Detection(Seen):
    """What crease.detect() finds. Arrays have one value for each point, in their order; they show
    the library's memory, cannot be written to, and live on when this object is gone."""

    _own_targets = Target.CLOUD

    def __init__(self, cloud: Cloud, scores: Handle, regions: Handle, network: Handle,
                 by_score: bool) -> None:
        self._cloud, self._scores, self._regions = cloud, scores, regions
        self._network, self._by_score = network, by_score

    def __repr__(self) -> str:
        return (f"<crease.Detection: {len(self.regions)} regions, {len(self.creases)} creases, "
                f"{len(self.corners)} corners; {int(self.feature.sum())} of {len(self._cloud)} "
                "points are features>")

    @property
    def variance(self) -> NDArray[np.float64]:
        """The score of the detector."""
        return view(self._scores, LIBRARY.crease_scores_variance(self._scores),
                    (len(self._cloud),))

    @property
    def feature(self) -> NDArray[np.bool_]:
        """Whether the point lies on a sharp edge."""
        address = (LIBRARY.crease_scores_features(self._scores) if self._by_score
                   else LIBRARY.crease_network_features(self._network))
        owner = self._scores if self._by_score else self._network
        return view(owner, address, (len(self._cloud),), np.bool_)

    @property
    def region(self) -> NDArray[np.int32]:
        """Number of the smooth region, -1 for outliers."""
        return view(self._regions, LIBRARY.crease_regions_labels(self._regions),
                    (len(self._cloud),), np.int32)

    @property
    def normals(self) -> NDArray[np.float64]:
        """Unit normals, n x 3, sign arbitrary; beside a sharp edge, those of the point's side."""
        return view(self._regions, LIBRARY.crease_regions_normals(self._regions),
                    (len(self._cloud), 3))

    @cached_property
    def regions(self) -> list[Region]:
        """The smooth regions."""
        return regions_of(self._regions)

    @cached_property
    def creases(self) -> list[Crease]:
        """The curves in which regions meet at an angle."""
        count = LIBRARY.crease_network_count(self._network)
        curves = borrowed(self._network, LIBRARY.crease_network_curves(self._network), count)
        found = []
        for index, curve in enumerate(curves):
            one = LIBRARY.crease_network_at(self._network, index)
            found.append(Crease(Curve(curve), (one.regions[0], one.regions[1]),
                                (one.corners[0], one.corners[1]), one.closed, one.length, one.angle,
                                one.angle_error, one.position_error))
        return found

    @cached_property
    def corners(self) -> list[Corner]:
        """Where creases end."""
        found = (LIBRARY.crease_network_corner(self._network, index)
                 for index in range(LIBRARY.crease_network_corner_count(self._network)))
        return [Corner((one.position[0], one.position[1], one.position[2]), one.valence)
                for one in found]

    @property
    def noise(self) -> float:
        """Standard deviation of the points along the normal."""
        return float(LIBRARY.crease_regions_sigma(self._regions))

    @property
    def spacing(self) -> float:
        """Mean spacing of the points."""
        return float(LIBRARY.crease_network_spacing(self._network))

    @cached_property
    def cloud(self) -> Cloud:
        """The cloud with the fields `variance`, `feature` and `region`."""
        return self._cloud.with_fields(variance=self.variance.astype(np.float32),
                                       feature=self.feature, region=self.region)

    def write_creases(self, path: Path) -> None:
        """Writes the creases: as lines to .ply .obj .csv, as the curves that they are to .step .stp
        .iges .igs .brep."""
        with Work() as work:
            if target_of(path, Target.LINES | Target.CAD) is Target.LINES:
                work.call("crease_network_write", self._network, encoded(path))
            else:
                write_curves(work, [crease.curve for crease in self.creases], path)

    def _write_own(self, work: Work, kind: Target, path: Path) -> None:
        self.cloud._write_own(work, kind, path)

    def _layers(self) -> Layers:
        return Layers("detect", cloud=self.cloud, colour_by="region",
                      curves=[crease.curve._handle for crease in self.creases],
                      of_regions=[_region_facts(region) for region in self.regions],
                      of_curves=[_crease_facts(crease) for crease in self.creases])


def _region_facts(region: Region) -> Facts:
    return {**surface_facts(region.type, region.parameters), "points": region.points,
            "rms": region.rms, "chi": region.chi}


def _crease_facts(crease: Crease) -> Facts:
    return {"regions": crease.regions, "closed": crease.closed, "length": crease.length,
            "angle": crease.angle, "angle_error": crease.angle_error,
            "position_error": crease.position_error}


def detect(points: Points, *, detector: Literal["bootstrap", "jackknife", "variation",
                                                "gauss-map"] = "bootstrap",
           features: Literal["creases", "score"] = "creases", neighbours: int | None = None,
           resamples: int | None = None, false_discovery_rate: float | None = None,
           sigma: float | None = None, seed: int = 1, threads: int = 0,
           memory: int | str | None = None, progress: ProgressCallback | None = None) -> Detection:
    """Finds the smooth regions of a cloud, the creases in which they meet at an angle, and the
    points on them. Nothing needs to be set; the options are those of `crease detect`.

    points: an array of n x 3, a crease.Cloud, or the path of a file.
    detector: what `variance` holds. features: what `feature` comes from.
    neighbours, resamples, false_discovery_rate: of the score.
    sigma: noise of the points along the normal, when it is known.
    threads: 0 is one for each processor; the result does not depend on it.
    memory: bytes that the process may have, as a number or as "500M" or "2G"; MemoryError is raised
    where it would take more. Clouds larger than that go from file to file by the program.
    progress: is called with the stage and how much of it is done, 0 to 1; an exception ends the
    work.
    """
    by_score = choose("features", features, {"creases": False, "score": True})
    scoring = fill(LIBRARY.crease_detect_options_default(), neighbours=neighbours,
                   resamples=resamples, false_discovery_rate=false_discovery_rate,
                   detector=choose("detector", detector, _DETECTORS))
    splitting = fill(LIBRARY.crease_regions_options_default(), sigma=sigma)
    cloud = as_cloud(points)
    with Work(threads=threads, seed=seed, memory=memory, progress=progress) as work:
        scores = work.make("scores", "crease_scores_compute", cloud._handle, byref(scoring))
        regions = work.make("regions", "crease_regions_find", cloud._handle, byref(splitting))
        network = work.make("network", "crease_network_find", regions, None)
    return Detection(cloud, scores, regions, network, by_score)
