# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""A model that keeps its sharp edges."""

from __future__ import annotations

from ctypes import byref, c_bool
from typing import Any, Iterable, Literal, overload

from numpy.typing import ArrayLike

from ._cloud import Cloud, Points, as_cloud
from ._declarations import (AveragingOptions, DetectOptions, Orientation, PartOptions,
                            RegionsOptions, SheetOptions)
from ._errors import UsageError
from ._library import HAS_CAD, LIBRARY
from ._memory import Handle
from ._options import choose, fill
from ._part import Part, build_part
from ._sheet import Sheet
from ._work import ProgressCallback, Work

_PART = {"sigma", "faces", "no_snap"}
_TURN = {"net", "orientation", "rotation"}
_SHEET = _TURN | {"order", "most_creases", "smoothing", "tolerance"}
#: Of sheets, but not a reason to take one.
_WRITING = {"no_trim"}
_AVERAGING = _TURN | {"neighbours", "resamples", "averaging_neighbours", "passes",
                      "marking_neighbours", "mark_threshold", "row_threshold", "multiplicity"}
#: With fewer points there are no regions to speak of.
_LEAST_FOR_SHELL = 500
#: Times as far from a shell as from a sheet, for 95 % of the points: then the sheet is taken.
_FURTHER = 2.0
_TAKES = {"automatic": _PART | _SHEET | _WRITING, "part": _PART, "shell": _PART,
          "sheet": _SHEET | _WRITING, "averaging": _AVERAGING}


def _check(method: str, given: Iterable[str]) -> None:
    takes = choose("method", method, _TAKES)
    for name in given:
        if name not in takes:
            owners = " or ".join(other for other in _TAKES if name in _TAKES[other])
            raise UsageError(f"{name}: the method {method} has no such option; {owners} has")


def _orientation(given: dict[str, Any]) -> dict[str, Any]:
    """How the cloud is turned: a rotation, when there is one, decides."""
    if "rotation" in given:
        return {"rotation": given["rotation"], "orientation": Orientation.GIVEN}
    if "orientation" in given:
        kinds = {kind.name.lower(): kind for kind in (Orientation.AUTOMATIC, Orientation.NONE)}
        return {"orientation": choose("orientation", given["orientation"], kinds)}
    return {}


def _sheet_options(given: dict[str, Any]) -> SheetOptions:
    options: SheetOptions = fill(
        LIBRARY.crease_sheet_options_default(), **_orientation(given), net=given.get("net"),
        order=given.get("order"), creases=given.get("most_creases"),
        smoothing=given.get("smoothing"), tolerance=given.get("tolerance"))
    return options


def _averaging_options(given: dict[str, Any]) -> AveragingOptions:
    own = {name: given.get(name) for name in _AVERAGING - _TURN - {"neighbours", "resamples"}}
    options: AveragingOptions = fill(LIBRARY.crease_averaging_options_default(),
                                     **_orientation(given), net=given.get("net"), **own)
    detect: DetectOptions = options.detect
    fill(detect, neighbours=given.get("neighbours"), resamples=given.get("resamples"))
    return options


def _part_options(method: str, given: dict[str, Any]) -> tuple[RegionsOptions, PartOptions]:
    bspline = choose("faces", given.get("faces", "analytic"), {"analytic": False, "bspline": True})
    splitting = fill(LIBRARY.crease_regions_options_default(), sigma=given.get("sigma"),
                     united=method == "shell")
    return splitting, PartOptions(bspline_faces=bspline, open=method == "shell")


def _chosen(work: Work, cloud: Cloud, given: dict[str, Any]) -> str:
    """A sheet where one can follow the cloud, or where options are set that only sheets have."""
    if given.keys() & _SHEET:
        return "sheet"
    suits = c_bool(True)
    work.call("crease_sheet_suits", cloud._handle, byref(suits))
    return "sheet" if suits.value else "part"


def _wants_shell(work: Work, cloud: Cloud, sheet: Handle, given: dict[str, Any]) -> bool:
    """Whether the cloud has creases that the sheet has not."""
    if len(cloud) < _LEAST_FOR_SHELL or not HAS_CAD:
        return False
    splitting, _ = _part_options("shell", given)
    regions = work.make("regions", "crease_regions_find", cloud._handle, byref(splitting))
    network = work.make("network", "crease_network_find", regions, None)
    carries = c_bool(True)
    work.call("crease_sheet_carries", sheet, regions, network, byref(carries))
    return not carries.value


@overload
def fit(points: Points, *, method: Literal["sheet"],
        memory: int | str | None = ..., net: ArrayLike | None = ...,
        orientation: Literal["automatic", "none"] | None = ..., rotation: ArrayLike | None = ...,
        order: int | None = ..., most_creases: int | None = ..., smoothing: float | None = ...,
        tolerance: float | None = ..., no_trim: bool = ..., seed: int = ..., threads: int = ...,
        progress: ProgressCallback | None = ...) -> Sheet: ...


