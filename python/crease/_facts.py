# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""What is known of faces, edges and regions, for the page, under the names of the report."""

from __future__ import annotations

from ctypes import c_double
from typing import Mapping, Sequence, Union

from ._declarations import Fact
from ._deviation import Deviation
from ._memory import Handle
from ._work import Work

#: Of one item: words, a number, yes or no, or up to eight numbers.
Facts = Mapping[str, Union[str, float, bool, Sequence[float]]]

#: The names of a surface's parameters, by its type: a place and a direction take three numbers.
_PARAMETERS = {
    "plane": ("place", "normal"), "sphere": ("place", "radius"),
    "cylinder": ("place", "axis", "radius"), "cone": ("place", "axis", "radius", "slope"),
    "torus": ("place", "axis", "radius", "tube_radius"), "freeform": (),
}
_VECTORS = {"place", "normal", "axis"}


def surface_facts(kind: str, parameters: Sequence[float]) -> Facts:
    """The type of a surface and its parameters."""
    facts: dict[str, str | float | bool | Sequence[float]] = {
        "type": kind.replace("freeform", "free form")}
    at = 0
    for name in _PARAMETERS[kind]:
        size = 3 if name in _VECTORS else 1
        facts[name] = parameters[at:at + size] if size == 3 else parameters[at]
        at += size
    return facts


def deviation_facts(deviation: Deviation) -> dict[str, float]:
    """The deviations of the points of a face."""
    return {"mean": deviation.mean, "rms": deviation.rms, "p95": deviation.p95,
            "max": deviation.max}


def _fact(name: str, value: str | float | bool | Sequence[float]) -> Fact:
    if isinstance(value, bool):
        value = "yes" if value else "no"
    if isinstance(value, str):
        return Fact(name.encode(), value.encode(), (c_double * 8)(), 0)
    numbers = tuple(map(float, value)) if isinstance(value, Sequence) else (float(value),)
    return Fact(name.encode(), None, (c_double * 8)(*numbers), len(numbers))


def describe(work: Work, scene: Handle, items: Sequence[Facts]) -> None:
    """Gives the layer added last what is known of its items, in their order."""
    for number, facts in enumerate(items):
        made = (Fact * len(facts))(*(_fact(name, value) for name, value in facts.items()))
        work.call("crease_scene_describe", scene, number, made, len(facts))
