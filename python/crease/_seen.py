# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""What can be looked at: figures, the page, and the page inside a notebook."""

from __future__ import annotations

import html
import os
import tempfile
from ctypes import byref
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Sequence

from ._facts import Facts, describe
from ._library import LIBRARY
from ._memory import Handle, Held, addresses
from ._options import fill
from ._targets import Path, Target, encoded, target_of
from ._work import Work

if TYPE_CHECKING:
    from ._cloud import Cloud

#: A notebook keeps what it shows: of larger clouds it gets every k-th point.
MOST_POINTS_IN_NOTEBOOK = 100_000
#: A larger net would hide in a figure what it surrounds; on the page it can be switched off.
_MOST_NET_IN_FIGURE = 100


@dataclass
class Layers:
    """What a figure or the page shows."""
    title: str
    cloud: Cloud | None = None
    surfaces: Sequence[Held] = ()
    nets: Sequence[Held] = ()  #: surfaces whose control nets are shown, and they are not
    control_points: int = 0
    mesh: Held | None = None
    curves: Sequence[Held] = field(default_factory=list)
    colour_by: str | None = None
    of_regions: Sequence[Facts] = ()  #: what is known of the points with each number in `region`
    of_faces: Sequence[Facts] = ()  #: of the mesh's faces
    of_curves: Sequence[Facts] = ()


def _scene(work: Work, layers: Layers, page: bool) -> Handle:
    scene = work.make("scene", "crease_scene_create", layers.title.encode())
    if layers.mesh is not None:
        work.call("crease_scene_add_mesh", scene, b"faces", layers.mesh)
        describe(work, scene, layers.of_faces)
    if layers.cloud is not None:
        work.call("crease_scene_add_cloud", scene, b"points", layers.cloud._handle)
        describe(work, scene, layers.of_regions)
    net = page or layers.control_points <= _MOST_NET_IN_FIGURE
    if layers.nets and net:
        work.call("crease_scene_add_nets", scene, b"surface", addresses(layers.nets),
                  len(layers.nets))
    if layers.surfaces:
        work.call("crease_scene_add_surfaces", scene, b"surface", addresses(layers.surfaces),
                  len(layers.surfaces), net)
    if layers.curves:
        work.call("crease_scene_add_curves", scene, b"creases", addresses(layers.curves),
                  len(layers.curves))
        describe(work, scene, layers.of_curves)
    return scene


def _write_page(layers: Layers, path: Path) -> None:
    with Work() as work:
        work.call("crease_page_write", _scene(work, layers, page=True), encoded(path))


class Seen:
    """Something that is written to files, and seen in figures, on the page and in notebooks."""

    _own_targets = Target(0)

    def _layers(self) -> Layers:
        raise NotImplementedError

    def _write_own(self, work: Work, kind: Target, path: Path) -> None:
        raise NotImplementedError

    def write(self, path: Path) -> None:
        """Writes it; the extension says what. Besides what it is itself: a figure to .png .svg
        .pdf, one page to turn and pick points in, which works offline, to .html."""
        kind = target_of(path, self._own_targets | Target.FIGURE | Target.PAGE)
        if kind is Target.FIGURE:
            self.figure(path)
        elif kind is Target.PAGE:
            _write_page(self._layers(), path)
        else:
            with Work() as work:
                self._write_own(work, kind, path)

    def figure(self, path: Path, *, width: int | None = None, height: int | None = None,
               azimuth: float | None = None, elevation: float | None = None,
               colour_by: str | None = None, axes: bool | None = None) -> None:
        """Draws a figure as PNG, SVG or PDF: size in pixels or points, place of the eye in degrees,
        the field that colours the points."""
        target_of(path, Target.FIGURE)
        layers = self._layers()
        options = fill(LIBRARY.crease_figure_options_default(), width=width, height=height,
                       azimuth=azimuth, elevation=elevation, axes=axes)
        colour = colour_by or layers.colour_by
        options.colour_by = colour.encode() if colour else None
        with Work() as work:
            work.call("crease_figure_write", _scene(work, layers, page=False), byref(options),
                      encoded(path))

    def _repr_html_(self) -> str:
        """The page in a frame, for notebooks."""
        layers = self._layers()
        if layers.cloud is not None:
            layers.cloud = layers.cloud._thinned(MOST_POINTS_IN_NOTEBOOK)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "page.html")
            _write_page(layers, path)
            with open(path, encoding="utf-8") as file:
                page = html.escape(file.read())
        return (f'<iframe srcdoc="{page}" style="width: 100%; height: 600px; border: 0" '
                f'title="{html.escape(layers.title)}" allowfullscreen></iframe>')