@overload
def fit(points: Points, *, method: Literal["averaging"],
        memory: int | str | None = ..., net: ArrayLike | None = ...,
        orientation: Literal["automatic", "none"] | None = ..., rotation: ArrayLike | None = ...,
        neighbours: int | None = ..., resamples: int | None = ...,
        averaging_neighbours: int | None = ..., passes: int | None = ...,
        marking_neighbours: int | None = ..., mark_threshold: float | None = ...,
        row_threshold: int | None = ..., multiplicity: int | None = ..., seed: int = ...,
        threads: int = ..., progress: ProgressCallback | None = ...) -> Sheet: ...


@overload
def fit(points: Points, *, method: Literal["part"],
        memory: int | str | None = ..., sigma: float | None = ...,
        faces: Literal["analytic", "bspline"] | None = ..., no_snap: bool = ..., seed: int = ...,
        threads: int = ..., progress: ProgressCallback | None = ...) -> Part: ...


@overload
def fit(points: Points, *, method: Literal["shell"],
        memory: int | str | None = ..., sigma: float | None = ...,
        faces: Literal["analytic", "bspline"] | None = ..., no_snap: bool = ..., seed: int = ...,
        threads: int = ..., progress: ProgressCallback | None = ...) -> Part: ...


@overload
def fit(points: Points, *, method: Literal["automatic"] = ...,
        memory: int | str | None = ..., sigma: float | None = ...,
        faces: Literal["analytic", "bspline"] | None = ..., no_snap: bool = ...,
        net: ArrayLike | None = ...,
        orientation: Literal["automatic", "none"] | None = ..., rotation: ArrayLike | None = ...,
        order: int | None = ..., most_creases: int | None = ..., smoothing: float | None = ...,
        tolerance: float | None = ..., no_trim: bool = ..., seed: int = ..., threads: int = ...,
        progress: ProgressCallback | None = ...) -> Sheet | Part: ...


def fit(points: Points, *, method: str = "automatic", seed: int = 1, threads: int = 0,
        memory: int | str | None = None, progress: ProgressCallback | None = None,
        **options: Any) -> Sheet | Part:
    """Fits a model that is sharp along the edges that the data show. Nothing needs to be set; the
    options are those of `crease fit`.

    points: an array of n x 3, a crease.Cloud, or the path of a file.
    method: part: a face for every smooth region, closed to a solid where the points allow; shell:
    the same of points that end at a border, where its faces end as well; sheet: one surface whose creases are knot lines; averaging: the paper's Algorithm 1; automatic: where
    no surface lies over another a sheet, or a shell if creases are not where a sheet can have them;
    a sheet where an option is given that only sheets have; else a part.

    Of part and shell: sigma: noise of the points along the normal, when it is known; faces: analytic (planes,
    cylinders ... as what they are) or bspline; no_snap: leave surfaces that are parallel,
    perpendicular, coaxial, equally large or symmetric within their errors as the points have them.
    Of sheet and averaging: net: control points across and along the edge; orientation: automatic or
    none; rotation: 3 x 3, turns the cloud instead.
    Of sheet: order; most_creases in each direction; smoothing: weight of the thin-plate term;
    tolerance: refine until the rms deviation is below; no_trim: write the whole sheet, not only as far
    as the points go.
    Of averaging: neighbours, resamples, averaging_neighbours, passes, marking_neighbours,
    mark_threshold, row_threshold, multiplicity.
    threads, memory, progress: as in crease.detect().
    """
    given = {name: value for name, value in options.items() if value is not None}
    unknown = given.keys() - set().union(*_TAKES.values())
    if unknown:
        raise TypeError(f"fit() got an unexpected keyword argument {min(unknown)!r}")
    _check(method, given)
    cloud = as_cloud(points)
    with Work(threads=threads, seed=seed, memory=memory, progress=progress) as work:
        automatic = method == "automatic"
        if automatic:
            method = _chosen(work, cloud, given)
        if method in ("part", "shell"):
            return build_part(work, cloud, method, *_part_options(method, given),
                              snap=not given.get("no_snap", False))
        if method == "averaging":
            handle = work.make("sheet", "crease_averaging_fit", cloud._handle,
                               byref(_averaging_options(given)))
        else:
            handle = work.make("sheet", "crease_sheet_fit", cloud._handle,
                               byref(_sheet_options(given)))
        if automatic and not given.keys() & _SHEET and _wants_shell(work, cloud, handle, given):
            part = build_part(work, cloud, "shell", *_part_options("shell", given),
                              snap=not given.get("no_snap", False))
            sheet = Sheet(cloud, handle, method)
            if part.state == "shell" and part.deviation.p95 <= _FURTHER * sheet.deviation.p95:
                return part
    trim = method != "averaging" and not given.get("no_trim", False)
    return Sheet(cloud, handle, method, trim)
